//! `saltus init`: a commented study file.

use crate::args::{InitArgs, Preset};
use crate::ending::Ending;
use crate::output;

pub(crate) fn run(args: &InitArgs) -> Result<(), Ending> {
    let text = match args.preset {
        Preset::Paper => saltus_config::paper_template(),
    };
    output::print_or_write(args.out.as_deref(), &text)
}
