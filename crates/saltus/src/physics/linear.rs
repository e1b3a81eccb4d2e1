//! Natural frequencies: of the empty plate, in its plane, and with people standing on it.

use super::{Jumper, PhysicsError, Plate, algebra, in_plane};
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};

/// Undamped linear modes of the plate with every jumper in contact.
#[derive(Clone, Debug, PartialEq)]
pub struct OccupiedModes {
    /// Frequencies (Hz), ascending; N_w + number of jumpers of them.
    pub hz: Vec<f64>,
    /// One vector per frequency, over (r_1 .. r_Nw, z_1 .. z_J): scaled to unit modal mass
    /// (1/sqrt(kg)), its largest contribution to the kinetic energy positive.
    pub shapes: Vec<Vec<f64>>,
    /// The mode in which the first jumper carries the largest share of the kinetic energy: the
    /// "human body" frequency of DP section 3. `None` without jumpers.
    pub body_index: Option<usize>,
}

impl Plate {
    /// Transverse frequencies of the empty plate (Hz), one per w term, ascending.
    ///
    /// # Errors
    /// Those of [`Plate::check`].
    pub fn frequencies_hz(&self) -> Result<Vec<f64>, PhysicsError> {
        self.check()?;
        let mut hz: Vec<f64> = self
            .modes
            .w
            .iter()
            .map(|&mode| self.omega(mode) / TAU)
            .collect();
        hz.sort_by(f64::total_cmp);
        Ok(hz)
    }

    /// In-plane frequencies (Hz), one per u and v term, ascending: K p = omega^2 M p.
    ///
    /// # Errors
    /// Those of [`Plate::check`]; [`PhysicsError::Algebra`] if the eigenvalues cannot be computed.
    pub fn in_plane_frequencies_hz(&self) -> Result<Vec<f64>, PhysicsError> {
        self.in_plane_frequencies_hz_until(&AtomicBool::new(false))
    }

    /// As [`Self::in_plane_frequencies_hz`] until `stop` is raised: those of thousands of terms take seconds.
    ///
    /// Terms of different symmetry do not feel each other, so K falls into blocks, and each is solved by itself: four
    /// for a complete set of [`InPlaneBasis::Fixed`](super::InPlaneBasis::Fixed), many of a pair for the other one.
    /// `stop` is looked at between blocks.
    ///
    /// # Errors
    /// As [`Self::in_plane_frequencies_hz`]; [`PhysicsError::Interrupted`].
    pub fn in_plane_frequencies_hz_until(
        &self,
        stop: &AtomicBool,
    ) -> Result<Vec<f64>, PhysicsError> {
        self.check()?;
        let what = "in-plane frequencies";
        let mass = in_plane::in_plane_mass(self);
        let size = mass.len();
        let stiffness = mass_scaled(in_plane::membrane(self), &mass);
        let mut squares = Vec::with_capacity(size);
        for block in blocks(size, &stiffness) {
            if stop.load(Ordering::Relaxed) {
                return Err(PhysicsError::Interrupted);
            }
            let entry = |&row: &usize| block.iter().map(move |col| row * size + col);
            let entries: Vec<f64> = block
                .iter()
                .flat_map(entry)
                .map(|at| stiffness[at])
                .collect();
            squares.extend(algebra::eigenvalues(what, block.len(), &entries)?);
        }
        squares.sort_by(f64::total_cmp);
        frequencies(what, squares)
    }

    /// Frequencies and shapes with all `jumpers` in contact, damping left out:
    ///
    /// ```text
    /// M r_j'' + K_bj r_j + Σ_I psi_j(x_I) k_I (w_I - z_I) = 0,   m_I z_I'' - k_I (w_I - z_I) = 0
    /// ```
    ///
    /// With several equal jumpers "the mode of the first" can be one in which they move against
    /// each other and the plate rests.
    ///
    /// # Errors
    /// Those of [`Plate::check`] and [`Jumper::check`]; [`PhysicsError::OffThePlate`] and
    /// [`PhysicsError::TooManyJumpers`]; [`PhysicsError::Algebra`] if the eigenvalues cannot be computed.
    pub fn occupied(&self, jumpers: &[Jumper]) -> Result<OccupiedModes, PhysicsError> {
        self.check()?;
        Jumper::check_all(jumpers, self)?;
        let transverse = self.modes.w.len();
        let size = transverse + jumpers.len();
        let mut stiffness = vec![0.0; size * size];
        for (j, bending) in self.bending_stiffness().into_iter().enumerate() {
            stiffness[j * size + j] = bending;
        }
        let mut mass = vec![self.modal_mass(); transverse];
        for (index, jumper) in jumpers.iter().enumerate() {
            // 1/2 k (w - z)^2 is a rank-one term with the vector (psi_1 .. psi_Nw, 0 .. -1 .. 0)
            let mut compression = self.mode_shape(jumper.x, jumper.y);
            compression.resize(size, 0.0);
            compression[transverse + index] = -1.0;
            for row in 0..size {
                for col in 0..size {
                    stiffness[row * size + col] +=
                        jumper.stiffness * compression[row] * compression[col];
                }
            }
            mass.push(jumper.mass);
        }
        let what = "occupied frequencies";
        // y = sqrt(mass) x makes the problem symmetric, and y_i^2 the share of kinetic energy
        let pairs = algebra::eigenpairs(what, size, &mass_scaled(stiffness, &mass))?;
        let (squares, vectors): (Vec<f64>, Vec<Vec<f64>>) = pairs.into_iter().unzip();
        let share_of_first = |mode: usize| vectors[mode][transverse].powi(2);
        let body_index = (0..size)
            .filter(|_| !jumpers.is_empty())
            .max_by(|&one, &other| share_of_first(one).total_cmp(&share_of_first(other)));
        let shapes = vectors.iter().map(|y| unscaled(y, &mass)).collect();
        Ok(OccupiedModes {
            hz: frequencies(what, squares)?,
            shapes,
            body_index,
        })
    }
}

