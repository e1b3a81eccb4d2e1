//! The plate: geometry, material, and the coefficients that are one formula each. DP Eqs. (1)-(5).

use super::{InPlaneBasis, Jumper, Mode, ModeSet, PhysicsError};
use std::f64::consts::PI;

/// A simply supported rectangular plate with edges held in their plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Length a along x (m).
    pub length: f64,
    /// Width b along y (m).
    pub width: f64,
    /// Thickness h (m).
    pub thickness: f64,
    /// Young's modulus E (Pa).
    pub youngs_modulus: f64,
    /// Mass density rho (kg/m^3).
    pub density: f64,
    /// Poisson's ratio nu (-).
    pub poisson_ratio: f64,
    /// Damping ratio zeta_p of the first mode (-); damping is mass-proportional,
    /// c = 2 zeta_p omega_11.
    pub damping_ratio: f64,
    /// Terms of the displacement fields.
    pub modes: ModeSet,
    /// Shape of the in-plane terms.
    pub basis: InPlaneBasis,
}

impl Plate {
    /// The concrete plate of DP section 3.
    pub fn dias_del_prado() -> Self {
        Self {
            length: 14.0,
            width: 10.0,
            thickness: 0.10,
            youngs_modulus: 27e9,
            density: 2500.0,
            poisson_ratio: 0.2,
            damping_ratio: 0.02,
            modes: ModeSet::dias_del_prado(),
            basis: InPlaneBasis::Fixed,
        }
    }

    /// Checks every number and the lists of modes.
    ///
    /// # Errors
    /// [`PhysicsError::OutOfRange`] naming the field, [`PhysicsError::Modes`], or
    /// [`PhysicsError::Algebra`] if mass or stiffness overflow or vanish although every number is
    /// in range.
    pub fn check(&self) -> Result<(), PhysicsError> {
        let positive = "a positive number is needed";
        for (field, value) in [
            ("plate.length", self.length),
            ("plate.width", self.width),
            ("plate.thickness", self.thickness),
            ("plate.youngs_modulus", self.youngs_modulus),
            ("plate.density", self.density),
        ] {
            PhysicsError::require(value > 0.0, field, value, positive)?;
        }
        PhysicsError::require(
            -1.0 < self.poisson_ratio && self.poisson_ratio < 0.5,
            "plate.poisson_ratio",
            self.poisson_ratio,
            "a number between -1 and 0.5, both excluded, is needed",
        )?;
        PhysicsError::require(
            self.damping_ratio >= 0.0,
            "plate.damping_ratio",
            self.damping_ratio,
            "zero or a positive number is needed",
        )?;
        self.modes.check(self.basis)?;
        let mut derived = self.bending_stiffness();
        derived.extend([
            self.modal_mass(),
            self.extensional_stiffness(),
            self.first_omega(),
        ]);
        if derived
            .iter()
            .all(|&value| value.is_normal() && value > 0.0)
        {
            Ok(())
        } else {
            Err(self.overflow())
        }
    }

    /// The error for coefficients that cannot be represented.
    pub(super) fn overflow(&self) -> PhysicsError {
        PhysicsError::Algebra {
            what: "plate stiffness",
            reason: "a coefficient overflows or vanishes; are the plate's numbers in SI units?"
                .into(),
        }
    }

    /// C = E h/(1 - nu^2) (N/m).
    pub fn extensional_stiffness(&self) -> f64 {
        self.youngs_modulus * self.thickness / (1.0 - self.poisson_ratio.powi(2))
    }

    /// D = E h^3/(12 (1 - nu^2)) (N m).
    pub fn flexural_rigidity(&self) -> f64 {
        self.extensional_stiffness() * self.thickness.powi(2) / 12.0
    }

    /// Modal mass of a sine-sine term, M = rho h a b/4 (kg).
    pub fn modal_mass(&self) -> f64 {
        self.density * self.thickness * self.length * self.width / 4.0
    }

    /// Natural frequency of the half-wave `mode` (rad/s):
    /// omega_mn = pi^2 ((m/a)^2 + (n/b)^2) sqrt(D/(rho h)).
    pub fn omega(&self, mode: Mode) -> f64 {
        self.laplacian(mode) * (self.flexural_rigidity() / (self.density * self.thickness)).sqrt()
    }

    /// omega_11 (rad/s), whether or not the list w holds (1, 1).
    pub fn first_omega(&self) -> f64 {
        self.omega(Mode::new(1, 1))
    }

    /// Damping rate c = 2 zeta_p omega_11 (1/s), DP Eq. (5) divided by rho h.
    pub fn damping(&self) -> f64 {
        2.0 * self.damping_ratio * self.first_omega()
    }

    /// Diagonal of K_b (N/m), one entry per w term: D (a b/4) ((m pi/a)^2 + (n pi/b)^2)^2.
    pub fn bending_stiffness(&self) -> Vec<f64> {
        let scale = self.flexural_rigidity() * self.length * self.width / 4.0;
        self.modes
            .w
            .iter()
            .map(|&mode| scale * self.laplacian(mode).powi(2))
            .collect()
    }

    /// G_j = rho h ∫ psi_j = 16 M/(pi^2 m n) (kg) for odd m and n, else 0; one entry per w term.
    ///
    /// DP Eqs. (9c), (11b) print 4^2/pi^2 for every term, which is right for (1, 1) only.
    pub fn base_load(&self) -> Vec<f64> {
        self.modes
            .w
            .iter()
            .map(|&mode| 4.0 * self.modal_mass() * mean_of_shape(mode))
            .collect()
    }

    /// psi_j(x, y) = sin(m pi x/a) sin(n pi y/b) (-), one entry per w term; x and y in m.
    pub fn mode_shape(&self, x: f64, y: f64) -> Vec<f64> {
        let at = |&Mode { m, n }: &Mode| {
            (f64::from(m) * PI * x / self.length).sin() * (f64::from(n) * PI * y / self.width).sin()
        };
        self.modes.w.iter().map(at).collect()
    }

    /// w(x, y) (m) of the transverse amplitudes `r` (m), one per w term.
    pub fn deflection_at(&self, r: &[f64], x: f64, y: f64) -> f64 {
        self.mode_shape(x, y)
            .iter()
            .zip(r)
            .map(|(psi, r)| psi * r)
            .sum()
    }

    /// Is (x, y) inside the plate, 0 < x < a and 0 < y < b?
    pub fn contains(&self, x: f64, y: f64) -> bool {
        0.0 < x && x < self.length && 0.0 < y && y < self.width
    }

    /// Does every w term vanish where the jumper stands (to 1e-12 of its largest value), so that
    /// plate and jumper cannot feel each other?
    pub fn on_nodal_lines(&self, jumper: &Jumper) -> bool {
        self.mode_shape(jumper.x, jumper.y)
            .iter()
            .all(|psi| psi.abs() <= 1e-12)
    }

    /// (m pi/a)^2 + (n pi/b)^2 (1/m^2), minus the Laplacian's eigenvalue.
    fn laplacian(&self, Mode { m, n }: Mode) -> f64 {
        let (m, n) = (f64::from(m), f64::from(n));
        PI.powi(2) * ((m / self.length).powi(2) + (n / self.width).powi(2))
    }
}

/// Mean of sin(m pi x/a) sin(n pi y/b) over the plate: 4/(pi^2 m n) for odd m and n, else 0.
pub(super) fn mean_of_shape(Mode { m, n }: Mode) -> f64 {
    if m % 2 == 1 && n % 2 == 1 {
        4.0 / (PI.powi(2) * f64::from(m) * f64::from(n))
    } else {
        0.0
    }
}
