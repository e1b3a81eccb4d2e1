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
                  max_turnover, the most energy turned over in one period
  periods, period_s, base_hz, steps, version, study (as resolved)

Folder (--out):
  study.toml, simulate.json, section.csv, switches.csv, history.csv, energy.csv
  and the figures portrait and history as SVG and PNG (for an empty plate the
  figure section). The time history covers the last 20 periods at most;
  simulate.transient is left out of it and of the figures.

A run that ends early (chattering, ...) is told in full, with its status, and
ends with exit code 1. solver.method = \"rk4\" with a step above its stability
limit is refused with exit code 2.";

/// Below `saltus sweep --help`.
pub(crate) const SWEEP: &str = "\
The study needs a [sweep] table; `saltus init paper` shows one. \"up\" runs from
sweep.from to sweep.to and \"down\" back, each value from the last state of the
one before; \"restarts\" takes each value anew from each of sweep.starts.

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
    recurrence    after how many periods the samples repeat to 1e-6; null if
                  not within half of them. A count, no proof of periodicity
    status        as in `saltus simulate`, or \"no-model\"
    status_text   the same in a sentence
  version, study (as resolved)

Folder (--out):
  study.toml, sweep.json, sweep.csv (samples), rows.csv and the figure
  bifurcation as SVG and PNG.

A value that has no model, or whose run ends early, is a row that says so. Only
if no row is completed nothing is printed or written, and the exit code is 1 (2
if the study is to blame). Results are the same bits for any --threads.";

#[cfg(test)]
mod tests {
    #[test]
    fn lines_fit_a_terminal() {
        for line in [super::SIMULATE, super::SWEEP]
            .iter()
            .flat_map(|h| h.lines())
        {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}
