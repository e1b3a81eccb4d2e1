//! What the help of a command says below its options. Lines fit a terminal of 80 columns.

use saltus_commands::Request;
use saltus_results::Quantity;

/// Columns of a terminal, and of the names in front of meanings.
const WIDTH: usize = 80;
const NAMES: usize = 20;

/// Help of a command: its work, the quantities of its answers, and the tables that show them.
fn text(what: &str, request: &Request, tables: &str) -> String {
    let name = request.name();
    let mut text = match what {
        "" => String::new(),
        what => format!("{what}\n\n"),
    };
    let data = format!(
        "Data, in {name}.nc (--out; xarray.open_dataset) and as arrays in Python; single values and lists also in JSON \
         (--json, and {name}.json), null where there is none:"
    );
    text += &filled(String::new(), 0, &data);
    for quantity in request.quantities() {
        text += &entry(&quantity);
    }
    text + "Tables:\n  " + tables
}

/// Name, meaning, unit and words, in lines.
fn entry(quantity: &Quantity) -> String {
    let unit = match quantity.unit {
        "" => String::new(),
        "1" => " (-)".to_owned(),
        unit => format!(" ({unit})"),
    };
    let words = match quantity.words {
        [] => String::new(),
        words => format!(": {}", words.join(", ")),
    };
    let meaning = format!("{}{unit}{words}", quantity.meaning);
    let mut name = format!("  {:<1$}", quantity.name, NAMES - 2);
    if quantity.name.len() + 3 > NAMES {
        name += &format!("\n{:NAMES$}", "");
    }
    filled(name, NAMES, &meaning)
}

/// `lines`, whose last has `indent` columns, with the words of `text` behind it, in lines that begin as far in.
fn filled(mut lines: String, indent: usize, text: &str) -> String {
    let mut column = indent;
    for word in text.split(' ') {
        let length = word.chars().count();
        if column + length > WIDTH {
            lines = format!("{}\n{:indent$}", lines.trim_end(), "");
            column = indent;
        }
        lines += &format!("{word} ");
        column += length + 1;
    }
    format!("{}\n", lines.trim_end())
}

/// Below `saltus simulate --help`.
pub(crate) fn simulate() -> String {
    let tables = "\
  section, switches, energy: lists of records and CSV; history: CSV. In these
  the prefixes energy_, history_ and switch_ are left out, and columns of
  several jumpers are numbered from 0.
  The balance: stored = base + gravity - plate - legs + residual; in-plane
  kinetic energy counts for inertia = \"full\" only.

Figures: portrait and history (for an empty plate section), as SVG and PNG. The
time history covers the last 20 periods at most; simulate.transient is left out
of it, of the figures and of mean_contact_ratio.

A run that ends early (chattering, ...) is reported in full, with its status,
and ends with exit code 1. solver.method = \"rk4\" with a step above its
stability limit is refused with exit code 2.";
    text("", &Request::Simulate, tables)
}

/// Below `saltus sweep --help`.
pub(crate) fn sweep() -> String {
    let what = "\
The study needs a [sweep] table; `saltus init paper` shows one. \"up\" runs from
sweep.from to sweep.to and \"down\" back, each value from the last state of the
one before; \"restarts\" takes each value anew from each of sweep.starts.
plate.inertia = \"slow-manifold\" is some 25 times as fast as \"full\",
\"condensed\" about a hundred times.";
    let tables = "\
  parameter, unit and label say what changes; its values are a variable of its
  name. passes: a list. rows: one per pass and value, in JSON with lists of
  samples for each jumper, in rows.csv one line per jumper; sweep.csv has the
  samples. A label is of the motion that goes on from the last state; up to 2000
  more periods are run for it. Exponents are those of sweep.exponents, followed
  from there; with 0 the one that the label took, if any. A confidence is null
  for a cycle known by its returns.

Figures: bifurcation and, with sweep.exponents, exponents, as SVG and PNG.

A value that has no model, or whose run ends early, is a row that says so. Only
if no row is completed nothing is printed or written, and the exit code is 1 (2
if the study is to blame). Results are the same bits for any --threads.

With sweep.direction = \"restarts\" and --out finished pieces are kept until the
results are written; --resume, --shard and --merge as in `saltus map`.";
    text(what, &Request::Sweep, tables)
}

