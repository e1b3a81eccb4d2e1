//! `saltus reproduce`: the paper, figure by figure, with our numbers beside its words.

mod album;
mod branches;
mod data;
mod facts;
mod figures;
mod page;

use std::io::{self, Write};
use std::sync::Arc;

use saltus::hybrid::Method;
use saltus::model::Setup;
use saltus::physics::FrequencyReference::{Free, Occupied};
use saltus::study::{Control, StudyError};
use saltus_paper::{
    CaseResult, Diagram, Effort, InertiaComparison, Misprint, PanelBranches, PanelExponents,
};

use crate::answer::{Answer, stream_json};
use crate::context::RunContext;
use crate::estimate::{LANES, Part};
use crate::failure::CommandError;
use crate::store::Store;
use facts::Report;
use saltus_config::{Inertia, Study};
use saltus_results::Dataset;

/// Everything computed.
struct Results {
    study: Study,
    quick: bool,
    effort: Effort,
    diagrams: Vec<Diagram>,
    branches: Vec<PanelBranches>,
    exponents: Vec<PanelExponents>,
    cases: Vec<CaseResult>,
    facts: Vec<saltus_paper::Fact>,
    misprints: Vec<Misprint>,
    inertia: InertiaComparison,
}

/// The paper's study, with its full in-plane inertia.
pub(crate) fn study() -> Study {
    let mut study = Study::paper();
    study.plate.inertia = Inertia::Full;
    study
}

pub(crate) fn ask(quick: bool, context: &RunContext) -> Result<Box<dyn Answer>, CommandError> {
    Ok(Box::new(compute(quick, context)?))
}

/// The diagrams with all that is made of them, and the full model.
pub(crate) fn parts(quick: bool, threads: usize) -> Result<Vec<Part>, CommandError> {
    let effort = effort(quick);
    let of = |inertia| {
        let mut setup = Setup::dias_del_prado(0.3, 1.0);
        setup.inertia = inertia;
        let model = setup.model()?;
        let start = model.start(3.0, 2.0);
        Ok((model, start))
    };
    let periods = effort.diagram_periods() + 2 * effort.case_periods() + effort.panel_periods();
    let full = effort.inertia_periods() as f64 / 2.0;
    let spread = |periods: f64, inertia| {
        // as many as fill any number of threads
        let count = LANES * threads;
        Part::spread(count, threads, 0, periods / count as f64, |_| of(inertia))
    };
    let condensed = spread(REST * periods as f64, saltus::model::Inertia::Condensed)?;
    Ok(vec![condensed, spread(full, saltus::model::Inertia::Full)?])
}

/// All of it as a multiple of the periods of its diagrams, cases and panels: branches, transients and facts take the
/// most, and a run took more than 225 s of processor time where these alone take some 30.
const REST: f64 = 12.0;

fn effort(quick: bool) -> Effort {
    if quick {
        Effort::quick()
    } else {
        Effort::full()
    }
}

impl Answer for Results {
    fn study(&self) -> &Study {
        &self.study
    }

    fn data(&self) -> Dataset {
        data::data(self)
    }

    fn summary(&self) -> String {
        Report::new(self).text()
    }

    fn document(&self, _: &Dataset, to: &mut dyn Write) -> io::Result<()> {
        stream_json(to, &Report::new(self))
    }

    fn fill(&self, store: &mut dyn Store, name: &str) -> Result<(), CommandError> {
        page::write(store, self, &Report::new(self))?;
        store.put_dataset(name, self.data())
    }
}

/// Taylor series for the diagrams: an error near 1e-6 after 20 periods, a hundredth of a pixel, and
/// the cheapest there is (`cargo bench -p saltus`). The named motions use the default, 1e-10.
const DIAGRAMS: Method = Method::Taylor {
    tolerance: 1e-7,
    order: 12,
};

fn compute(quick: bool, context: &RunContext) -> Result<Results, CommandError> {
    let effort = effort(quick);
    let control = Control {
        threads: context.threads,
        stop: Arc::clone(&context.stop),
        ..Control::default()
    };
    let step = Step {
        context,
        control: &control,
    };
    let mut fast = control.clone();
    fast.options.method = DIAGRAMS;
    let diagrams = step.run("Fig. 2", effort.diagram_periods(), || {
        saltus_paper::diagrams(&effort, &fast)
    })?;
    let case_periods = effort.case_periods();
    let cases = step.run("Fig. 3", case_periods, || {
        saltus_paper::run_cases(Occupied, &effort, &control)
    })?;
    let free = step.run("Fig. 3, free", case_periods, || {
        saltus_paper::run_cases(Free, &effort, &control)
    })?;
    let exponents = step.run("Exponents", effort.panel_periods(), || {
        saltus_paper::panel_exponents(&diagrams, &effort, &fast)
    })?;
    let branches = step.run("Branches", 0, || {
        saltus_paper::panel_branches(&diagrams, &effort, &control)
    })?;
    let facts = step.run("Facts", 0, || saltus_paper::facts(&cases, &free, &branches))?;
    let misprints = step.run("Misprints", 0, || saltus_paper::misprints(&control))?;
    let inertia = step.run("Full model", effort.inertia_periods(), || {
        saltus_paper::compare_inertia(&effort, &control)
    })?;
    Ok(Results {
        study: study(),
        quick,
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
    context: &'a RunContext<'a>,
    control: &'a Control,
}

impl Step<'_> {
    fn run<T>(
        &self,
        what: &str,
        periods: u64,
        work: impl FnOnce() -> Result<T, StudyError>,
    ) -> Result<T, CommandError> {
        self.control
            .done
            .store(0, std::sync::atomic::Ordering::Relaxed);
        let result = self
            .context
            .follow(periods, what, &self.control.done, work)?;
        self.context.check()?;
        Ok(result)
    }
}
