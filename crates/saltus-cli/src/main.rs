//! The saltus program: reads a study file, computes, writes results. No formula lives here.

mod args;
mod commands;
mod exit;
mod folder;
mod help;
mod interrupt;
mod output;
mod per_jumper;
mod progress;
mod status;

use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = match args::parse() {
        Ok(Some(command)) => commands::run(command),
        Ok(None) => Ok(()),
        Err(failure) => Err(failure),
    };
    exit::finish(outcome)
}