/// Below `saltus map --help`.
pub(crate) fn map() -> String {
    let what = "\
The study needs a [map] table with [map.x] and [map.y]; `saltus init paper`
shows one. Each pixel runs anew from [start] until the motion has surely
settled, or for map.transient periods; then the cycle, or map.record periods,
is recorded. plate.inertia = \"condensed\" is about a hundred times as fast as
\"full\"; \"slow-manifold\" is some 25 times as fast, and far closer to it.";
    let tables = "\
  Layers are over y and x, NaN where there is no motion; contact_ratio and
  peak_reaction of several jumpers are numbered from 0. JSON has what they add
  up to: outcomes (pixels of each status) and periods (pixels of each period),
  ranges over the map, the first pixel without a motion, and of both axes
  parameter, unit, label, from, to and count.
  \"undecided\": on its way when the time was up, or on a longer cycle, or its
  exponent too small to tell its sign; \"not-periodic\": map.exponent = 0 does
  not ask for more. Transient chaos that outlasts chaotic_periods is called
  chaotic too.

Figures: map (periods) and layers, as SVG and PNG.

Finished pieces are kept beside the folder, in .NAME.saltus-pieces, until it is
written. After an interruption (Ctrl-C, a kill, a power cut) the same command
with --resume goes on; the results are the same bits as without interruption,
and for any --threads.

Many processes, on as many machines as see the folder: --shard 1/64 to 64/64
make every 64th piece each, in any order and side by side; one that was killed
does only what is missing when it is started again. Then the same command with
--merge puts the pieces together, or names each that is missing, truncated,
altered or of other work (exit code 3); with --resume such pieces are computed
first. Pieces are of the study, the version and the way a processor rounds; the
bits are those of a single run. There are at most 4096 pixels in a piece, some
256 pieces of a small plane and 24 415 of 10 000 x 10 000 pixels: more shards
than pieces have nothing to do.";
    text(what, &Request::Map, tables)
}

/// Below `saltus basins --help`.
pub(crate) fn basins() -> String {
    let what = "\
The study needs a [basins] table with [basins.x] and [basins.y], the keys
start.z and start.v in either order; `saltus init paper` shows one. Each pixel
is an initial condition of every jumper, with the plate at rest; it is run as
for `saltus map`.

Two cycles are the same attractor if they have the same period and their
samples agree within 0.004 eta after some rotation. Motions that do not repeat
are the same if the ranges of their samples mostly overlap, so two chaotic
attractors may be joined. Numbers go by the share of the pixels, from 1. With
--match the attractors are sought along the sweep of [attractors] too, and have
the colours that they have there, so that pictures at several values agree.";
    let tables = "\
  As for `saltus map`, with the layer attractor. attractors: a list of records,
  the most frequent first, without the prefix attractor_; attractors.csv has one
  line per attractor, jumper and sample, or one without a sample. start_z and
  start_v are the first pixel that leads to it.

Figures: basins and layers, as SVG and PNG.

--resume, --shard and --merge as in `saltus map`.";
    text(what, &Request::Basins { matched: false }, tables)
}

/// Below `saltus orbit --help`.
pub(crate) fn orbit() -> String {
    let what = "\
Newton's method from the motion that [start] leads to after orbit.transient
periods. With orbit.period = 0 the orbit is one that this motion is near, in
chaos an unstable one; otherwise one of orbit.period forcing periods, or of a
part of them if it closes sooner. The integration has a tolerance of 1e-13
whatever [solver] says. A multiplier may be off by 1e-11 of the derivative of a
period, times the condition of the eigenvalue.";
    let tables = "\
  section, multipliers (re, im, modulus, error), switches: lists of records and
  CSV; history: CSV, once around.

Figures: portrait and multipliers, as SVG and PNG.

If no orbit is found the exit code is 1, and the message says how far the search
came.";
    text(what, &Request::Orbit, tables)
}

/// Below `saltus continue --help`.
pub(crate) fn continuation() -> String {
    let what = "\
The study needs a [continue] table; `saltus init paper` shows one. The first
orbit is sought at the study's own value of continue.parameter, or taken from an
earlier result with --from DIR --at LABEL: then the parameter of that result
gets the value there, and the study may have another range or parameter. An HP
restarts with the orbit of half the period.

Branches are followed through their folds, and from their period doublings and
branch points to others. [continue.second] follows special points over two
parameters; a curve that ends early or fails says so and stops no other.

Special points: LP fold, PD period doubling, HP where a branch meets that of
half its period, NS Neimark-Sacker, BP branch point, GR grazing, SO order of
switches.";
    let tables = "\
  branches (in CSV ends.csv), special_points, curves, curve_points: lists of
  records without the prefixes branch_, special_ and curve_; points (JSON) and
  branches.csv: all orbits, in CSV one line per place of an orbit. parameter,
  unit and label say what changes, second_parameter likewise; values of either
  are variables of its name. special_modes and special_x restart an orbit.

Figures: branches and curves, as SVG and PNG. Behind the branches lie the
long-term motions at continue.cloud values, 50 forcing periods after 150, the
state carried on upwards and downwards.";
    text(
        what,
        &Request::Continue {
            origin: None,
            over: None,
        },
        tables,
    )
}

