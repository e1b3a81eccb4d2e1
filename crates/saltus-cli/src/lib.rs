//! The saltus program: reads a study file, asks, writes results. No formula lives here.
//!
//! It is a library only so that other front ends can bring the program along; see [`main`].

mod args;
mod check;
mod ending;
mod help;
mod init;
mod interrupt;
mod load;
mod output;
mod progress;
mod run;
mod saved;
mod schema;
mod shell;

use std::ffi::OsString;

/// Runs the program with these arguments, the first of which is its name, and gives its exit code.
pub fn main(args: impl IntoIterator<Item = OsString>) -> u8 {
    let outcome = match args::parse(args) {
        Ok(Some(command)) => run::run(command),
        Ok(None) => Ok(()),
        Err(ending) => Err(ending),
    };
    ending::finish(outcome)
}
