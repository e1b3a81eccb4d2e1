//! The grammar of the command line.

use crate::ending::{self, Ending};
use crate::{help, output};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use saltus_commands::Shard;
use saltus_results::shown::{printable, printable_lines};
use saltus_results::{FigureStyle, ResultsError};
use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;

/// People who jump on a vibrating plate.
#[derive(Debug, Parser)]
#[command(name = "saltus", version, after_help = ending::HELP, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Compute every figure and statement of Dias & Del Prado into a folder with an index page
    Reproduce(ReproduceArgs),
    /// Print a commented study file to start from
    Init(InitArgs),
    /// Read a study file, say what it describes, or what is wrong with it
    Check(CheckArgs),
    /// Print the JSON Schema of the study file
    Schema(SchemaArgs),
    /// Natural frequencies: empty plate, in its plane, with the people on it
    Frequencies(WorkArgs),
    /// Integrate the motion and look at it once per forcing period
    Simulate(SimulateArgs),
    /// Long-term motion while one parameter changes
    #[command(after_help = help::sweep())]
    Sweep(DividedArgs),
    /// Long-term motion at each point of a plane of two parameters
    #[command(after_help = help::map())]
    Map(DividedArgs),
    /// The long-term motion that each initial condition leads to
    #[command(after_help = help::basins())]
    Basins(BasinsArgs),
    /// The periodic orbit near the long-term motion, stable or not
    #[command(after_help = help::orbit())]
    Orbit(WorkArgs),
    /// Branches of periodic orbits while one parameter changes, with their bifurcations
    #[command(after_help = help::continuation())]
    Continue(ContinueArgs),
    /// Lyapunov exponents of the long-term motion, with their errors
    #[command(after_help = help::lyapunov())]
    Lyapunov(WorkArgs),
    /// All coexisting long-term motions, their basins and hysteresis while one parameter changes
    #[command(after_help = help::attractors())]
    Attractors(WorkArgs),
    /// Works that a result rests on, as BibTeX
    #[command(after_help = help::CITE)]
    Cite(CiteArgs),
    /// Compute a result again and say whether it comes out the same
    #[command(after_help = help::RERUN)]
    Rerun(RerunArgs),
    /// Print a script that completes commands and options in a shell
    #[command(after_help = help::COMPLETIONS)]
    Completions(CompletionsArgs),
    /// Print the manual page, or write one for each command
    Man(ManArgs),
}

/// The study a command works on.
#[derive(Debug, Args)]
pub(crate) struct StudyArgs {
    /// Study file (TOML); `-` is standard input
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Change a key of the study, such as jumper.damping_ratio=0.28 or jumper.0.mass=80; may be repeated
    #[arg(
        long = "set",
        value_name = "TABLE.KEY=VALUE",
        allow_hyphen_values = true
    )]
    pub(crate) sets: Vec<String>,
}

/// Destination and form of results.
#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Print one JSON document to standard output and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder for data, figure and resolved study file; made if it is not there, an earlier result in it is replaced
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// No progress and no summary, only what was asked for and errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) figures: FigureArgs,
}

/// The look of figures.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct FigureArgs {
    /// Width of figures in print, such as 85mm (a column) or 170mm (a page)
    #[arg(long, value_name = "LENGTH")]
    pub(crate) figure_width: Option<String>,
    /// Size of the labels of figures in print [default: 8pt]
    #[arg(long, value_name = "SIZE", requires = "figure_width")]
    pub(crate) font_size: Option<String>,
    /// Leave the titles out of figures
    #[arg(long)]
    pub(crate) no_titles: bool,
}

impl FigureArgs {
    /// The style that they ask for.
    pub(crate) fn style(&self) -> Result<FigureStyle, ResultsError> {
        let mut style = FigureStyle::default().titles(!self.no_titles);
        if let Some(width) = &self.figure_width {
            style = style.width(width)?;
        }
        if let Some(size) = &self.font_size {
            style = style.font_size(size)?;
        }
        Ok(style)
    }
}

