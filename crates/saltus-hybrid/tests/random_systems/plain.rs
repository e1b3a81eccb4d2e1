//! A plain stepper: classical Runge-Kutta in tiny steps, switches by bisection, and the rules of events taken from
//! their description in docs/numerics.md. It knows nothing of the engine.
//!
//! Where the motion itself hangs on less than the accuracy of either side, the run says that it is doubtful, and
//! why: that is the only ground on which a case is left out of the comparison.

use crate::case::{Case, Mode, Poly, Rule};

/// Steps in a period.
pub(crate) const STEPS: u32 = 600;
/// Orders of a guard's series that are looked at where it is zero.
const ORDERS: usize = 6;
/// Below this part of its own terms a coefficient is zero, to rounding.
const ZERO: f64 = 1e-10;
/// Between zero and this it is too small to tell.
const UNCLEAR: f64 = 1e-7;
/// A guard that comes so near to zero, in units of its terms, and turns back, grazes; one that crosses at less than
/// this rate does so too.
const GRAZE: f64 = 1e-4;
/// Switches closer than this are at one instant, to rounding of their times;
const AT_ONCE: f64 = 1e-10;
/// closer than this, but not at one instant, which comes first depends on errors of the steppers.
const TOO_CLOSE: f64 = 1e-6;
/// Switches in one period after which a run has ended as chattering.
pub(crate) const MOST: u32 = 100;
/// A state beyond this is on its way to infinity.
const LARGE: f64 = 30.0;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Switch {
    pub(crate) time: f64,
    pub(crate) unit: usize,
    pub(crate) from: usize,
    pub(crate) to: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Ending {
    Completed,
    /// Too many switches, at this time.
    Chattering(f64),
}

/// What there is to compare.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Run {
    /// Modes and state at the end of each period.
    pub(crate) samples: Vec<(Vec<usize>, Vec<f64>)>,
    pub(crate) switches: Vec<Switch>,
    pub(crate) ending: Ending,
    /// Whether two switches were due at one instant, so that their order may matter.
    pub(crate) tie: bool,
}

/// Why a case is left out.
pub(crate) type Doubt = &'static str;

/// Runs a case; of switches due at the same instant the first by unit and place goes first, or the last.
pub(crate) fn run(case: &Case, last_first: bool) -> Result<Run, Doubt> {
    let mut stepper = Stepper::new(case, last_first);
    for _ in 0..case.periods {
        if !stepper.period()? {
            break;
        }
    }
    Ok(stepper.out)
}

/// What a guard is about to do.
#[derive(Clone, Copy, PartialEq)]
enum Stand {
    /// On its right side: the mode ends where it reaches zero.
    Armed,
    /// Zero, or on its way back from the wrong side: nothing happens before it has come to the right side.
    Idle,
    /// On its wrong side, or about to be.
    Due,
}

struct Stepper<'a> {
    case: &'a Case,
    last_first: bool,
    modes: Vec<usize>,
    /// Time within the period, and all variables: states, cos, sin.
    time: f64,
    v: Vec<f64>,
    /// Rates in the present modes.
    field: Vec<Poly>,
    stands: Vec<Stand>,
    recent: u32,
    out: Run,
}

impl<'a> Stepper<'a> {
    fn new(case: &'a Case, last_first: bool) -> Self {
        let mut v = case.start.clone();
        v.extend([1.0, 0.0]);
        let out = Run {
            samples: Vec::new(),
            switches: Vec::new(),
            ending: Ending::Completed,
            tie: false,
        };
        let mut stepper = Self {
            case,
            last_first,
            modes: case.modes(),
            time: 0.0,
            v,
            field: Vec::new(),
            stands: Vec::new(),
            recent: 0,
            out,
        };
        stepper.enter();
        stepper
    }

