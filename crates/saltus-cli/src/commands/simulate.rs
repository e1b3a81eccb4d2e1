//! `saltus simulate`: the motion, once per forcing period.

use crate::args::SimulateArgs;
use crate::exit::Failure;

pub(super) fn run(args: &SimulateArgs) -> Result<(), Failure> {
    let periods: Vec<String> = args
        .periods
        .iter()
        .map(|n| format!("simulate.periods={n}"))
        .collect();
    let _study = super::load(&args.study, &periods)?;
    let _threads = args.threads.threads;
    Err(Failure::computation("`saltus simulate` is not built yet"))
}
