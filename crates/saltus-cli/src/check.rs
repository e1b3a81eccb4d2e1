//! `saltus check`: the description of a study file.

use crate::args::WorkArgs;
use crate::ending::Ending;
use crate::load::load;
use crate::output;
use saltus_commands::{Folder, RunContext, describe, warnings};
use saltus_config::Study;
use saltus_results::shown::printable;
use serde::Serialize;

/// The JSON document.
#[derive(Serialize)]
struct Report<'a> {
    valid: bool,
    file: String,
    warnings: Vec<String>,
    study: &'a Study,
}

pub(crate) fn run(args: &WorkArgs) -> Result<(), Ending> {
    let study = load(&args.study, &[])?;
    if let Some(out) = &args.output.out {
        Folder::stage(out, None, &study, &RunContext::default())?.commit()?;
    }
    let file = args.study.file.display().to_string();
    if args.output.json {
        return output::print_json(&Report {
            valid: true,
            file,
            warnings: warnings(&study),
            study: &study,
        });
    }
    if args.output.quiet {
        return Ok(());
    }
    output::print(&format!(
        "{}: valid\n{}",
        printable(&file),
        describe(&study)?
    ))
}