/// How the work is spread.
#[derive(Debug, Args)]
pub(crate) struct ThreadArgs {
    /// Threads to use [default: one per core]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

#[derive(Debug, Args)]
pub(crate) struct ReproduceArgs {
    /// Folder for the index page, figures and data; made if it is not there
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub(crate) out: PathBuf,
    /// Fewer parameter values and periods: a look in seconds
    #[arg(long)]
    pub(crate) quick: bool,
    /// Print the table of facts as one JSON document to standard output and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress and no summary, only what was asked for and errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) figures: FigureArgs,
    #[command(flatten)]
    pub(crate) threads: ThreadArgs,
}

#[derive(Debug, Args)]
pub(crate) struct InitArgs {
    /// Study to print
    #[arg(value_enum)]
    pub(crate) preset: Preset,
    /// File to write instead of standard output; replaced if it is there
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// Studies that come with the program.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Preset {
    /// The case of Dias & Del Prado, section 3
    Paper,
}

/// Arguments of most commands.
#[derive(Debug, Args)]
pub(crate) struct WorkArgs {
    #[command(flatten)]
    pub(crate) study: StudyArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) threads: ThreadArgs,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) work: WorkArgs,
    /// Say how long each question is expected to take, from a probe of each
    #[arg(long)]
    pub(crate) cost: bool,
}

/// Arguments of commands whose work can be cut into pieces.
#[derive(Debug, Args)]
pub(crate) struct DividedArgs {
    #[command(flatten)]
    pub(crate) work: WorkArgs,
    /// Go on with the pieces of an interrupted run or of shards; starts anew if there are none
    #[arg(long, requires = "out")]
    pub(crate) resume: bool,
    /// Make every n-th piece from the i-th on, for --merge or --resume, and write no results
    #[arg(long, value_name = "I/N", requires = "out", conflicts_with = "resume")]
    pub(crate) shard: Option<Shard>,
    /// Put the pieces of all shards together; computes nothing
    #[arg(long, requires = "out", conflicts_with_all = ["resume", "shard"])]
    pub(crate) merge: bool,
}

#[derive(Debug, Args)]
pub(crate) struct BasinsArgs {
    #[command(flatten)]
    pub(crate) divided: DividedArgs,
    /// Number and colour the attractors as `saltus attractors` does along the sweep of [attractors]
    #[arg(long = "match")]
    pub(crate) matched: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ContinueArgs {
    #[command(flatten)]
    pub(crate) work: WorkArgs,
    /// Begin at an orbit of this earlier result instead of at [start]
    #[arg(long, value_name = "DIR", requires = "at")]
    pub(crate) from: Option<PathBuf>,
    /// Label of a special point, such as PD1: its orbit
    #[arg(long, value_name = "LABEL", requires = "from")]
    pub(crate) at: Option<String>,
    /// Draw the curves over the map of this earlier result of `saltus map`
    #[arg(long, value_name = "DIR")]
    pub(crate) over: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct CiteArgs {
    /// Folder that --out named, or a file in it
    #[arg(value_name = "RESULT")]
    pub(crate) result: PathBuf,
    /// Print one JSON document instead
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RerunArgs {
    /// Folder that --out named, or a file in it
    #[arg(value_name = "RESULT")]
    pub(crate) result: PathBuf,
    /// Folder to keep the new result in; without it only the comparison is left
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one JSON document to standard output and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress and no summary, only what was asked for and errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) threads: ThreadArgs,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// File to write instead of standard output; replaced if it is there
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Accepted as everywhere; a schema is a JSON document anyway
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = help::simulate())]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    pub(crate) study: StudyArgs,
    /// Forcing periods to integrate; short for --set simulate.periods=N
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub(crate) periods: Option<u32>,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) threads: ThreadArgs,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// Shell that is to complete
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// Folder for the pages, saltus.1 and one for each command; made if it is not there
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// The whole grammar.
pub(crate) fn grammar() -> clap::Command {
    Cli::command()
}

/// The command asked for; `None` if help or the version was asked for and printed.
pub(crate) fn parse(args: impl IntoIterator<Item = OsString>) -> Result<Option<Command>, Ending> {
    let args: Vec<OsString> = args.into_iter().collect();
    match Cli::try_parse_from(&args) {
        Ok(cli) => Ok(Some(cli.command)),
        Err(error) if error.use_stderr() => {
            let shown = |arg: &OsString| arg.to_str().is_some_and(|arg| printable(arg) == arg);
            // standard error may be closed; the exit code says it all the same
            let _ = if args.iter().all(shown) {
                error.print()
            } else {
                // it quotes text that a terminal might obey; so there are no colours
                let text = printable_lines(&error.render().to_string());
                io::stderr().write_all(text.as_bytes())
            };
            Err(Ending::Usage)
        }
        Err(help) => {
            let text = help.render();
            let styled = io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
            let text = if styled {
                text.ansi().to_string()
            } else {
                text.to_string()
            };
            output::print(&text).map(|()| None)
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_grammar_is_sound() {
        super::grammar().debug_assert();
    }
}
