//! `saltus sweep`: long-term motion while one parameter changes.

use crate::args::SweepArgs;
use crate::exit::Failure;

pub(super) fn run(args: &SweepArgs) -> Result<(), Failure> {
    let _study = super::load(&args.study, &[])?;
    let _threads = args.threads.threads;
    Err(Failure::computation("`saltus sweep` is not built yet"))
}
