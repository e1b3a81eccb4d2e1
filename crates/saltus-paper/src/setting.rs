//! The setup of the paper, with what it leaves open as arguments.

use saltus::model::{Inertia, Setup};
use saltus::physics::{Base, BaseFrequency, ContactLaw, FrequencyReference};

/// Omega/omega_h of the panels a, b, c of Fig. 2.
pub const RATIOS: [f64; 3] = [0.9, 1.0, 1.1];

/// The paper's setup at a damping ratio, with its open questions answered: meaning of omega_h, contact law and inertia.
pub(crate) fn setup(
    damping_ratio: f64,
    ratio: f64,
    reference: FrequencyReference,
    contact: ContactLaw,
    inertia: Inertia,
) -> Setup {
    let setup = Setup::dias_del_prado(damping_ratio, ratio);
    let frequency = BaseFrequency::Ratio { ratio, reference };
    Setup {
        base: Base {
            frequency,
            ..setup.base
        },
        contact,
        inertia,
        ..setup
    }
}