    fn mode(&self, unit: usize) -> &'a Mode {
        &self.case.units[unit].1[self.modes[unit]]
    }

    /// Rules in force, with their unit.
    fn rules(&self) -> Vec<(usize, &'a Rule)> {
        let of = |unit| self.mode(unit).rules.iter().map(move |rule| (unit, rule));
        (0..self.modes.len()).flat_map(of).collect()
    }

    /// The field of the present modes.
    fn enter(&mut self) {
        self.field = self.case.rates.clone();
        for unit in 0..self.modes.len() {
            for (state, add) in &self.mode(unit).adds {
                self.field[*state].0.extend(add.0.iter().cloned());
            }
        }
    }

    /// One period, with its sample; false if the run is over.
    fn period(&mut self) -> Result<bool, Doubt> {
        let period = self.case.period();
        (self.time, self.recent) = (0.0, 0);
        self.clock(0.0);
        if !self.at_once()? {
            return Ok(false);
        }
        let whole = period / f64::from(STEPS);
        let mut h = whole / 256.0;
        while self.time < period {
            let left = period - self.time;
            let to_end = left <= h * (1.0 + 1e-9);
            let switched = self.step(if to_end { left } else { h })?;
            if to_end && !switched {
                self.time = period;
            }
            h = if switched {
                whole / 256.0
            } else {
                (2.0 * h).min(whole)
            };
            if switched && !self.at_once()? {
                return Ok(false);
            }
        }
        self.stand()?;
        if !self.at_once()? {
            return Ok(false);
        }
        let n = self.case.rates.len();
        self.out
            .samples
            .push((self.modes.clone(), self.v[..n].to_vec()));
        Ok(true)
    }

    fn clock(&mut self, time: f64) {
        let n = self.case.rates.len();
        let (sin, cos) = (self.case.omega * time).sin_cos();
        (self.v[n], self.v[n + 1]) = (cos, sin);
    }

    fn rates(&self, v: &[f64]) -> Vec<f64> {
        let n = self.field.len();
        let mut out: Vec<f64> = self.field.iter().map(|rate| rate.value(v)).collect();
        out.extend([-self.case.omega * v[n + 1], self.case.omega * v[n]]);
        out
    }

    /// The variables after a step of length `h`; the drive's are exact.
    fn ahead(&self, h: f64) -> Vec<f64> {
        let n = self.field.len();
        let at = |k: &[f64], h: f64| -> Vec<f64> {
            let mut v: Vec<f64> = self.v.iter().zip(k).map(|(v, k)| v + h * k).collect();
            let (sin, cos) = (self.case.omega * (self.time + h)).sin_cos();
            (v[n], v[n + 1]) = (cos, sin);
            v
        };
        let a = self.rates(&self.v);
        let b = self.rates(&at(&a, 0.5 * h));
        let c = self.rates(&at(&b, 0.5 * h));
        let d = self.rates(&at(&c, h));
        let mean = |i: usize| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0;
        at(&(0..a.len()).map(mean).collect::<Vec<_>>(), h)
    }

    /// Goes on by `h`, or to the first switch before and carries it out; tells whether there was one.
    fn step(&mut self, h: f64) -> Result<bool, Doubt> {
        let end = self.ahead(h);
        if end.iter().any(|x| x.is_nan() || x.abs() > LARGE) {
            return Err("large");
        }
        let rates = [&self.v, &end].map(|v| self.rates(v));
        let mut found: Vec<(f64, usize)> = Vec::new();
        let rules = self.rules();
        for (at, (_, rule)) in rules.iter().enumerate() {
            let [g0, g1] = [&self.v, &end].map(|v| rule.sign * rule.guard.value(v));
            let [d0, d1] =
                [(&self.v, 0), (&end, 1)].map(|(v, i)| rule.sign * rule.guard.rate(v, &rates[i]));
            let size = size(&rule.guard, &self.v);
            match self.stands[at] {
                Stand::Armed if g1 <= 0.0 => {
                    let time = self.bisect(rule, h);
                    if d0.min(d1) > -GRAZE * size {
                        return Err("grazing");
                    }
                    found.push((time, at));
                }
                Stand::Armed if d0 < 0.0 && d1 > 0.0 => {
                    let lowest = g0 - 0.5 * d0 * d0 * h / (d1 - d0);
                    if lowest < GRAZE * size {
                        return Err("grazing");
                    }
                }
                Stand::Idle if g1 > UNCLEAR * size => self.stands[at] = Stand::Armed,
                // It did not get to the right side, or went there and came back within a tiny step.
                Stand::Idle if g1 < -UNCLEAR * size && d1 <= 0.0 => return Err("turns back"),
                _ => {}
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(&(first, _)) = found.first() else {
            self.v = end;
            self.time += h;
            return Ok(false);
        };
        let gaps = found.iter().map(|&(time, _)| time - first);
        if gaps.clone().any(|gap| gap > AT_ONCE && gap < TOO_CLOSE) {
            return Err("two switches nearly at once");
        }
        let due: Vec<usize> = found
            .iter()
            .filter(|f| f.0 - first <= AT_ONCE)
            .map(|f| f.1)
            .collect();
        self.v = self.ahead(first);
        self.time += first;
        self.near_a_sample()?;
        self.fire(&due);
        Ok(true)
    }

    /// Time from now to where a guard that is negative after `h` reaches zero.
    fn bisect(&self, rule: &Rule, h: f64) -> f64 {
        let (mut lo, mut hi) = (0.0, h);
        while hi - lo > 1e-15 * h + 1e-16 {
            let middle = 0.5 * (lo + hi);
            if middle <= lo || middle >= hi {
                break;
            }
            if rule.sign * rule.guard.value(&self.ahead(middle)) > 0.0 {
                lo = middle;
            } else {
                hi = middle;
            }
        }
        hi
    }

    fn near_a_sample(&self) -> Result<(), Doubt> {
        let from_sample = self.time.min(self.case.period() - self.time);
        let clear = !(AT_ONCE..TOO_CLOSE).contains(&from_sample);
        clear.then_some(()).ok_or("nearly at a sample")
    }

    /// Carries out one of the rules due now, by their places among those in force.
    fn fire(&mut self, due: &[usize]) {
        self.out.tie |= due.len() > 1;
        let rules = self.rules();
        let chosen = if self.last_first {
            due.iter().max()
        } else {
            due.iter().min()
        };
        let Some(&(unit, rule)) = chosen.map(|&at| &rules[at]) else {
            return;
        };
        self.out.switches.push(Switch {
            time: self.out.samples.len() as f64 * self.case.period() + self.time,
            unit,
            from: self.modes[unit],
            to: rule.to,
        });
        self.recent += 1;
        let values: Vec<f64> = rule
            .resets
            .iter()
            .map(|(_, value)| value.value(&self.v))
            .collect();
        for ((state, _), value) in rule.resets.iter().zip(values) {
            self.v[*state] = value;
        }
        self.modes[unit] = rule.to;
        self.enter();
    }

    /// Carries out what is due at this very instant, one after the other; false if that is too much.
    fn at_once(&mut self) -> Result<bool, Doubt> {
        loop {
            if self.recent > MOST {
                let time = self.out.samples.len() as f64 * self.case.period() + self.time;
                self.out.ending = Ending::Chattering(time);
                return Ok(false);
            }
            self.stand()?;
            let due: Vec<usize> = (0..self.stands.len())
                .filter(|&at| self.stands[at] == Stand::Due)
                .collect();
            if due.is_empty() {
                return Ok(true);
            }
            self.fire(&due);
        }
    }

    /// How each guard in force stands at this point, from the point alone.
    fn stand(&mut self) -> Result<(), Doubt> {
        let (values, sizes) = self.series();
        let stand = |rule: &Rule| -> Result<Stand, Doubt> {
            let guard = of_series(&rule.guard, &values, |c| rule.sign * c);
            let size = of_series(&rule.guard, &sizes, f64::abs);
            for k in 0..ORDERS {
                let part = guard[k] / size[k].max(f64::MIN_POSITIVE);
                if part.abs() > UNCLEAR {
                    return Ok(match (part > 0.0, k) {
                        (true, 0) => Stand::Armed,
                        (true, _) => Stand::Idle,
                        (false, 0) => back(&guard, &size)?,
                        (false, _) => Stand::Due,
                    });
                }
                if part.abs() > ZERO {
                    return Err("nearly zero");
                }
            }
            Ok(Stand::Idle)
        };
        let stands: Result<Vec<_>, _> = self.rules().iter().map(|(_, rule)| stand(rule)).collect();
        self.stands = stands?;
        Ok(())
    }

    /// Taylor coefficients of all variables here, and sums of the absolute values of the terms in them.
    fn series(&self) -> (Vec<[f64; ORDERS]>, Vec<[f64; ORDERS]>) {
        let n = self.field.len();
        let mut out = [Vec::new(), Vec::new()];
        for (out, absolute) in out.iter_mut().zip([false, true]) {
            let omega = self.case.omega;
            let part = |c: f64| if absolute { c.abs() } else { c };
            let first = |&v: &f64| std::array::from_fn(|k| if k == 0 { part(v) } else { 0.0 });
            *out = self.v.iter().map(first).collect::<Vec<[f64; ORDERS]>>();
            for k in 1..ORDERS {
                let rate = |poly: &Poly| of_series(poly, out, part)[k - 1];
                let mut next: Vec<f64> = self.field.iter().map(rate).collect();
                next.extend([part(-omega) * out[n + 1][k - 1], omega * out[n][k - 1]]);
                for (series, next) in out.iter_mut().zip(next) {
                    series[k] = next / k as f64;
                }
            }
        }
        let [values, sizes] = out;
        (values, sizes)
    }
}

/// Sum of the absolute values of the terms.
fn size(poly: &Poly, v: &[f64]) -> f64 {
    let absolute: Vec<f64> = v.iter().map(|v| v.abs()).collect();
    Poly(poly.0.iter().map(|(c, f)| (c.abs(), f.clone())).collect()).value(&absolute)
}

/// A guard on its wrong side: it is due unless its rate leads back.
fn back(guard: &[f64; ORDERS], size: &[f64; ORDERS]) -> Result<Stand, Doubt> {
    for k in 1..ORDERS {
        let part = guard[k] / size[k].max(f64::MIN_POSITIVE);
        if part.abs() > UNCLEAR {
            return Ok(if part > 0.0 { Stand::Idle } else { Stand::Due });
        }
        if part.abs() > ZERO {
            return Err("nearly zero");
        }
    }
    Err("rests on its wrong side")
}

/// A polynomial of series, its coefficients passed through `part`.
fn of_series(poly: &Poly, v: &[[f64; ORDERS]], part: impl Fn(f64) -> f64) -> [f64; ORDERS] {
    let mut sum = [0.0; ORDERS];
    for (c, factors) in &poly.0 {
        let mut term = [0.0; ORDERS];
        term[0] = part(*c);
        for &i in factors {
            let product = |k: usize| (0..=k).map(|j| term[j] * v[i][k - j]).sum();
            term = std::array::from_fn(product);
        }
        sum.iter_mut()
            .zip(term)
            .for_each(|(sum, term)| *sum += term);
    }
    sum
}
