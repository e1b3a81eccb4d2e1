//! `saltus schema`: the JSON Schema of the study file.

use crate::args::SchemaArgs;
use crate::ending::Ending;
use crate::output;

pub(crate) fn run(args: &SchemaArgs) -> Result<(), Ending> {
    let text = format!("{:#}\n", saltus_config::schema());
    output::print_or_write(args.out.as_deref(), &text)
}
