//! States of a model in the units people read: the paper's z/eta and r/h, newtons, metres.

use saltus_hybrid::{Evaluator, Mode, Point};

use super::Model;
use super::leg::{Contact, FLIGHT, LIFTED, STANCE};
use crate::physics::ContactLaw;

/// One point of the stroboscopic section (cos(Omega t) = 1) in the paper's units.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Position of each body, z/eta.
    pub z: Vec<f64>,
    /// Velocity of each body, z'/(eta omega_h).
    pub v: Vec<f64>,
    /// Transverse amplitudes r_j/h, in the order of the mode list.
    pub w: Vec<f64>,
    /// Contact of each body.
    pub phase: Vec<Contact>,
}

/// Measurements at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// Position of each body, z/eta.
    pub z: Vec<f64>,
    /// Velocity of each body, z'/(eta omega_h).
    pub v: Vec<f64>,
    /// Plate reaction force on each body, in units of its weight; 0 in flight.
    pub prf: Vec<f64>,
    /// Whether each body is on the floor.
    pub phase: Vec<Contact>,
    /// Amplitude of each transverse term over the thickness, relative to the base.
    pub w: Vec<f64>,
    /// Displacement of the plate under each body, base motion included (m).
    pub floor: Vec<f64>,
    /// Acceleration of the plate under each body, base motion included (m/s^2):
    /// sum_j psi_j r_j'' - A_b Omega^2 cos(Omega t).
    pub floor_acceleration: Vec<f64>,
    /// Displacement of the base (m), A_b cos(Omega t).
    pub base: f64,
}

impl Model {
    /// A start with the plate at rest and every body at z/eta = `z`, z'/(eta omega_h) = `v`, in the
    /// contact state that the law gives it.
    pub fn start(&self, z: f64, v: f64) -> Point {
        let all = |value: f64| vec![value; self.layout.jumpers];
        self.start_each(&all(z), &all(v))
    }

    /// As [`Model::start`], for each body its own.
    ///
    /// # Panics
    /// If there are more values than bodies.
    pub fn start_each(&self, z: &[f64], v: &[f64]) -> Point {
        self.start_deflected(z, v, &[])
    }

    /// As [`Model::start_each`], with the plate at rest in the shape of the transverse amplitudes r_j/h = `w`,
    /// in the order of the mode list; those not given are 0, and so are all in-plane ones.
    ///
    /// ```
    /// // the plate in the shape of its first term, a tenth of its thickness
    /// let model = saltus::model::Setup::dias_del_prado(0.3, 1.0).model()?;
    /// let start = model.start_deflected(&[0.0], &[0.0], &[-0.1]);
    /// let section = model.section(&start.modes, &start.x);
    /// assert_eq!(section.w[0], -0.1);
    /// # Ok::<(), saltus::model::ModelError>(())
    /// ```
    ///
    /// # Panics
    /// If there are more values than bodies or amplitudes.
    pub fn start_deflected(&self, z: &[f64], v: &[f64], w: &[f64]) -> Point {
        let mut x = vec![0.0; self.layout.len()];
        assert!(
            w.len() <= self.layout.transverse,
            "one amplitude per w term"
        );
        x[self.layout.r(0)..][..w.len()].copy_from_slice(w);
        for (i, (&z, scale)) in z.iter().zip(&self.scales.jumpers).enumerate() {
            x[self.layout.z(i)] = z * scale.position / self.scales.length;
        }
        for (i, (&v, scale)) in v.iter().zip(&self.scales.jumpers).enumerate() {
            x[self.layout.dz(i)] = v * scale.velocity / self.scales.velocity();
        }
        let modes = vec![STANCE; self.layout.jumpers];
        let mut point = self.system.point(&modes, &x);
        self.settle(&mut point);
        point
    }

    /// Gives each body the contact state that belongs to its position; a relaxing leg starts relaxed.
    fn settle(&self, point: &mut Point) {
        let mut evaluator = self.evaluator();
        let stance = vec![STANCE; self.layout.jumpers];
        let nodes = evaluator.nodes(&stance, &point.x).to_vec();
        for i in 0..self.layout.jumpers {
            let force = nodes[self.system.index(self.leg_force[i])];
            let gap = self.floor(i, &point.x) - point.x[self.layout.z(i)];
            point.modes[i] = match self.setup.contact {
                ContactLaw::ReactionForce => mode(force > 0.0, FLIGHT),
                ContactLaw::Gap if gap > 0.0 => mode(force > 0.0, LIFTED),
                ContactLaw::Gap | ContactLaw::RelaxingLeg => mode(gap > 0.0, FLIGHT),
            };
            if self.layout.legs {
                point.x[self.layout.leg(i)] = gap.max(0.0);
            }
        }
    }

