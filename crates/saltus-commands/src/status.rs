//! How a run ended, in the words of a study: seconds, and keys of the file.

use saltus::hybrid::Status;

/// One line; `omega` (rad/s) turns the engine's time into seconds, without it no time is given.
pub(crate) fn text(status: &Status, omega: Option<f64>) -> String {
    let by = |time: f64| {
        omega.map_or(String::new(), |omega| {
            format!(" by t = {:.6} s", time / omega)
        })
    };
    match *status {
        Status::Completed => "completed".to_owned(),
        Status::Chattering {
            time,
            count,
            at_once: true,
        } => format!(
            "chattering: {count} take-offs and touch-downs at one instant{}: a body rests where its contact \
             switches, and the contact law has no mode for that",
            by(time)
        ),
        Status::Chattering { time, count, .. } => format!(
            "chattering: {count} take-offs and touch-downs within one forcing period{}; \
             if they are real, allow more by solver.max_switches",
            by(time)
        ),
        Status::NotFinite { time, .. } => format!(
            "the motion grew beyond all numbers{}: smaller steps or a smaller base.amplitude may help",
            by(time)
        ),
        Status::TooManySteps { time, count } => format!(
            "{count} steps within one forcing period{}: a larger solver.tolerance needs fewer",
            by(time)
        ),
        ref other => other.to_string(),
    }
}
