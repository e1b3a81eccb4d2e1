//! One file per command.

mod check;
mod frequencies;
mod init;
mod reproduce;
mod schema;
mod simulate;
mod sweep;

use crate::args::{Command, StudyArgs};
use crate::exit::Failure;
use crate::output;
use saltus_config::Study;
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

/// The folder of results with the resolved study in it.
fn folder_with_study(out: &Path, study: &Study) -> Result<std::path::PathBuf, Failure> {
    let folder = output::folder(out)?;
    output::write_file(&folder.join("study.toml"), &study.to_toml())?;
    Ok(folder)
}
