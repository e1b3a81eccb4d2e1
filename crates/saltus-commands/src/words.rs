//! Words that several answers share.

use crate::failure::CommandError;
use saltus::model::{Contact, Model};
use saltus_config::{Parameter, Study};

/// Refuses a key that asks for more Lyapunov exponents than there are; `zero` says what 0 means there.
pub(crate) fn too_many_exponents(
    key: &str,
    asked: usize,
    states: usize,
    zero: &str,
) -> CommandError {
    CommandError::refused(
        format!(
            "{key} = {asked}: there is one exponent per state, and the model has {states} states"
        ),
        format!("1 to {states} would do, or 0 for {zero}"),
    )
}

/// Said in the titles of figures, because a figure leaves its folder.
pub(crate) fn setting(study: &Study, model: &Model) -> String {
    let hertz = model.scales().omega / std::f64::consts::TAU;
    match study.jumper.as_slice() {
        [one] => format!("ζ_h = {}, base {hertz:.4} Hz", one.damping_ratio),
        _ => format!("base {hertz:.4} Hz"),
    }
}

/// The base in a title, because a figure leaves its folder; empty if the base is what changes.
pub(crate) fn base_in_title(study: &Study, parameter: Option<&Parameter>) -> String {
    let changes = parameter.is_some_and(|p| p.key().starts_with("base.frequency"));
    let omega = study.base().omega(&study.plate(), &study.jumpers()).ok();
    let omega = omega.filter(|_| !changes);
    omega.map_or(String::new(), |omega| {
        format!("base {:.4} Hz, ", omega / std::f64::consts::TAU)
    })
}

/// A number as people write it: 4.2 and not 4.199999999999999.
pub(crate) fn short(number: f64) -> f64 {
    // a text of a number is one
    format!("{number:.12e}").parse().unwrap_or(number)
}

/// As the first word of a label.
pub(crate) fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// Word for a contact state.
pub(crate) fn phase(contact: Contact) -> &'static str {
    match contact {
        Contact::Stance => "contact",
        Contact::Flight => "flight",
    }
}
