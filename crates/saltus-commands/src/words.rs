//! Words that several answers share.

use crate::failure::CommandError;
use saltus::model::{Contact, Model};
use saltus::study::Pass;
use saltus_config::{Parameter, Study};
use saltus_results::Axis;

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
        [one] => format!("$ζ_h$ = {}, base {hertz:.4} Hz", one.damping_ratio),
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

/// Axis labels of the section, in which symbols are typeset.
pub(crate) const SECTION_HEIGHT: &str = "Height $z/η$ at $cos Ωt = 1$";
pub(crate) const SECTION_VELOCITY: &str = "Velocity $ż/(η ω_h)$ at $cos Ωt = 1$";
pub(crate) const HEIGHT: &str = "Height $z/η$";
pub(crate) const VELOCITY: &str = "Velocity $ż/(η ω_h)$";

/// The axis of a parameter: name, symbol, unit.
pub(crate) fn axis(parameter: &Parameter) -> Axis {
    let (label, symbol) = (parameter.label(), parameter.symbol());
    Axis::new(capitalized(&label.replacen(
        symbol,
        &format!("${symbol}$"),
        1,
    )))
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

/// Words for a way through the values; that of a start is told apart from others by its initial condition.
pub(crate) fn direction(pass: &Pass) -> String {
    match pass {
        Pass::Up => "up".to_owned(),
        Pass::Down => "down".to_owned(),
        Pass::Start((z, v)) => format!("start {z} {v}"),
    }
}

/// Word for a contact state.
pub(crate) fn phase(contact: Contact) -> &'static str {
    match contact {
        Contact::Stance => "contact",
        Contact::Flight => "flight",
    }
}
