//! `saltus completions` and `saltus man`: what a shell and its user are told of the grammar.

use crate::args::{CompletionsArgs, ManArgs, grammar};
use crate::ending::Ending;
use crate::output;
use saltus_results::ResultsError;
use std::fs;
use std::io;

pub(crate) fn completions(args: &CompletionsArgs) -> Result<(), Ending> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut grammar(), "saltus", &mut script);
    output::print_with(|stdout| stdout.write_all(&script))
}

pub(crate) fn man(args: &ManArgs) -> Result<(), Ending> {
    // it has no page
    let grammar = grammar().disable_help_subcommand(true);
    let Some(dir) = &args.out else {
        return output::print_with(|stdout| clap_mangen::Man::new(grammar).render(stdout));
    };
    let failed = |source: io::Error| ResultsError::Io {
        action: "write manual pages to",
        path: dir.clone(),
        source,
    };
    fs::create_dir_all(dir)
        .and_then(|()| clap_mangen::generate_to(grammar, dir))
        .map_err(|error| failed(error).into())
}
