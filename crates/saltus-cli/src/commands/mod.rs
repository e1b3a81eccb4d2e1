//! One file per command.

mod attractors;
mod basins;
mod check;
mod continuation;
mod frequencies;
mod init;
mod kinds;
mod lyapunov;
mod map;
mod models;
mod motion;
mod orbit;
mod plane;
mod portrait;
mod repeats;
mod reproduce;
mod schema;
mod simulate;
mod sweep;

use crate::args::{Command, OutputArgs, StudyArgs, ThreadArgs};
use crate::exit::Failure;
use crate::folder::Folder;
use crate::{interrupt, output};
use saltus::model::Model;
use saltus::study::Control;
use saltus_config::{Parameter, Study};
use serde::Serialize;
use std::io;
use std::path::Path;

/// Does what was asked.
pub(crate) fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Reproduce(args) => reproduce::run(&args),
        Command::Init(args) => init::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Schema(args) => schema::run(&args),
        Command::Frequencies(args) => frequencies::run(&args),
        Command::Simulate(args) => simulate::run(&args),
        Command::Sweep(args) => sweep::run(&args),
        Command::Map(args) => map::run(&args),
        Command::Basins(args) => basins::run(&args),
        Command::Orbit(args) => orbit::run(&args),
        Command::Continue(args) => continuation::run(&args),
        Command::Lyapunov(args) => lyapunov::run(&args),
        Command::Attractors(args) => attractors::run(&args),
    }
}

/// Reads the study with its overrides; `more` are overrides that a command's own options stand for.
fn load(args: &StudyArgs, more: &[String]) -> Result<Study, Failure> {
    let sets = [args.sets.as_slice(), more].concat();
    let study = if args.file == Path::new("-") {
        saltus_config::read("standard input", io::stdin().lock(), &sets)
    } else {
        saltus_config::load(&args.file, &sets)
    };
    Ok(study?)
}

/// Everything about how a study runs: stepper, threads, Ctrl-C.
fn control(study: &Study, threads: &ThreadArgs) -> Control {
    Control {
        options: study.options(),
        threads: threads.threads.map_or(0, usize::from),
        stop: interrupt::flag(),
        ..Control::default()
    }
}

/// The folder of results with the resolved study in it, if one was asked for.
fn folder(args: &OutputArgs, study: &Study) -> Result<Option<Folder>, Failure> {
    args.out
        .as_deref()
        .map(|out| Folder::stage(out, study))
        .transpose()
}

/// One document, or a text for people, or nothing, as asked.
fn tell(
    args: &OutputArgs,
    document: &impl Serialize,
    text: impl FnOnce() -> String,
) -> Result<(), Failure> {
    match (args.json, args.quiet) {
        (true, _) => output::print_json(document),
        (false, true) => Ok(()),
        (false, false) => output::print(&text()),
    }
}

/// Refuses a key that asks for more Lyapunov exponents than there are; `zero` says what 0 means there.
fn too_many_exponents(key: &str, asked: usize, states: usize, zero: &str) -> Failure {
    Failure::refused(
        format!(
            "{key} = {asked}: there is one exponent per state, and the model has {states} states"
        ),
        format!("1 to {states} would do, or 0 for {zero}"),
    )
}

/// Said in the titles of figures, because a figure leaves its folder.
fn setting(study: &Study, model: &Model) -> String {
    let hertz = model.scales().omega / std::f64::consts::TAU;
    match study.jumper.as_slice() {
        [one] => format!("ζ_h = {}, base {hertz:.4} Hz", one.damping_ratio),
        _ => format!("base {hertz:.4} Hz"),
    }
}

/// What a title says of the base, because a figure leaves its folder, unless that is what changes.
fn base_in_title(study: &Study, parameter: Option<&Parameter>) -> String {
    let changes = parameter.is_some_and(|p| p.key().starts_with("base.frequency"));
    let omega = study.base().omega(&study.plate(), &study.jumpers()).ok();
    let omega = omega.filter(|_| !changes);
    omega.map_or(String::new(), |omega| {
        format!("base {:.4} Hz, ", omega / std::f64::consts::TAU)
    })
}

/// As the first word of a label.
fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
