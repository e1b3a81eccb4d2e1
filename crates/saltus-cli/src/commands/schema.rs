//! `saltus schema`: the JSON Schema of the study file.

use crate::args::SchemaArgs;
use crate::exit::Failure;
use crate::output;

pub(super) fn run(args: &SchemaArgs) -> Result<(), Failure> {
    let text = output::json(&saltus_config::schema())?;
    output::print_or_write(args.out.as_deref(), &text)
}
