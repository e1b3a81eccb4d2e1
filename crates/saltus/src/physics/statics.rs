//! Static deflection: K_b r + 4 Q_eff r r r = f, with and without the cubic term.
//!
//! Newton's method with load stepping. The in-plane terms follow statically (Q_eff), so the answer
//! is that of the full plate, not of an approximation to it.

use super::plate::mean_of_shape;
use super::{Elasticity, Jumper, PhysicsError, Plate, algebra};

const WHAT: &str = "static deflection";
/// The last Newton step must be smaller than this part of the deflection, both measured by the
/// root of their bending energy.
const TOLERANCE: f64 = 1e-12;
/// Newton needs about 6 iterations for a load step that it can do at all.
const MAX_ITERATIONS: u32 = 40;
/// Load steps smaller than this part of the load mean that the path does not go on.
const SMALLEST_STEP: f64 = 1e-6;

/// A static transverse load, positive along +w (upwards).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    /// Uniform pressure q (Pa).
    Pressure(f64),
    /// A force at one point.
    Point {
        /// Position (m).
        x: f64,
        /// Position (m).
        y: f64,
        /// Force (N).
        force: f64,
    },
}

impl Load {
    /// The weight of a jumper at rest where he stands, -m_h g (N); `gravity` in m/s^2.
    pub fn weight(jumper: &Jumper, gravity: f64) -> Self {
        Self::Point {
            x: jumper.x,
            y: jumper.y,
            force: -jumper.mass * gravity,
        }
    }

    fn check(&self, plate: &Plate) -> Result<(), PhysicsError> {
        let number = "a finite number is needed";
        match *self {
            Self::Pressure(q) => PhysicsError::require(true, "load.pressure", q, number),
            Self::Point { x, y, force } => {
                let (on_x, on_y) = (0.0 < x && x < plate.length, 0.0 < y && y < plate.width);
                PhysicsError::require(on_x, "load.x", x, "a position inside the plate is needed")?;
                PhysicsError::require(on_y, "load.y", y, "a position inside the plate is needed")?;
                PhysicsError::require(true, "load.force", force, number)
            }
        }
    }
}

impl Plate {
    /// Generalized forces f_j (N) of all `loads` together, one per w term: ∫ q psi_j for a
    /// pressure, force psi_j(x, y) for a point load.
    ///
    /// # Errors
    /// Those of [`Plate::check`]; [`PhysicsError::OutOfRange`] for a load that is not finite or not
    /// on the plate.
    pub fn generalized_load(&self, loads: &[Load]) -> Result<Vec<f64>, PhysicsError> {
        self.check()?;
        let mut f = vec![0.0; self.modes.w.len()];
        for load in loads {
            load.check(self)?;
            let shares: Vec<f64> = match *load {
                Load::Pressure(q) => {
                    let force = q * self.length * self.width;
                    self.modes
                        .w
                        .iter()
                        .map(|&mode| force * mean_of_shape(mode))
                        .collect()
                }
                Load::Point { x, y, force } => self
                    .mode_shape(x, y)
                    .iter()
                    .map(|psi| force * psi)
                    .collect(),
            };
            f.iter_mut().zip(shares).for_each(|(f, share)| *f += share);
        }
        Ok(f)
    }

    /// Amplitudes r (m), one per w term, of the linear plate under `loads`: r_j = f_j/K_bj
    /// (Navier's series). See [`Plate::deflection_at`] for the deflection at a point.
    ///
    /// Needs no tensors, so thousands of terms are no trouble.
    ///
    /// # Errors
    /// Those of [`Plate::generalized_load`].
    pub fn linear_deflection(&self, loads: &[Load]) -> Result<Vec<f64>, PhysicsError> {
        let f = self.generalized_load(loads)?;
        Ok(f.iter()
            .zip(self.bending_stiffness())
            .map(|(f, k)| f / k)
            .collect())
    }

    /// Amplitudes r (m), one per w term, of the von Karman plate under `loads`.
    ///
    /// # Errors
    /// Those of [`Plate::elasticity`], [`Plate::generalized_load`] and [`Elasticity::deflection`].
    pub fn deflection(&self, loads: &[Load]) -> Result<Vec<f64>, PhysicsError> {
        let f = self.generalized_load(loads)?;
        self.elasticity()?.deflection(&f)
    }
}

