//! Reading a study: from a file or standard input, with the overrides of the command line.

use crate::args::StudyArgs;
use crate::ending::Ending;
use saltus_commands::CommandError;
use saltus_config::Study;
use std::io;
use std::path::Path;

/// Reads the study with its overrides; `more` are overrides that a command's own options stand for.
pub(crate) fn load(args: &StudyArgs, more: &[String]) -> Result<Study, Ending> {
    let sets = [args.sets.as_slice(), more].concat();
    let study = if args.file == Path::new("-") {
        saltus_config::read("standard input", io::stdin().lock(), &sets)
    } else {
        saltus_config::load(&args.file, &sets)
    };
    Ok(study.map_err(CommandError::from)?)
}
