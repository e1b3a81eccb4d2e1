//! What the help of a command says below its options. Lines fit a terminal of 80 columns.

/// Below `saltus simulate --help`.
pub(crate) const SIMULATE: &str = "\
JSON (--json, and simulate.json in --out):
  section         one object per forcing period, at cos(Omega t) = 1, the start
                  not included; z, v, phase are bare values for one jumper,
                  lists for several, [] for none:
    z             height z/eta (-), eta = g/omega_h^2
    v             velocity z'/(eta omega_h) (-)
    phase         \"contact\" or \"flight\"
    w             amplitudes r_j/h (-), in the order of plate.modes
  switches        time (s), jumper (from 0), kind: \"take-off\", \"touch-down\" or
                  \"tangency\"
  status          \"completed\", \"chattering\", \"not-finite\", \"too-many-steps\"
  status_text     the same in a sentence
  contact_ratio   part of the time on the floor, simulate.transient left out (-)
  peak_prf        largest plate reaction force in the time history (body
                  weights); null if the run ended before it
  energy          balance of each period (J),
                  stored = base + gravity - plate - legs + residual;
                  max_relative_residual is the largest |residual| over
                  max_turnover, the most energy turned over in one period;
                  in-plane kinetic energy counts for inertia = \"full\" only
  periods, period_s, base_hz, steps, version, study (as resolved)

Folder (--out):
  study.toml, simulate.json, section.csv, switches.csv, history.csv, energy.csv,
  simulate.nc (all of these as arrays: xarray.open_dataset) and the figures
  portrait and history as SVG and PNG (for an empty plate the figure section).
  The time history covers the last 20 periods at most; simulate.transient is
  left out of it and of the figures.

A run that ends early (chattering, ...) is told in full, with its status, and
ends with exit code 1. solver.method = \"rk4\" with a step above its stability
limit is refused with exit code 2.";

/// Below `saltus sweep --help`.
pub(crate) const SWEEP: &str = "\
The study needs a [sweep] table; `saltus init paper` shows one. \"up\" runs from
sweep.from to sweep.to and \"down\" back, each value from the last state of the
one before; \"restarts\" takes each value anew from each of sweep.starts.
plate.inertia = \"slow-manifold\" is some 25 times as fast as \"full\",
\"condensed\" about a hundred times.

