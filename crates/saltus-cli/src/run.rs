//! Running of commands: reads the study, asks, writes and prints the answer.

use crate::args::{
    BasinsArgs, Command, ContinueArgs, DividedArgs, OutputArgs, ReproduceArgs, SimulateArgs,
    ThreadArgs, WorkArgs,
};
use crate::ending::Ending;
use crate::load::load;
use crate::output::tell;
use crate::progress::Bars;
use crate::{check, init, interrupt, output, saved, schema, shell};
use saltus_commands::{
    Answer, CommandError, Destination, Estimate, Existing, Labelled, Pieces, PiecesAt, Request,
    RunContext, Shard,
};
use saltus_config::Study;
use std::io::{self, IsTerminal};
use std::time::Instant;

/// Runs the command.
pub(crate) fn run(command: Command) -> Result<(), Ending> {
    match command {
        Command::Reproduce(args) => reproduce(&args),
        Command::Init(args) => init::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Schema(args) => schema::run(&args),
        Command::Frequencies(args) => work(&Request::Frequencies, &args),
        Command::Simulate(args) => simulate(&args),
        Command::Sweep(args) => divided(&Request::Sweep, &args),
        Command::Map(args) => divided(&Request::Map, &args),
        Command::Basins(args) => basins(&args),
        Command::Orbit(args) => work(&Request::Orbit, &args),
        Command::Continue(args) => continuation(&args),
        Command::Lyapunov(args) => work(&Request::Lyapunov, &args),
        Command::Attractors(args) => work(&Request::Attractors, &args),
        Command::Cite(args) => saved::cite(&args),
        Command::Rerun(args) => saved::rerun(&args),
        Command::Completions(args) => shell::completions(&args),
        Command::Man(args) => shell::man(&args),
    }
}

/// Settings that do not belong to the question: output, threads, pieces.
struct How<'a> {
    output: &'a OutputArgs,
    threads: &'a ThreadArgs,
    keep: Option<Pieces>,
}

fn work(request: &Request, args: &WorkArgs) -> Result<(), Ending> {
    let study = load(&args.study, &[])?;
    let how = How {
        output: &args.output,
        threads: &args.threads,
        keep: None,
    };
    answer(request, &study, &how)
}

fn simulate(args: &SimulateArgs) -> Result<(), Ending> {
    let periods = args.periods.iter();
    let periods: Vec<String> = periods.map(|n| format!("simulate.periods={n}")).collect();
    let study = load(&args.study, &periods)?;
    let how = How {
        output: &args.output,
        threads: &args.threads,
        keep: None,
    };
    answer(&Request::Simulate, &study, &how)
}

fn divided(request: &Request, args: &DividedArgs) -> Result<(), Ending> {
    let study = load(&args.work.study, &[])?;
    let found = match (args.merge, args.resume) {
        (true, _) => Existing::Merge,
        (_, true) => Existing::Resume,
        _ => Existing::Refuse,
    };
    let place = args.work.output.out.clone().map(PiecesAt::Beside);
    let keep = place.map(|place| Pieces { place, found });
    let how = How {
        output: &args.work.output,
        threads: &args.work.threads,
        keep,
    };
    match args.shard {
        Some(shard) => share(request, &study, shard, &how),
        None => answer(request, &study, &how),
    }
}

fn basins(args: &BasinsArgs) -> Result<(), Ending> {
    let matched = args.matched;
    divided(&Request::Basins { matched }, &args.divided)
}

fn continuation(args: &ContinueArgs) -> Result<(), Ending> {
    let origin = args.from.clone().zip(args.at.clone());
    let origin = origin.map(|(from, at)| Labelled { from, at });
    let over = args.over.clone();
    work(&Request::Continue { origin, over }, &args.work)
}

