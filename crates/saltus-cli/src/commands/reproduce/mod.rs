//! `saltus reproduce`: the paper, figure by figure, with our numbers beside its words.

mod branches;
mod figures;
mod page;
mod report;
mod tables;

use std::time::Instant;

use saltus::hybrid::Method;
use saltus::physics::FrequencyReference::{Free, Occupied};
use saltus::study::paper::{
    self, CaseResult, Diagram, Effort, InertiaComparison, Misprint, PanelBranches, PanelExponents,
};
use saltus::study::{Control, StudyError};
use saltus_config::Study;

use crate::args::ReproduceArgs;
use crate::exit::Failure;
use crate::folder::Folder;
use crate::{interrupt, output, progress};
use report::Report;

/// Everything computed.
struct Results {
    effort: Effort,
    diagrams: Vec<Diagram>,
    branches: Vec<PanelBranches>,
    exponents: Vec<PanelExponents>,
    cases: Vec<CaseResult>,
    facts: Vec<paper::Fact>,
    misprints: Vec<Misprint>,
    inertia: InertiaComparison,
}

pub(super) fn run(args: &ReproduceArgs) -> Result<(), Failure> {
    let clock = Instant::now();
    // Staged first: a folder that cannot be written is refused before the work, not after it.
    let mut folder = Folder::stage(&args.out, &Study::paper())?;
    let results = compute(args)?;
    interrupt::check()?;
    let report = Report::new(&results);
    page::write(&mut folder, &results, &report)?;
    folder.commit()?;
    if args.json {
        return output::print_json(&report);
    }
    if args.quiet {
        return Ok(());
    }
    let seconds = clock.elapsed().as_secs_f64();
    let page = args.out.join("index.html");
    output::print(&format!(
        "{}\nWritten in {seconds:.0} s. Open {}\n",
        report.text(),
        page.display()
    ))
}

/// Taylor series for the diagrams: an error near 1e-6 after 20 periods, a hundredth of a pixel, and
/// the cheapest there is (`cargo bench -p saltus`). The named motions use the default, 1e-10.
const DIAGRAMS: Method = Method::Taylor {
    tolerance: 1e-7,
    order: 12,
};

fn compute(args: &ReproduceArgs) -> Result<Results, Failure> {
    let effort = if args.quick {
        Effort::quick()
    } else {
        Effort::full()
    };
    let control = Control {
        threads: args.threads.threads.map_or(0, usize::from),
        stop: interrupt::flag(),
        ..Control::default()
    };
    let step = Step {
        quiet: args.quiet,
        control: &control,
    };
    let mut fast = control.clone();
    fast.options.method = DIAGRAMS;
    let diagrams = step.run("Fig. 2", effort.diagram_periods(), || {
        paper::diagrams(&effort, &fast)
    })?;
    let case_periods = effort.case_periods();
    let cases = step.run("Fig. 3", case_periods, || {
        paper::run_cases(Occupied, &effort, &control)
    })?;
    let free = step.run("Fig. 3, free", case_periods, || {
        paper::run_cases(Free, &effort, &control)
    })?;
    let exponents = step.run("Exponents", effort.panel_periods(), || {
        paper::panel_exponents(&diagrams, &effort, &fast)
    })?;
    let branches = step.run("Branches", 0, || paper::panel_branches(&effort, &control))?;
    let facts = step.run("Facts", 0, || {
        paper::facts(&diagrams, &cases, &free, &branches, &fast)
    })?;
    let misprints = step.run("Misprints", 0, || paper::misprints(&control))?;
    let inertia = step.run("Full model", effort.inertia_periods(), || {
        paper::compare_inertia(&effort, &control)
    })?;
    Ok(Results {
        effort,
        diagrams,
        branches,
        exponents,
        cases,
        facts,
        misprints,
        inertia,
    })
}

/// One stage of the work with its progress.
struct Step<'a> {
    quiet: bool,
    control: &'a Control,
}

impl Step<'_> {
    fn run<T>(
        &self,
        what: &str,
        periods: u64,
        work: impl FnOnce() -> Result<T, StudyError>,
    ) -> Result<T, Failure> {
        self.control
            .done
            .store(0, std::sync::atomic::Ordering::Relaxed);
        let result = progress::follow(periods, what, self.quiet, &self.control.done, work)?;
        interrupt::check()?;
        Ok(result)
    }
}