impl Elasticity {
    /// Amplitudes r (m) in equilibrium with the generalized forces `f` (N), both of length N_w, on
    /// the branch that grows from the unloaded plate.
    ///
    /// Newton's method with backtracking, some 10 to 30 iterations; with 100 w terms each takes
    /// tens of milliseconds. The first load step is as large as the linear solution
    /// says is safe; a step that fails is halved, one that succeeds is doubled.
    ///
    /// # Errors
    /// [`PhysicsError::NotConverged`] if the last step is not below 1e-12 of r;
    /// those of [`Elasticity::condensed_hessian`].
    ///
    /// # Panics
    /// If `f` is not N_w long.
    pub fn deflection(&self, f: &[f64]) -> Result<Vec<f64>, PhysicsError> {
        assert_eq!(f.len(), self.bending.len(), "one force per w term");
        let balance = Balance {
            plate: self,
            load: f,
        };
        let mut r = vec![0.0; f.len()];
        let (mut reached, mut step, mut iterations) = (0.0, balance.first_step(), 0);
        while reached < 1.0 {
            let target = f64::min(reached + step, 1.0);
            match balance.newton(&r, target, &mut iterations)? {
                Some(found) => {
                    (r, reached) = (found, target);
                    step *= 2.0;
                }
                None => step /= 2.0,
            }
            if step < SMALLEST_STEP {
                return Err(PhysicsError::NotConverged {
                    what: WHAT,
                    iterations,
                    reached,
                });
            }
        }
        Ok(r)
    }
}

/// The equations of equilibrium.
struct Balance<'a> {
    plate: &'a Elasticity,
    load: &'a [f64],
}

impl Balance<'_> {
    /// The part of the load at which the linear deflection's cubic forces are a third of its
    /// bending forces.
    fn first_step(&self) -> f64 {
        let linear: Vec<f64> = self
            .load
            .iter()
            .zip(&self.plate.bending)
            .map(|(f, k)| f / k)
            .collect();
        let bending: f64 = linear.iter().zip(self.load).map(|(r, f)| r * f).sum();
        if bending == 0.0 {
            return 1.0;
        }
        let excess = 3.0 * 4.0 * self.plate.condensed_stretching(&linear) / bending;
        (1.0 / excess.max(1.0).sqrt()).max(SMALLEST_STEP)
    }

    /// Newton's method from `start` at `part` of the load; `None` if it does not converge.
    fn newton(
        &self,
        start: &[f64],
        part: f64,
        iterations: &mut u32,
    ) -> Result<Option<Vec<f64>>, PhysicsError> {
        let size = start.len();
        let mut r = start.to_vec();
        let mut residual = self.residual(&r, part);
        for _ in 0..MAX_ITERATIONS {
            *iterations += 1;
            if !residual.iter().all(|value| value.is_finite()) {
                return Ok(None);
            }
            let step = algebra::solve(WHAT, size, &self.plate.condensed_hessian(&r)?, &residual)?;
            let full = moved(&r, 1.0, &step);
            let (step_size, full_size) = (self.energy_norm(&step), self.energy_norm(&full));
            if !(step_size.is_finite() && full_size.is_finite()) {
                return Ok(None);
            }
            if step_size <= TOLERANCE * full_size {
                return Ok(Some(full));
            }
            // backtracking on the residual, measured by the bending energy it would cause
            let size_now = self.load_norm(&residual);
            let halvings = (0..30).map(|halving| 0.5_f64.powi(halving));
            let better = halvings
                .map(|length| (length, moved(&r, length, &step)))
                .find(|(length, trial)| {
                    self.load_norm(&self.residual(trial, part)) <= (1.0 - 1e-4 * length) * size_now
                });
            let Some((_, trial)) = better else {
                return Ok(None);
            };
            r = trial;
            residual = self.residual(&r, part);
        }
        Ok(None)
    }

    /// part f - K_b r - 4 Q_eff r r r (N).
    fn residual(&self, r: &[f64], part: f64) -> Vec<f64> {
        let force = self.plate.condensed_force(r);
        force
            .iter()
            .zip(self.load)
            .map(|(force, load)| part * load - force)
            .collect()
    }

    /// sqrt(r.K_b r)
    fn energy_norm(&self, r: &[f64]) -> f64 {
        r.iter()
            .zip(&self.plate.bending)
            .map(|(r, k)| k * r * r)
            .sum::<f64>()
            .sqrt()
    }

    /// sqrt(f.K_b^-1 f)
    fn load_norm(&self, f: &[f64]) -> f64 {
        f.iter()
            .zip(&self.plate.bending)
            .map(|(f, k)| f * f / k)
            .sum::<f64>()
            .sqrt()
    }
}

