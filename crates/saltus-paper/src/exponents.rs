//! The largest Lyapunov exponent along each panel of Fig. 2.

use saltus::orbits::Exponent;
use saltus::physics::{ContactLaw, FrequencyReference};
use saltus::study::{Control, StudyError, lyapunov_of_states};

use crate::diagrams::Diagram;
use crate::effort::Effort;
use crate::setting::RATIOS;

/// The exponent of the motion on which the up-sweep ends, at each damping ratio of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelExponents {
    /// Omega/omega_h.
    pub ratio: f64,
    /// (zeta_h, exponent per forcing period), zeta_h ascending.
    pub values: Vec<(f64, Exponent)>,
}

/// The exponents along the up-sweeps of the paper's law under the occupied reading.
///
/// # Errors
/// [`StudyError`] for options out of range or when stopped.
pub fn panel_exponents(
    diagrams: &[Diagram],
    effort: &Effort,
    control: &Control,
) -> Result<Vec<PanelExponents>, StudyError> {
    let wanted = |d: &&Diagram| {
        d.law == ContactLaw::ReactionForce && d.reference == FrequencyReference::Occupied
    };
    let panel = |diagram: &Diagram| {
        let ended = diagram
            .pass(0)
            .filter_map(|row| Some((row.value, row.end.clone()?)));
        let starts = ended.map(|(zeta, end)| Ok((diagram.model(zeta)?, end)));
        let starts = starts.collect::<Result<Vec<_>, StudyError>>()?;
        let found = lyapunov_of_states(&starts, 1, effort.panel_exponent_periods, control)?;
        let values = starts.iter().zip(found).filter_map(|((model, _), growth)| {
            let zeta = model.setup().jumpers[0].damping_ratio;
            Some((zeta, growth.largest()?))
        });
        Ok(PanelExponents {
            ratio: diagram.ratio,
            values: values.collect(),
        })
    };
    diagrams.iter().filter(wanted).map(panel).collect()
}

impl Effort {
    /// Periods of these, for a progress display.
    pub fn panel_periods(&self) -> u64 {
        (RATIOS.len() * self.values) as u64 * (self.panel_exponent_periods + 100)
    }
}