JSON (--json, and sweep.json in --out):
  parameter       the key that changes; unit and label say more
  passes          direction (\"up\", \"down\", \"start\") and first state
                  start = [z/eta, z'/(eta omega_h)]
  rows            one per pass and value, pass by pass, in each the values from
                  sweep.from to sweep.to:
    pass          which, from 0, with its direction and start
    value         of the parameter
    z, v          sweep.record samples at cos(Omega t) = 1: height z/eta and
                  velocity z'/(eta omega_h) (-); a list for one jumper, a list
                  of lists for several
    contact_ratio part of the recorded time on the floor (-), likewise
    label         what the motion is that goes on from the last state:
                  \"periodic\", \"quasi-periodic\", \"chaotic\" or \"undecided\"; null
                  if the row ended early. Up to 2000 more periods are run
    period        forcing periods of a cycle, at most 32; else null
    confidence    of the test behind the label or, if undecided, of the sign of
                  the exponent; null for a cycle known by its returns
    exponents     the sweep.exponents largest Lyapunov exponents, followed from
                  there for sweep.exponent_periods: per_period (natural
                  logarithm) and standard_error. With 0 that which the label
                  took, if any
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
pub(crate) const ORBIT: &str = "\
Newton's method from the motion that [start] leads to after orbit.transient
periods. With orbit.period = 0 the orbit is one that this motion is near, in
chaos an unstable one; otherwise one of orbit.period forcing periods, or of a
part of them if it closes sooner. The integration has a tolerance of 1e-13
whatever [solver] says.

JSON (--json, and orbit.json in --out):
  period          forcing periods after which it closes
  asked           orbit.period; null if that is 0
  section         its points at cos(Omega t) = 1, period many, as in
                  `saltus simulate`: z, v, w, phase
  multipliers     Floquet multipliers [re, im] of the whole orbit, by falling
                  modulus
  multiplier_errors
                  how far each may be off: 1e-11 of the derivative of a period,
                  times the condition of the eigenvalue
  stability       \"stable\": all inside the unit circle; \"unstable\": some
                  outside; \"neutral\": none outside, and some so near to it that
                  rounding says on which side
  stable          true, false, or null if neutral
  outside         how many lie outside, by more than their errors
  in_family       whether one is 1 to its error: other orbits lie beside this
                  one, as where a quantity is conserved; Newton's steps keep its
                  value to first order
  switches        once around, as in `saltus simulate`: time (s) since the first
                  point, jumper, kind
  sequence        the order of its switches: T take-off, L landing (with the
                  number of the jumper from 1 if there are several), | between
                  forcing periods
  contact_ratio   part of the time on the floor (-)
  landing_phases  of each touch-down, Omega t in (0, 2 pi] (rad)
  peak_prf        largest plate reaction force (body weights)
  residual        largest gap left between the pieces of the orbit (h, h Omega)
  iterations      steps of Newton's method
  segments        pieces that it joined
  base_hz, period_s (of one forcing period), version, study (as resolved)
  contact_ratio, landing_phases and peak_prf are of one jumper, or a list for
  several.

Folder (--out):
  study.toml, orbit.json, section.csv, multipliers.csv, switches.csv, orbit.nc
  (these and the way around as arrays: xarray.open_dataset) and the figures
  portrait and multipliers as SVG and PNG.

If no orbit is found the exit code is 1, and the message says how far the search
came.";

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
pub(crate) const LYAPUNOV: &str = "\
The motion from [start] is run for lyapunov.transient forcing periods. From
there on lyapunov.replicas pieces of it, one after the other and each
lyapunov.periods long, are run side by side with the tangent flow; a switch
multiplies that by its saltation matrix. Columns that part by more than rounding
allows within a period are kept apart as often as it takes. An exponent is the
mean growth of a small deviation, natural logarithm, per forcing period. The
drive keeps its phase: its exponent, 0, is not counted.
All exponents of plate.inertia = \"full\" take hours where those of \"condensed\"
take seconds; lyapunov.exponents = 1 asks for the largest alone.

JSON (--json, and lyapunov.json in --out):
  nature          what the motion is, by tests at a confidence of 0.999:
    name          \"periodic\", \"quasi-periodic\", \"chaotic\", \"undecided\"
    period        forcing periods; null if not periodic
    confidence    that the test behind the name did not come out by chance; if
                  undecided, that the largest exponent has the sign it shows
    text          what the name means, or why there is none and what may help
  from            \"orbit\": the motion has come to a cycle, and exponents are
                  those of its multipliers; \"record\": means of the record
  exponents       the largest first, but for their errors:
    per_period    per forcing period; null for -inf, a direction that shrinks
                  to nothing at a switch, as a relaxing leg at touch-down
    standard_error
                  from 20 batches of the whole record, rounding included; null
                  if the record is too short for one
    interval      [low, high]: holds the true value with a probability of 0.95,
                  by Student's t, if the motion forgets where it was within a
                  twentieth of the record
    per_second, per_second_error
                  the same in 1/s
  sum             of these exponents, likewise
  divergence      of the flow, a check of the sum:
    per_period    its time integral over a period, on average
    must_agree    whether it must be the sum, and reason
    difference    sum less divergence; null where they need not agree
  kaplan_yorke    dimension of the attractor in the section: value and
                  standard_error; null if more exponents or a longer record
                  are needed
  status          as in `saltus simulate`; status_text the same in a sentence
  states          of the model, the most exponents possible
  periods_measured
                  of all replicas together
  transient, periods, replicas, base_hz, period_s, version, study (as resolved)

Folder (--out):
  study.toml, lyapunov.json, convergence.csv (the exponents from the first
  periods of the record, over how many these are), lyapunov.nc (as arrays:
  xarray.open_dataset) and the figure convergence as SVG and PNG.

Replicas that end early (chattering, ...) are told with what they measured, and
exit code 1. Results are the same bits for any --threads.";

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
  parameter          the key that changes; unit and label say more; null if none
  starts             first states at each value
  unseen             3/starts: with 95 % confidence, a basin that no first state
                     met has a smaller part of the box
  rows               one per value, from the lowest:
    value            of the parameter
    attractors       those with the most first states first:
      number         from 1; the same attractor has the same at all values
      period         forcing periods; null if not periodic
      kind           \"periodic\", \"quasi-periodic\", \"chaotic\"
      multiplier     largest modulus of the Floquet multipliers of the cycle,
                     below 1; null if not periodic
      exponent, exponent_error
                     largest Lyapunov exponent per forcing period and its
                     standard error; null if periodic
      survival       chaos: motions watched on it, ended (0), periods of all of
                     them together, and lifetime [mean, low, high] in forcing
                     periods, null where infinite: low is exceeded with 95 %
                     confidence; null if not chaotic
      starts, share  first states that lead to it; 0 for one that was only
                     carried here. share = [value, low, high], with Wilson's
                     95 % confidence interval
      contact_ratio, peak_reaction, peak_acceleration
                     as in `saltus map`
      z, v           its samples at cos(Omega t) = 1: height z/eta and velocity
                     z'/(eta omega_h) (-), those of a cycle in an order that
                     connects along the parameter; a list for one jumper, a
                     list of lists for several
    transients       chaos that is no attractor, since some of the motions
                     watched on it ended on a cycle: starts and share that were
                     still in it, motions, ended, periods and lifetime as above
                     (a 95 % confidence interval), and to, the number of the
                     attractor that it ends on and that its starts count for
    undecided, lost  first states that came to no attractor, since they were
                     still on their way or their run ended early; likewise
                     starts and share
    first_failure    status and status_text of the first that is lost, or why
                     there is no model; null if there is none
  attractors         one per number:
    first, last      values at which it was met first and last
    birth, death     the values between which it begins and ends, and the number
                     of the attractor to which a motion jumps beyond; null at
                     the ends of the range
  loops              of hysteresis:
    from, to         first and last value at which the ways differ
    up, down         numbers of the attractors on the way up and on the way down
    period_up, period_down
                     their periods where they jump; null if not periodic
    jump_up, jump_down
                     between which values they jump; null if they do not
  unfinished         motions that were still being carried when it took too
                     long; if not 0 an attractor may have several numbers
  periods_run, version, study (as resolved)

Folder (--out):
  study.toml, attractors.json, attractors.csv (one line per value, attractor and
  jumper), sections.csv (one per sample of these), transients.csv, loops.csv,
  attractors.nc
  (arrays over value and attractor: xarray.open_dataset), and the figure
  attractors as SVG and PNG.

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
        let all = [
            super::SIMULATE,
            super::SWEEP,
            super::MAP,
            super::BASINS,
            super::ORBIT,
            super::CONTINUE,
            super::LYAPUNOV,
            super::ATTRACTORS,
            super::CITE,
            super::RERUN,
        ];
        for line in all.iter().flat_map(|h| h.lines()) {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}