/// Below `saltus lyapunov --help`.
pub(crate) fn lyapunov() -> String {
    let what = "\
The motion from [start] is run for lyapunov.transient forcing periods. From
there on lyapunov.replicas pieces of it, one after the other and each
lyapunov.periods long, are run side by side with the tangent flow; a switch
multiplies that by its saltation matrix. Columns that part by more than rounding
allows within a period are kept apart as often as it takes. An exponent is the
mean growth of a small deviation, natural logarithm, per forcing period; -inf is
a direction that shrinks to nothing at a switch, as a relaxing leg at
touch-down. Errors are of 20 batches of the whole record; intervals are by
Student's t and hold if the motion forgets where it was within a twentieth of
the record. The drive keeps its phase: its exponent, 0, is not counted.
All exponents of plate.inertia = \"full\" take hours where those of \"condensed\"
take seconds; lyapunov.exponents = 1 asks for the largest alone.";
    let tables = "\
  exponents: a list of records; convergence (the exponents from the first
  periods of the record, over how many these are): list and CSV.

Figure: convergence, as SVG and PNG.

Replicas that end early (chattering, ...) are reported with what they measured,
and exit code 1. Results are the same bits for any --threads.";
    text(what, &Request::Lyapunov, tables)
}

/// Below `saltus attractors --help`.
pub(crate) fn attractors() -> String {
    let what = "\
The table [attractors] says from which box initial conditions are drawn, evenly
but without a pattern; `saltus init paper` shows one. Without the keys
parameter, from, to and count it asks at the study's own parameters, with them
at each value. There each attractor is also carried to the values beside, up to
where it ends. So rare ones are found too, and one that merely changes, as by
doubling its period, keeps its number. Motions are told apart as for `saltus
basins`; here slow transients are run on to what they become, every cycle is
confirmed by Newton's method and its Floquet multipliers, and chaos is watched:
eight motions on it, for 12 000 forcing periods each.";
    let tables = "\
  attractors: one row per value and attractor met there; sections: their samples
  (in JSON a list for each jumper); ranges: where each attractor begins and
  ends, and where a motion jumps beyond; loops: of hysteresis; transients: chaos
  that is no attractor, since motions watched on it ended on another; rows: one
  per value. In transients and loops the prefix is left out. parameter, unit and
  label say what changes; `value` is the value of it, null without one.
  exponent and lifetime_low are known where there is no cycle, multiplier where
  there is one. Intervals are Wilson's.

Figure: attractors, as SVG and PNG.

Results are the same bits for any --threads.";
    text(what, &Request::Attractors, tables)
}

/// Below `saltus cite --help`.
pub(crate) const CITE: &str = "\
Each entry stands below a comment that says what it was used for. These are the
methods that an answer to that question about that study rests on, and that may
have been needed on the way. The version of saltus is the one that computed the
result; the rest are the methods of this one.

JSON (--json):
  result             its folder
  version_of_result  of the program that wrote it
  citations          key, bibtex (the entry), why (what it was used for)
  version

A folder without a result, one of a newer format and one whose study was altered
are refused with exit code 3.";

/// Below `saltus rerun --help`.
pub(crate) const RERUN: &str = "\
The same is asked of the same study again, and file is compared with file. The
new result is removed after that, unless --out says where to keep it. Results
are the same bits on the same arithmetic, for any --threads; those of orbit,
continue and reproduce agree to rounding with another number of threads.

JSON (--json):
  result             its folder
  request            what was asked
  identical          whether all files are the same to the bit
  files              one per file of either result, the manifest last:
    name             within the folder
    outcome          \"identical\", \"missing\" or \"extra\" (now there, and not
                     before), \"written_differently\" (same values),
                     \"drawn_differently\" (a figure), \"other_bytes\" (and
                     reason), \"different\":
    differences      for each part that differs: part (variable of a dataset,
                     else empty), compared and differing (values), absolute and
                     relative (the largest of two numbers: difference, place,
                     first and second; null if no numbers differ), first (the
                     first that are not two numbers: place, first, second)
  reasons            why the bits may differ: another version, other arithmetic,
                     another number of threads, another result to begin at
  kept               folder of the new result (--out); null if it was removed
  version_of_result  of the program that wrote the result
  version

Exit code 0 means the same bits, 1 that there are differences, 3 that there is
no result to compare with: a file is missing or was altered, or the earlier
result of `continue --from` is not where it was.";

/// Below `saltus completions --help`.
pub(crate) const COMPLETIONS: &str = "\
Where the script belongs:
  bash        ~/.local/share/bash-completion/completions/saltus
  zsh         _saltus in a folder of $fpath
  fish        ~/.config/fish/completions/saltus.fish
  powershell  saltus completions powershell | Out-String | Invoke-Expression
  elvish      eval (saltus completions elvish | slurp)";

#[cfg(test)]
mod tests {
    #[test]
    fn lines_fit_a_terminal() {
        let made = [
            super::simulate(),
            super::sweep(),
            super::map(),
            super::basins(),
            super::orbit(),
            super::continuation(),
            super::lyapunov(),
            super::attractors(),
        ];
        let made = made.iter().map(String::as_str);
        let all = made.chain([super::CITE, super::RERUN, super::COMPLETIONS]);
        for line in all.flat_map(str::lines) {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}
