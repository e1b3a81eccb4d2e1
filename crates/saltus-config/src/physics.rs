//! From the study file's words to the records of [`saltus::physics`].

use crate::study::{Basis, JumperTable, Law, Modes, Reference, Study};
use saltus::physics;

impl Study {
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

    /// When feet leave the floor and come back.
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