fn moved(r: &[f64], length: f64, step: &[f64]) -> Vec<f64> {
    r.iter()
        .zip(step)
        .map(|(r, step)| r + length * step)
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::physics::{Mode, ModeSet};

    fn one_mode() -> Plate {
        let w = vec![Mode::new(1, 1)];
        Plate {
            modes: ModeSet {
                w,
                ..ModeSet::dias_del_prado()
            },
            ..Plate::dias_del_prado()
        }
    }

    #[test]
    fn one_term_obeys_its_cubic_equation() {
        let plate = one_mode();
        let elasticity = plate.elasticity().unwrap();
        let cubic = 4.0 * elasticity.condensed_quartic().unwrap()[0].value;
        for pressure in [1.0, -1e4, 1e6, 1e12] {
            let f = plate.generalized_load(&[Load::Pressure(pressure)]).unwrap()[0];
            let r = plate.deflection(&[Load::Pressure(pressure)]).unwrap()[0];
            let force = elasticity.bending[0] * r + cubic * r.powi(3);
            // the force is at most three times as sensitive to r as r itself (1e-12)
            assert!(
                (force / f - 1.0).abs() < 1e-11,
                "{pressure} Pa: {force} N for {f} N"
            );
        }
    }

    #[test]
    fn light_loads_bend_the_plate_linearly() {
        let plate = Plate::dias_del_prado();
        let load = [Load::weight(&Jumper::dias_del_prado(14.0, 10.0), 9.81)];
        let linear = plate.linear_deflection(&load).unwrap();
        let nonlinear = plate.deflection(&load).unwrap();
        assert!(linear[0] < 0.0, "a weight pushes the plate down");
        // r_11 = 0.004 h, so cubic forces are about 1.5 * 0.004^2 of the bending force in w_11, and
        // the deflections they cause in stiffer terms are smaller still
        for (linear_j, nonlinear_j) in linear.iter().zip(&nonlinear) {
            assert!((linear_j - nonlinear_j).abs() < 5e-5 * linear[0].abs());
        }
    }

    #[test]
    fn no_load_no_deflection() {
        assert_eq!(Plate::dias_del_prado().deflection(&[]), Ok(vec![0.0; 4]));
        assert_eq!(
            Plate::dias_del_prado().deflection(&[Load::Pressure(0.0)]),
            Ok(vec![0.0; 4])
        );
    }

    #[test]
    fn loads_add_up_and_turn_over() {
        let plate = Plate::dias_del_prado();
        let up = plate
            .deflection(&[Load::Pressure(3e3), Load::Pressure(2e3)])
            .unwrap();
        let down = plate.deflection(&[Load::Pressure(-5e3)]).unwrap();
        for (up, down) in up.iter().zip(&down) {
            assert!((up + down).abs() < 1e-11 * up.abs());
        }
    }

    #[test]
    fn bad_loads_are_refused() {
        let plate = Plate::dias_del_prado();
        let point = |x, y, force| plate.deflection(&[Load::Point { x, y, force }]);
        for (result, field) in [
            (
                plate.deflection(&[Load::Pressure(f64::NAN)]),
                "load.pressure",
            ),
            (point(14.0, 5.0, 1.0), "load.x"),
            (point(7.0, f64::NAN, 1.0), "load.y"),
            (point(7.0, 5.0, f64::INFINITY), "load.force"),
        ] {
            assert!(
                result.unwrap_err().to_string().starts_with(field),
                "{field}"
            );
        }
        // a load whose deflection cannot be represented is an error, not a NaN
        assert!(plate.deflection(&[Load::Pressure(1e300)]).is_err());
    }
}
