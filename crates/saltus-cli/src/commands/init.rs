//! `saltus init`: a commented study file.

use crate::args::{InitArgs, Preset};
use crate::exit::Failure;
use crate::output;

pub(super) fn run(args: &InitArgs) -> Result<(), Failure> {
    let text = match args.preset {
        Preset::Paper => saltus_config::paper_template(),
    };
    output::print_or_write(args.out.as_deref(), &text)
}
