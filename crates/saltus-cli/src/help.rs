//! What the help of a command says below its options. Lines fit a terminal of 80 columns.

use saltus_commands::Request;
use saltus_results::Quantity;

/// Columns of a terminal, and of the names in front of meanings.
const WIDTH: usize = 80;
const NAMES: usize = 20;

/// What a command does, the quantities that its answers have, and the tables that show them.
fn text(what: &str, request: &Request, tables: &str) -> String {
    let name = request.name();
    let mut text = match what {
        "" => String::new(),
        what => format!("{what}\n\n"),
    };
    text += &format!(
        "Data ({name}.nc in --out for xarray.open_dataset, arrays in Python; single values and\nlists also in JSON: \
         --json, and {name}.json in --out; null: no value):\n"
    );
    for quantity in request.quantities() {
        text += &entry(&quantity);
    }
    text + "Tables:\n" + tables
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
    let mut lines = format!("  {:<1$}", quantity.name, NAMES - 2);
    if quantity.name.len() + 3 > NAMES {
        lines += &format!("\n{:NAMES$}", "");
    }
    let mut column = NAMES;
    for word in meaning.split(' ') {
        let length = word.chars().count();
        if column + length > WIDTH {
            lines = format!("{}\n{:NAMES$}", lines.trim_end(), "");
            column = NAMES;
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
pub(crate) const SWEEP: &str = "\
The study needs a [sweep] table; `saltus init paper` shows one. \"up\" runs from
sweep.from to sweep.to and \"down\" back, each value from the last state of the
one before; \"restarts\" takes each value anew from each of sweep.starts.
plate.inertia = \"slow-manifold\" is some 25 times as fast as \"full\",
\"condensed\" about a hundred times.

JSON (--json, and sweep.json in --out):
  parameter       the key that changes; unit and label say more
  passes          pass (from 0), direction (\"up\", \"down\", \"start\") and first
                  state: start_z (z/eta), start_v (z'/(eta omega_h))
  rows            one per pass and value, pass by pass, in each the values from
                  sweep.from to sweep.to, with the keys of the pass and
    value         of the parameter
    z, v          for each jumper a list of sweep.record samples at
                  cos(Omega t) = 1: height z/eta and velocity z'/(eta omega_h)
                  (-); fewer if the row ended early
    contact_ratio of each jumper, part of the recorded time on the floor (-)
    label         kind of the motion that goes on from the last state:
                  \"periodic\", \"quasi-periodic\", \"chaotic\" or \"undecided\"; null
                  if the row ended early. Up to 2000 more periods are run
    period        forcing periods of a cycle, at most 32; else null
    confidence    of the test behind the label or, if undecided, of the sign of
                  the exponent; null for a cycle known by its returns
    exponent, error
                  the sweep.exponents largest Lyapunov exponents per forcing
                  period (natural logarithm) and their standard errors, followed
                  from there for sweep.exponent_periods. With 0 the one that the
                  label took, if any
    status        as in `saltus simulate`, or \"no-model\"
    status_text   the same in a sentence
  version, study (as resolved)

Folder (--out):
  study.toml, sweep.json, sweep.csv (samples), rows.csv, sweep.nc (arrays over
  pass, value, jumper and sample: xarray.open_dataset) and the figures
  bifurcation and, with sweep.exponents, exponents as SVG and PNG.

A value that has no model, or whose run ends early, is a row that says so. Only
if no row is completed nothing is printed or written, and the exit code is 1 (2
if the study is to blame). Results are the same bits for any --threads.

With sweep.direction = \"restarts\" and --out finished pieces are kept until the
results are written; --resume, --shard and --merge as in `saltus map`.";

/// Below `saltus map --help`.
pub(crate) const MAP: &str = "\
The study needs a [map] table with [map.x] and [map.y]; `saltus init paper`
shows one. Each pixel runs anew from [start] until the motion has surely
settled, or for map.transient periods; then the cycle, or map.record periods,
is recorded. plate.inertia = \"condensed\" is about a hundred times as fast as
\"full\"; \"slow-manifold\" is some 25 times as fast, and far closer to it.

Layers (map.nc, over y and x, with units; NaN where there is no motion):
  period             of the attractor in forcing periods, 0 if not periodic
                     with a period up to 32
  status             0 periodic, 1 quasi-periodic, 2 chaotic, 3 not periodic
                     (map.exponent = 0 does not ask for more), 4 undecided (on
                     its way when the time was up, or on a longer cycle, or its
                     exponent too small to tell its sign), 5 no model,
                     6 chattering, 7 not finite, 8 too many steps, 9 ended
                     otherwise
  exponent           largest Lyapunov exponent per forcing period, where it took
                     one to say what the motion is
  exponent_error     its standard error
  contact_ratio      part of the time on the floor (-)
  peak_reaction      largest plate reaction force (body weights)
  peak_acceleration  largest absolute vertical acceleration of the floor under
                     the first jumper, base motion included (m/s2)
  periods_run        forcing periods computed
  chaotic_periods    forcing periods over which a chaotic motion was seen not to
                     settle, 0 where it is not chaotic: transient chaos that
                     lasts longer is called chaotic too
  Several jumpers have contact_ratio_0, contact_ratio_1, ... of their own.

JSON (--json, and map.json in --out):
  x_parameter, x_unit, x_label, x_from, x_to, x_count
                     the axes, y likewise
  pixels, outcomes   how many there are, and how many of each status
  periods            period, pixels and share of each period that occurs
  chaotic_over_min, chaotic_over_max
                     of chaotic_periods over the chaotic pixels; null if there
                     are none
  contact_ratio_min, contact_ratio_max
                     over the map, a list of one for each jumper; likewise
                     peak_reaction and, not of a jumper, peak_acceleration
  periods_run_total  forcing periods computed in all
  first_failure_x, first_failure_y, first_failure_status,
  first_failure_status_text
                     of the first pixel without a motion; null if there is none
  transient, record, version, study (as resolved)
  map.nc has all of these too.

Folder (--out):
  study.toml, map.json, map.nc (NetCDF: xarray.open_dataset), and the figures
  map (periods) and layers as SVG and PNG.

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

/// Below `saltus basins --help`.
pub(crate) const BASINS: &str = "\
The study needs a [basins] table with [basins.x] and [basins.y], the keys
start.z and start.v in either order; `saltus init paper` shows one. Each pixel
is a first state of every jumper, with the plate at rest; it is run as for
`saltus map`.

Two cycles are the same attractor if they have the same period and their
samples agree within 0.004 eta after some rotation. Motions that do not repeat
are the same if the ranges of their samples mostly overlap, so two chaotic
attractors may be joined. Numbers go by the share of the pixels, from 1. With
--match the attractors are sought along the sweep of [attractors] too, and have
the colours that they have there, so that pictures at several values agree.

Layers (basins.nc): attractor (its number, 0 for none) and those of
  `saltus map`, over y and x.

JSON (--json, and basins.json in --out):
  attractors         the most frequent first:
    attractor, period  its number; forcing periods, null if not periodic
    kind             \"periodic\", \"quasi-periodic\", \"chaotic\", \"undecided\", or
                     \"not-periodic\", no cycle with basins.exponent = 0
    matched          number in `saltus attractors` (--match); null if not met
    pixels, share    how many pixels lead to it, and of all
    start_z, start_v the first of them
    contact_ratio, peak_reaction, peak_acceleration
                     as in `saltus map`
    z, v             its samples at cos(Omega t) = 1: height z/eta and velocity
                     z'/(eta omega_h) (-), the lowest first, a list for each
                     jumper; empty if not periodic
    z_min, z_max, v_min, v_max
                     their ranges, also where it is not periodic
  and all that `saltus map` tells. In basins.nc the names of what is known of
  attractors begin with attractor_.

Folder (--out):
  study.toml, basins.json, basins.nc, attractors.csv (one line per attractor,
  jumper and sample) and the figures basins and layers as SVG and PNG.

--resume, --shard and --merge as in `saltus map`.";

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
pub(crate) const CONTINUE: &str = "\
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
switches.

JSON (--json, and continue.json in --out):
  parameter, unit, label, from, to
                  what changes; with [continue.second] also second_parameter,
                  second_unit, second_label, second_from, second_to
  branches        branch (from 0), origin (label of the special point where it
                  begins; null for the first), period, points (how many),
                  value_first, value_last, end_first, end_last (in words)
  points          of all branches, in their order along each: branch, point,
                  value, period, stability (as in `saltus orbit`), outside,
                  multiplier_re, multiplier_im (of the largest), sequence, and
                  z, v, phase, w, a list for each place of the orbit
  special_points  label, kind (PD, ...), name, branch, value of the parameter,
                  period (forcing periods), outside_before, outside_after
                  (Floquet multipliers outside the unit circle, in the order of
                  the branch), angle of the multipliers on the circle (rad, NS
                  only), sequence of switches as in `saltus orbit`, remark, z,
                  v, phase, w as above; orbit_value, modes and x (in the units
                  of the model) restart it
  complete        false if there are more branches than are followed
  curves          with [continue.second] curve (from 0), label, kind, points
                  (how many), end_first, end_last, error (null, or why there is
                  none)
  curve_points    of all curves: curve, label, point, value, second_value,
                  period, angle
  version, study (as resolved)

Folder (--out):
  study.toml, continue.json, branches.csv (one line per point and place of the
  orbit), special_points.csv, ends.csv, curves.csv, continue.nc (all of it as
  arrays, with all multipliers: xarray.open_dataset), and the figures branches
  and curves as SVG and PNG.
  Behind the branches lie the long-term motions at continue.cloud values, 50
  forcing periods after 150, the state carried on upwards and downwards.";

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
pub(crate) const ATTRACTORS: &str = "\
The table [attractors] says from which box first states are drawn, evenly but
without a pattern; `saltus init paper` shows one. Without the keys parameter,
from, to and count it asks at the study's own parameters, with them at each
value. There each attractor is also carried to the values beside, up to where
it ends. So rare ones are found too, and one that merely changes, as by
doubling its period, keeps its number. Motions are told apart as for
`saltus basins`; here slow transients are run on to what they become, every
cycle is confirmed by Newton's method and its Floquet multipliers, and chaos is
watched: eight motions on it, for 12 000 forcing periods each.

JSON (--json, and attractors.json in --out):
  parameter          the key that changes; unit and label say more; no key
                     without a parameter, and then each value is null
  starts_asked       first states at each value
  unseen             3/starts_asked: with 95 % confidence, a basin that no first
                     state met has a smaller part of the box
  attractors         one per value, from the lowest, and attractor met there:
    value            of the parameter
    attractor        number from 1; the same attractor has it at all values
    period           forcing periods; null if not periodic
    kind             \"periodic\", \"quasi-periodic\", \"chaotic\"
    multiplier       largest modulus of the Floquet multipliers of the cycle,
                     below 1; null if not periodic
    exponent, exponent_error
                     largest Lyapunov exponent per forcing period and its
                     standard error; null if periodic
    lifetime_low     chaos: forcing periods that its mean lifetime exceeds with
                     95 % confidence, since of watched_motions watched on it,
                     for watched_periods together, none left it; else null
    starts, share    first states that lead to it; 0 for one that was only
                     carried here; share_low and share_high are Wilson's
                     interval of 95 % confidence
    contact_ratio, peak_reaction, peak_acceleration
                     as in `saltus map`; the first two of each jumper
  sections           one per value and attractor met there: value, attractor,
                     and z, v, for each jumper a list of samples at
                     cos(Omega t) = 1: height z/eta and velocity
                     z'/(eta omega_h) (-), those of a cycle in an order that
                     connects along the parameter
  transients         chaos that is no attractor, since some of the motions
                     watched on it ended on a cycle: value, starts and share of
                     the first states that were still in it, motions, ended,
                     periods of all together, lifetime with its interval (of
                     95 % confidence), and attractor, the number of the one that
                     it ends on and that its starts count for
  ranges             one per attractor:
    first, last      values at which it was met first and last
    birth_low, birth_high, death_low, death_high
                     the values between which it begins and ends; null at the
                     ends of the range
    birth_to, death_to
                     the attractor to which a motion jumps beyond, null if not
                     known
  loops              of hysteresis:
    from, to         first and last value at which the ways differ
    up, down         numbers of the attractors on the way up and on the way down
    period_up, period_down
                     their periods where they jump; null if not periodic
    jump_up_low, jump_up_high, jump_down_low, jump_down_high
                     between which values they jump; null if they do not
  rows               one per value: undecided and lost, the share of first
                     states that came to no attractor, since they were still on
                     their way or their run ended early, each with _starts, _low
                     and _high; first_failure_status and _status_text of the
                     first that is lost, or why there is no model; else null
  unfinished         motions that were still being carried when it took too
                     long; if not 0 an attractor may have several numbers
  periods_run, version, study (as resolved)

Folder (--out):
  study.toml, attractors.json, attractors.csv (one line per value, attractor and
  jumper), sections.csv (one per sample of these), transients.csv, ranges.csv,
  loops.csv, rows.csv, attractors.nc (arrays over value and attractor:
  xarray.open_dataset), and the figure attractors as SVG and PNG.

Results are the same bits for any --threads.";

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

#[cfg(test)]
mod tests {
    #[test]
    fn lines_fit_a_terminal() {
        let made = [super::simulate(), super::orbit(), super::lyapunov()];
        let all = [
            super::SWEEP,
            super::MAP,
            super::BASINS,
            super::CONTINUE,
            super::ATTRACTORS,
            super::CITE,
            super::RERUN,
        ];
        let made = made.iter().map(String::as_str);
        for line in all.into_iter().chain(made).flat_map(str::lines) {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}
