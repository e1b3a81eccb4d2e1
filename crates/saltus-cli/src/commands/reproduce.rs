//! `saltus reproduce`: the paper, figure by figure.

use crate::args::ReproduceArgs;
use crate::exit::Failure;

pub(super) fn run(args: &ReproduceArgs) -> Result<(), Failure> {
    let _asked = (
        &args.out,
        args.quick,
        args.json,
        args.quiet,
        args.threads.threads,
    );
    Err(Failure::computation("`saltus reproduce` is not built yet"))
}
