//! The jumper: one mass on a spring and a damper, free to leave the floor. DP Eqs. (2), (6), (7).
//!
//! # Departures from the paper
//! The leg stiffness is k_h = 18 600 N/m as printed; omega_h follows from it (2.4794 Hz, which the
//! paper rounds to 2.48). With 2.48 Hz exactly the occupied body frequency would round to 2.538 Hz
//! instead of the printed 2.537 Hz.

use super::{PhysicsError, Plate};

/// A person with one vertical degree of freedom, standing at a point of the plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jumper {
    /// Position x_I along the plate's length (m).
    pub x: f64,
    /// Position y_I along the plate's width (m).
    pub y: f64,
    /// Body mass m_h (kg).
    pub mass: f64,
    /// Leg stiffness k_h (N/m).
    pub stiffness: f64,
    /// Damping ratio zeta_h (-).
    pub damping_ratio: f64,
}

impl Jumper {
    /// Most people on a plate. Their frequencies are the eigenvalues of a dense matrix with a row for each, and the
    /// equations of one forcing period take a tenth of a second to set up for 200 of them, half a second for 400.
    pub const MOST: usize = 400;

    /// Natural frequency of the body on rigid ground, omega_h = sqrt(k_h/m_h) (rad/s).
    pub fn omega(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    /// Leg damping c_h = 2 zeta_h m_h omega_h (N s/m), below DP Eq. (6).
    pub fn damping(&self) -> f64 {
        2.0 * self.damping_ratio * self.mass * self.omega()
    }

    /// Static compression of the leg, eta = g/omega_h^2 (m): the paper's unit for z.
    pub fn static_compression(&self, gravity: f64) -> f64 {
        gravity * self.mass / self.stiffness
    }

    /// The person of DP section 3 on a plate `length` x `width`: at the centre, with damping ratio
    /// 0.3.
    pub fn dias_del_prado(length: f64, width: f64) -> Self {
        Self {
            x: length / 2.0,
            y: width / 2.0,
            mass: 76.64,
            stiffness: 18_600.0,
            damping_ratio: 0.3,
        }
    }

    /// Checks the numbers; `index` names the jumper in the message.
    ///
    /// # Errors
    /// [`PhysicsError::OutOfRange`] unless mass and stiffness are positive and finite and the
    /// damping ratio is not negative.
    pub fn check(&self, index: usize) -> Result<(), PhysicsError> {
        let key = |name: &str| format!("jumper.{index}.{name}");
        let positive = "a positive number is needed";
        PhysicsError::require(self.mass > 0.0, key("mass"), self.mass, positive)?;
        PhysicsError::require(
            self.stiffness > 0.0,
            key("stiffness"),
            self.stiffness,
            positive,
        )?;
        PhysicsError::require(
            self.damping_ratio >= 0.0,
            key("damping_ratio"),
            self.damping_ratio,
            "zero or a positive number is needed",
        )
    }

    /// Checks everybody on a plate.
    ///
    /// # Errors
    /// [`PhysicsError::TooManyJumpers`] beyond [`Jumper::MOST`], and those of [`Jumper::check`] and
    /// [`Jumper::check_position`].
    pub(crate) fn check_all(jumpers: &[Self], plate: &Plate) -> Result<(), PhysicsError> {
        let count = jumpers.len();
        if count > Self::MOST {
            return Err(PhysicsError::TooManyJumpers {
                count,
                most: Self::MOST,
            });
        }
        let mut all = jumpers.iter().enumerate();
        all.try_for_each(|(index, jumper)| {
            jumper.check(index)?;
            jumper.check_position(index, plate)
        })
    }

    /// Checks that the jumper stands on the plate and not on its edge; `index` names the jumper.
    ///
    /// # Errors
    /// [`PhysicsError::OffThePlate`] unless 0 < x < a and 0 < y < b (so also for a NaN).
    fn check_position(&self, index: usize, plate: &Plate) -> Result<(), PhysicsError> {
        if plate.contains(self.x, self.y) {
            return Ok(());
        }
        Err(PhysicsError::OffThePlate {
            index,
            x: self.x,
            y: self.y,
            length: plate.length,
            width: plate.width,
        })
    }
}
