//! The equations, as `benches/peers/model.py` writes them, in plain loops over arrays.
//!
//! State: R (4), P, Z, then their rates. `P` in-plane amplitudes make `S = 10 + 2 P` states.

use serde::Deserialize;

/// Transverse modes.
const R: usize = 4;
/// Products R_j R_k, j <= k.
const PAIRS: usize = 10;

/// Coefficients, as in the file.
#[derive(Deserialize)]
pub struct Problem {
    bending: Vec<f64>,
    damping: f64,
    load: Vec<f64>,
    psi: Vec<f64>,
    mass_ratio: f64,
    quartic: Vec<Vec<f64>>,
    tension: Vec<Vec<f64>>,
    coupling: Vec<Vec<f64>>,
    membrane: Vec<Vec<f64>>,
    stiffness: f64,
    damper: f64,
    gravity: f64,
    amplitude: f64,
    start: (f64, f64),
    unit_z: f64,
    /// The accuracy label: zeta, periods, and the state they end in.
    #[serde(default)]
    pub label: Option<Label>,
}

/// A trajectory whose end is known.
#[derive(Deserialize)]
pub struct Label {
    pub zeta: f64,
    pub periods: u32,
    pub end: Vec<f64>,
}

impl Problem {
    pub fn in_plane(&self) -> usize {
        self.coupling.len()
    }
}

/// The vector field at one zeta, matrices by columns.
#[derive(Clone)]
pub struct Field<const P: usize, const S: usize> {
    bending: [f64; R],
    damping: f64,
    load: [f64; R],
    psi: [f64; R],
    plate_force: [f64; R],
    quartic: [[f64; PAIRS]; PAIRS],
    tension: [[f64; PAIRS]; P],
    coupling: [[f64; P]; PAIRS],
    membrane: [[f64; P]; P],
    stiffness: f64,
    damper: f64,
    body_frequency: f64,
    gravity: f64,
    amplitude: f64,
    start: (f64, f64),
    unit_z: f64,
}

fn array<const N: usize>(values: &[f64]) -> [f64; N] {
    values.try_into().expect("a list of the right length")
}

fn columns<const ROWS: usize, const COLUMNS: usize>(rows: &[Vec<f64>]) -> [[f64; ROWS]; COLUMNS] {
    std::array::from_fn(|column| std::array::from_fn(|row| rows[row][column]))
}

impl<const P: usize, const S: usize> Field<P, S> {
    const HALF: usize = S / 2;
    const Z: usize = S / 2 - 1;

    pub fn new(problem: &Problem, zeta: f64) -> Self {
        let psi: [f64; R] = array(&problem.psi);
        Self {
            bending: array(&problem.bending),
            damping: problem.damping,
            load: array(&problem.load),
            psi,
            plate_force: psi.map(|psi| problem.mass_ratio * psi),
            quartic: columns(&problem.quartic),
            tension: columns(&problem.tension),
            coupling: columns(&problem.coupling),
            membrane: columns(&problem.membrane),
            stiffness: problem.stiffness,
            damper: 2.0 * zeta * problem.damper,
            body_frequency: problem.damper,
            gravity: problem.gravity,
            amplitude: problem.amplitude,
            start: problem.start,
            unit_z: problem.unit_z,
        }
    }

    /// Plate at rest, body at its start, and whether it stands on the floor.
    pub fn start(&self) -> ([f64; S], bool) {
        let mut x = [0.0; S];
        (x[Self::Z], x[S - 1]) = self.start;
        (x, self.force(&x, 1.0, 0.0) > 0.0)
    }

    /// Frequency of the body on rigid ground over that of the drive.
    pub fn body_frequency(&self) -> f64 {
        self.body_frequency
    }

    pub fn z(&self, x: &[f64]) -> f64 {
        x[Self::Z] / self.unit_z
    }

    /// Largest error of r/h, r'/(h Omega), z/eta, z'/(eta Omega).
    pub fn error(&self, x: &[f64], end: &[f64]) -> f64 {
        let difference = |i: usize| (x[i] - end[i]).abs();
        let plate = (0..R).chain(Self::HALF..Self::HALF + R).map(difference);
        let body = [Self::Z, S - 1].map(|i| difference(i) / self.unit_z);
        plate.chain(body).fold(0.0, |worst, error| {
            if error > worst || error.is_nan() {
                error
            } else {
                worst
            }
        })
    }

    /// F if the leg is in force, over m_h h Omega^2.
    #[inline]
    pub fn force(&self, x: &[f64], cos: f64, sin: f64) -> f64 {
        let mut gap = self.amplitude * cos - x[Self::Z];
        let mut rate = -self.amplitude * sin - x[S - 1];
        for j in 0..R {
            gap += self.psi[j] * x[j];
            rate += self.psi[j] * x[Self::HALF + j];
        }
        self.stiffness * gap + self.damper * rate
    }

    /// F', with `dx` the vector field at `x`.
    #[inline]
    pub fn force_rate(&self, dx: &[f64], cos: f64, sin: f64) -> f64 {
        let mut rate = -self.amplitude * sin - dx[Self::Z];
        let mut second = -self.amplitude * cos - dx[S - 1];
        for j in 0..R {
            rate += self.psi[j] * dx[j];
            second += self.psi[j] * dx[Self::HALF + j];
        }
        self.stiffness * rate + self.damper * second
    }

    /// The vector field on the floor or in flight.
    #[inline(always)]
    pub fn rates(&self, floor: bool, x: &[f64], cos: f64, sin: f64, dx: &mut [f64]) {
        let (x, dx) = (&x[..S], &mut dx[..S]);
        let mut squares = [0.0; PAIRS];
        let mut pair = 0;
        for k in 0..R {
            for j in 0..=k {
                squares[pair] = x[j] * x[k];
                pair += 1;
            }
        }
        let mut tension = [0.0; PAIRS];
        for (column, &s) in self.quartic.iter().zip(&squares) {
            for (sum, a) in tension.iter_mut().zip(column) {
                *sum = a.mul_add(s, *sum);
            }
        }
        for (column, &p) in self.tension.iter().zip(&x[R..R + P]) {
            for (sum, a) in tension.iter_mut().zip(column) {
                *sum = a.mul_add(p, *sum);
            }
        }
        let force = if floor { self.force(x, cos, sin) } else { 0.0 };
        let drive = self.damping.mul_add(sin, cos);
        for j in 0..R {
            let mut elastic = self.bending[j] * x[j];
            for (k, &other) in x[..R].iter().enumerate() {
                let (low, high) = (j.min(k), j.max(k));
                elastic = tension[high * (high + 1) / 2 + low].mul_add(other, elastic);
            }
            let rate = x[Self::HALF + j];
            dx[j] = rate;
            dx[Self::HALF + j] =
                self.load[j] * drive - elastic - self.damping * rate - self.plate_force[j] * force;
        }
        let mut in_plane = [0.0; P];
        for (column, &p) in self.membrane.iter().zip(&x[R..R + P]) {
            for (sum, a) in in_plane.iter_mut().zip(column) {
                *sum = a.mul_add(p, *sum);
            }
        }
        for (column, &s) in self.coupling.iter().zip(&squares) {
            for (sum, a) in in_plane.iter_mut().zip(column) {
                *sum = a.mul_add(s, *sum);
            }
        }
        for i in 0..P {
            let rate = x[Self::HALF + R + i];
            dx[R + i] = rate;
            dx[Self::HALF + R + i] = -in_plane[i] - self.damping * rate;
        }
        dx[Self::Z] = x[S - 1];
        dx[S - 1] = force - self.gravity;
    }
}
