//! From the study file to the records of [`saltus::physics`] and the options of the engine.

use crate::study::{Basis, Inertia, JumperTable, Law, Method, Modes, Reference, Study};
use saltus::{hybrid, model, physics};

impl Study {
    /// The whole physical system.
    pub fn setup(&self) -> model::Setup {
        model::Setup {
            plate: self.plate(),
            jumpers: self.jumpers(),
            contact: self.contact_law(),
            base: self.base(),
            gravity: self.gravity(),
            inertia: self.plate.inertia.into(),
        }
    }

    /// Options of the integration. The engine counts the switches of all jumpers together.
    pub fn options(&self) -> hybrid::Options {
        let (solver, usual) = (&self.solver, hybrid::Options::default());
        let people = u32::try_from(self.jumper.len()).unwrap_or(u32::MAX).max(1);
        hybrid::Options {
            method: match solver.method {
                Method::Taylor => hybrid::Method::taylor(solver.tolerance),
                Method::Rk4 => hybrid::Method::Rk4 {
                    steps_per_period: solver.steps_per_period,
                },
            },
            max_switches: solver.max_switches.saturating_mul(people),
            // steps that were asked for are not too many; each switch costs one more
            max_steps: solver
                .steps_per_period
                .saturating_mul(2)
                .max(usual.max_steps),
            ..usual
        }
    }

    /// The plate, terms and all.
    pub fn plate(&self) -> physics::Plate {
        let plate = &self.plate;
        let basis = plate.basis.into();
        physics::Plate {
            length: plate.length,
            width: plate.width,
            thickness: plate.thickness,
            youngs_modulus: plate.youngs_modulus,
            density: plate.density,
            poisson_ratio: plate.poisson_ratio,
            damping_ratio: plate.damping_ratio,
            modes: mode_set(&plate.modes, basis),
            basis,
        }
    }

    /// The people, in the order of the file.
    pub fn jumpers(&self) -> Vec<physics::Jumper> {
        self.jumper.iter().map(physics::Jumper::from).collect()
    }

    /// The law that decides when feet leave the floor and touch down.
    pub fn contact_law(&self) -> physics::ContactLaw {
        self.contact.law.into()
    }

    /// The base motion. A checked study gives exactly one of frequency and ratio.
    pub fn base(&self) -> physics::Base {
        let frequency = match (self.base.frequency, self.base.frequency_ratio) {
            (Some(hertz), _) => physics::BaseFrequency::Hertz(hertz),
            (None, ratio) => physics::BaseFrequency::Ratio {
                ratio: ratio.unwrap_or(f64::NAN),
                reference: self.base.reference.into(),
            },
        };
        physics::Base {
            amplitude: self.base.amplitude,
            frequency,
        }
    }

    /// Acceleration of gravity g (m/s²).
    pub fn gravity(&self) -> f64 {
        self.gravity.acceleration
    }
}

fn mode_set(modes: &Modes, basis: physics::InPlaneBasis) -> physics::ModeSet {
    let terms = |list: &[[u32; 2]]| {
        list.iter()
            .map(|&[m, n]| physics::Mode::new(m, n))
            .collect()
    };
    match modes {
        Modes::Paper => physics::ModeSet::dias_del_prado(),
        Modes::Complete { m, n } => physics::ModeSet::complete(*m, *n, basis),
        Modes::Lists(lists) => physics::ModeSet {
            u: terms(&lists.u),
            v: terms(&lists.v),
            w: terms(&lists.w),
        },
    }
}

impl From<&JumperTable> for physics::Jumper {
    fn from(jumper: &JumperTable) -> Self {
        Self {
            x: jumper.x,
            y: jumper.y,
            mass: jumper.mass,
            stiffness: jumper.stiffness,
            damping_ratio: jumper.damping_ratio,
        }
    }
}

impl From<Basis> for physics::InPlaneBasis {
    fn from(basis: Basis) -> Self {
        match basis {
            Basis::Fixed => Self::Fixed,
            Basis::ShearFree => Self::ShearFree,
        }
    }
}

impl From<Inertia> for model::Inertia {
    fn from(inertia: Inertia) -> Self {
        match inertia {
            Inertia::Full => Self::Full,
            Inertia::SlowManifold => Self::SlowManifold,
            Inertia::Condensed => Self::Condensed,
        }
    }
}

impl From<Law> for physics::ContactLaw {
    fn from(law: Law) -> Self {
        match law {
            Law::ReactionForce => Self::ReactionForce,
            Law::Gap => Self::Gap,
            Law::RelaxingLeg => Self::RelaxingLeg,
        }
    }
}

impl From<Reference> for physics::FrequencyReference {
    fn from(reference: Reference) -> Self {
        match reference {
            Reference::Occupied => Self::Occupied,
            Reference::Free => Self::Free,
            Reference::Plate => Self::Plate,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Inertia, Method, Study};
    use saltus::{hybrid, model};

    #[test]
    fn the_paper_is_the_librarys_paper() {
        let mut study = Study::paper();
        study.plate.inertia = Inertia::Condensed;
        assert_eq!(study.setup(), model::Setup::dias_del_prado(0.3, 1.0));
        assert_eq!(study.options(), hybrid::Options::default());
    }

    #[test]
    fn limits_leave_room_for_every_jumper_and_every_step() {
        let mut study = Study::paper();
        study.jumper = vec![study.jumper[0].clone(); 3];
        study.solver.method = Method::Rk4;
        study.solver.steps_per_period = 5_000_000;
        let options = study.options();
        assert_eq!(options.max_switches, 300);
        assert!(options.max_steps > 5_000_000);
    }
}
