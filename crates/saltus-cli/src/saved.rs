//! Commands on a saved result: `saltus cite` and `saltus rerun`.

use crate::args::{CiteArgs, RerunArgs};
use crate::ending::Ending;
use crate::interrupt;
use crate::output::{self, tell};
use crate::progress::Bars;
use saltus_commands::{Citation, RunContext, SavedResult, bibtex};
use serde::Serialize;

/// The JSON document of `cite`.
#[derive(Serialize)]
struct Works<'a> {
    command: &'static str,
    result: String,
    version_of_result: &'a str,
    citations: &'a [Citation],
    version: &'static str,
}

pub(crate) fn cite(args: &CiteArgs) -> Result<(), Ending> {
    let kept = SavedResult::open(&args.result)?;
    let citations = kept.citations();
    if !args.json {
        return output::print(&bibtex(&citations));
    }
    output::print_json(&Works {
        command: "cite",
        result: kept.folder().display().to_string(),
        version_of_result: kept.version(),
        citations: &citations,
        version: env!("CARGO_PKG_VERSION"),
    })
}

pub(crate) fn rerun(args: &RerunArgs) -> Result<(), Ending> {
    let bars = Bars::new(args.quiet);
    let context = RunContext {
        threads: args.threads.threads.map_or(0, usize::from),
        stop: interrupt::flag(),
        watch: &bars,
        ..RunContext::default()
    };
    let rerun = SavedResult::open(&args.result)?.rerun(args.out.as_deref(), &context)?;
    tell(args.json, args.quiet, &rerun)?;
    rerun
        .shortfall()
        .map_or(Ok(()), |failure| Err(failure.into()))
}