    /// W under body `i`, in the model's units.
    fn floor(&self, i: usize, x: &[f64]) -> f64 {
        let jumper = &self.setup.jumpers[i];
        let psi = self.setup.plate.mode_shape(jumper.x, jumper.y);
        let plate: f64 = psi
            .iter()
            .enumerate()
            .map(|(j, psi)| psi * x[self.layout.r(j)])
            .sum();
        let cos = x[self.layout.len()];
        plate + self.setup.base.amplitude / self.scales.length * cos
    }

    /// A point at phase 0 in the paper's units.
    pub fn section(&self, modes: &[Mode], x: &[f64]) -> Section {
        let layout = self.layout;
        Section {
            z: (0..layout.jumpers).map(|i| self.z(i, x)).collect(),
            v: (0..layout.jumpers).map(|i| self.v(i, x)).collect(),
            w: (0..layout.transverse).map(|j| x[layout.r(j)]).collect(),
            phase: modes.iter().map(|&mode| Contact::of(mode)).collect(),
        }
    }

    /// z/eta of body `i`.
    pub fn z(&self, i: usize, x: &[f64]) -> f64 {
        x[self.layout.z(i)] * self.scales.length / self.scales.jumpers[i].position
    }

    /// z'/(eta omega_h) of body `i`.
    pub fn v(&self, i: usize, x: &[f64]) -> f64 {
        x[self.layout.dz(i)] * self.scales.velocity() / self.scales.jumpers[i].velocity
    }

    /// Forces and positions at any instant.
    pub fn observe(&self, evaluator: &mut Evaluator, modes: &[Mode], x: &[f64]) -> Observation {
        let section = self.section(modes, x);
        let nodes = evaluator.nodes(modes, x);
        let prf = (0..self.layout.jumpers).map(|i| match section.phase[i] {
            Contact::Flight => 0.0,
            Contact::Stance => {
                let acceleration = nodes[self.system.index(self.leg_force[i])];
                acceleration * self.scales.acceleration() / self.setup.gravity
            }
        });
        let prf = prf.collect();
        let floor = (0..self.layout.jumpers)
            .map(|i| self.floor(i, x) * self.scales.length)
            .collect();
        let base = self.setup.base.amplitude * x[self.layout.len()];
        let accelerations = self.setup.jumpers.iter().map(|jumper| {
            let psi = self.setup.plate.mode_shape(jumper.x, jumper.y);
            let terms = psi.iter().zip(&self.plate_acceleration);
            let plate: f64 = terms
                .map(|(psi, node)| psi * nodes[self.system.index(*node)])
                .sum();
            (plate - base / self.scales.length) * self.scales.acceleration()
        });
        Observation {
            floor_acceleration: accelerations.collect(),
            z: section.z,
            v: section.v,
            prf,
            phase: section.phase,
            w: section.w,
            floor,
            base,
        }
    }

    /// This state of `other` in the units of this model: positions and velocities stay what they
    /// are in SI units. The state itself, to the bit, if the units are the same.
    pub fn carry(&self, other: &Self, point: &Point) -> Point {
        let mut out = point.clone();
        let (length, speed) = (
            other.scales.length / self.scales.length,
            other.scales.velocity() / self.scales.velocity(),
        );
        if length == 1.0 && speed == 1.0 {
            return out;
        }
        let layout = self.layout;
        for i in 0..layout.in_plane {
            out.x[layout.p(i)] *= length;
            out.x[layout.dp(i)] *= speed;
        }
        for j in 0..layout.transverse {
            out.x[layout.r(j)] *= length;
            out.x[layout.dr(j)] *= speed;
        }
        for i in 0..layout.jumpers {
            out.x[layout.z(i)] *= length;
            out.x[layout.dz(i)] *= speed;
            if layout.legs {
                out.x[layout.leg(i)] *= length;
            }
        }
        out
    }
}

fn mode(stance: bool, otherwise: Mode) -> Mode {
    if stance { STANCE } else { otherwise }
}