/// Groups of rows of a symmetric `size` x `size` matrix that hang together by entries other than 0, in ascending order.
fn blocks(size: usize, a: &[f64]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; size];
    let mut blocks = Vec::new();
    for first in 0..size {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let mut block = vec![first];
        let mut next = 0;
        while let Some(&row) = block.get(next) {
            let entries = a[row * size..][..size].iter().zip(&mut seen).enumerate();
            for (col, (&entry, seen)) in entries {
                if entry != 0.0 && !std::mem::replace(seen, true) {
                    block.push(col);
                }
            }
            next += 1;
        }
        block.sort_unstable();
        blocks.push(block);
    }
    blocks
}

/// M^-1/2 A M^-1/2 for a row-major A and a diagonal M.
fn mass_scaled(mut a: Vec<f64>, mass: &[f64]) -> Vec<f64> {
    let size = mass.len();
    for row in 0..size {
        for col in 0..size {
            a[row * size + col] /= (mass[row] * mass[col]).sqrt();
        }
    }
    a
}

/// x = M^-1/2 y, with the sign that makes the largest component of y positive.
fn unscaled(y: &[f64], mass: &[f64]) -> Vec<f64> {
    let largest = y.iter().copied().fold(
        0.0,
        |best: f64, v| if v.abs() > best.abs() { v } else { best },
    );
    y.iter()
        .zip(mass)
        .map(|(y, mass)| largest.signum() * y / mass.sqrt())
        .collect()
}

/// sqrt(omega^2)/(2 pi) (Hz).
fn frequencies(what: &'static str, squares: Vec<f64>) -> Result<Vec<f64>, PhysicsError> {
    let hz = |square: f64| {
        if square > 0.0 {
            Ok(square.sqrt() / TAU)
        } else {
            let reason =
                format!("omega^2 = {square} (rad/s)^2 is not positive; numbers too far apart?");
            Err(PhysicsError::Algebra { what, reason })
        }
    };
    squares.into_iter().map(hz).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{InPlaneBasis, ModeSet, PhysicsError, Plate, algebra, in_plane};
    use super::{blocks, frequencies, mass_scaled};
    use std::sync::atomic::AtomicBool;

    fn plate(basis: InPlaneBasis, terms: u32) -> Plate {
        Plate {
            modes: ModeSet::complete(terms, terms, basis),
            basis,
            ..Plate::dias_del_prado()
        }
    }

    #[test]
    fn in_plane_frequencies_of_the_blocks_are_those_of_the_whole() {
        for (basis, largest) in [(InPlaneBasis::Fixed, 18), (InPlaneBasis::ShearFree, 2)] {
            let plate = plate(basis, 3);
            let mass = in_plane::in_plane_mass(&plate);
            let stiffness = mass_scaled(in_plane::membrane(&plate), &mass);
            let blocks = blocks(mass.len(), &stiffness);
            let mut all: Vec<usize> = blocks.concat();
            all.sort_unstable();
            assert_eq!(all, (0..mass.len()).collect::<Vec<_>>());
            // u(m, n) feels v(m', n') if m + m' and n + n' are odd: 9 + 9 of 72 terms. Without shear on the edges one
            // of each.
            assert_eq!(blocks.iter().map(Vec::len).max(), Some(largest));
            let whole =
                algebra::eigenvalues("test", mass.len(), &stiffness).expect("a sound plate");
            let whole = frequencies("test", whole).expect("a sound plate");
            let found = plate.in_plane_frequencies_hz().expect("a sound plate");
            for (found, whole) in found.iter().zip(&whole) {
                // rounding of a matrix of 72 rows with entries that differ by 1e3
                assert!((found / whole - 1.0).abs() < 1e-12, "{found} {whole}");
            }
        }
    }

    #[test]
    fn in_plane_frequencies_stop_when_asked() {
        let stop = AtomicBool::new(true);
        let stopped = plate(InPlaneBasis::Fixed, 3).in_plane_frequencies_hz_until(&stop);
        assert_eq!(stopped, Err(PhysicsError::Interrupted));
    }
}