fn reproduce(args: &ReproduceArgs) -> Result<(), Ending> {
    let clock = Instant::now();
    let output = OutputArgs {
        json: args.json,
        out: Some(args.out.clone()),
        quiet: args.quiet,
        figures: args.figures.clone(),
    };
    let how = How {
        output: &output,
        threads: &args.threads,
        keep: None,
    };
    answer(
        &Request::Reproduce { quick: args.quick },
        &Study::paper(),
        &how,
    )?;
    if args.json || args.quiet {
        return Ok(());
    }
    let seconds = clock.elapsed().as_secs_f64();
    let page = args.out.join("index.html");
    output::print(&format!(
        "\nWritten in {seconds:.0} s. Open {}\n",
        page.display()
    ))
}

impl How<'_> {
    fn context<'a>(&self, bars: &'a Bars) -> Result<RunContext<'a>, Ending> {
        let figures = self.output.figures.style();
        Ok(RunContext {
            threads: self.threads.threads.map_or(0, usize::from),
            stop: interrupt::flag(),
            watch: bars,
            keep: self.keep.clone(),
            figures: figures.map_err(|error| {
                CommandError::refused(error.to_string(), "see --figure-width and --font-size")
            })?,
        })
    }

    fn destination<'a>(
        &self,
        request: &'a Request,
        study: &'a Study,
        context: &'a RunContext<'a>,
    ) -> Destination<'a> {
        Destination {
            request,
            study,
            context,
        }
    }
}

/// Says to a person how long it will take if that is long; of work that is shared out among `of`, how long a share of it
/// will. Where nobody waits at a terminal nothing is probed.
fn announce(request: &Request, study: &Study, how: &How, context: &RunContext, of: u32) {
    let computes = how
        .keep
        .as_ref()
        .is_none_or(|keep| keep.found != Existing::Merge);
    if how.output.quiet || !computes || !io::stderr().is_terminal() {
        return;
    }
    let estimate = request
        .estimate(study, context)
        .map(|whole| whole.share(of));
    if let Some(estimate) = estimate.filter(Estimate::is_long) {
        output::note(&estimate.to_string());
    }
}

/// Makes the pieces of a shard, and prints which.
fn share(request: &Request, study: &Study, shard: Shard, how: &How) -> Result<(), Ending> {
    let bars = Bars::new(how.output.quiet);
    let context = how.context(&bars)?;
    if let Some(out) = &how.output.out {
        how.destination(request, study, &context).try_out(out)?;
    }
    announce(request, study, how, &context, shard.of());
    let share = request.share(study, shard, &context)?;
    tell(how.output.json, how.output.quiet, &share)
}

/// Asks, writes the folder of results if one was asked for, and prints the answer.
fn answer(request: &Request, study: &Study, how: &How) -> Result<(), Ending> {
    let bars = Bars::new(how.output.quiet);
    let context = how.context(&bars)?;
    let study = &request.study(study)?;
    let destination = how.destination(request, study, &context);
    let out = how.output.out.as_deref();
    // refused before a long computation, but staged after it
    out.map_or(Ok(()), |out| destination.try_out(out))?;
    announce(request, study, how, &context, 1);
    let mut answer = request.ask(study, &context)?;
    let told = |answer: &dyn Answer| tell(how.output.json, how.output.quiet, answer);
    if let Some(out) = out {
        match destination.store(out, answer.as_ref()) {
            Ok(()) => answer.stored()?,
            Err(failure @ (CommandError::Interrupted | CommandError::Suspended { .. })) => {
                return Err(failure.into());
            }
            Err(failure) => {
                // the folder could not be written, so the reader has at least this
                let _ = told(answer.as_ref());
                return Err(failure.into());
            }
        }
    }
    match told(answer.as_ref()) {
        // nowhere else is it kept
        Err(Ending::Output(why)) if out.is_none() => {
            let folder = destination.keep(answer.as_ref()).ok();
            return Err(Ending::OutputElsewhere { why, folder });
        }
        told => told?,
    }
    let shortfall = answer.shortfall();
    shortfall.map_or(Ok(()), |failure| Err(failure.into()))
}
