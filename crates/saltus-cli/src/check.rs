//! `saltus check`: the description of a study file.

use crate::args::CheckArgs;
use crate::ending::Ending;
use crate::load::load;
use crate::{interrupt, output};
use saltus_commands::{Estimate, Folder, Request, RunContext, describe, warnings};
use saltus_config::Study;
use saltus_results::shown::printable;
use serde::Serialize;

/// The JSON document.
#[derive(Serialize)]
struct Report<'a> {
    valid: bool,
    file: String,
    warnings: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    cost: Vec<Estimate>,
    study: &'a Study,
}

pub(crate) fn run(args: &CheckArgs) -> Result<(), Ending> {
    let CheckArgs { work: args, cost } = args;
    let study = load(&args.study, &[])?;
    if let Some(out) = &args.output.out {
        Folder::stage(out, None, &study, &RunContext::default())?.commit()?;
    }
    let cost = if *cost {
        expected(&study, args.threads.threads)
    } else {
        Vec::new()
    };
    let file = args.study.file.display().to_string();
    if args.output.json {
        return output::print_json(&Report {
            valid: true,
            file,
            warnings: warnings(&study),
            cost,
            study: &study,
        });
    }
    if args.output.quiet {
        return Ok(());
    }
    let line = |estimate: &Estimate| format!("  {:<11}{estimate}\n", "cost");
    output::print(&format!(
        "{}: valid\n{}{}",
        printable(&file),
        describe(&study)?,
        cost.iter().map(line).collect::<String>()
    ))
}

/// The time that each question of the study is expected to take; those that it does not ask have none.
fn expected(study: &Study, threads: Option<u16>) -> Vec<Estimate> {
    let context = RunContext {
        threads: threads.map_or(0, usize::from),
        stop: interrupt::flag(),
        ..RunContext::default()
    };
    let questions = [
        Request::Simulate,
        Request::Sweep,
        Request::Map,
        Request::Basins { matched: false },
        Request::Continue {
            origin: None,
            over: None,
        },
        Request::Lyapunov,
        Request::Attractors,
    ];
    let found = questions.iter();
    found
        .filter_map(|question| question.estimate(study, &context))
        .collect()
}
