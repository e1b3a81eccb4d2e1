//! A plain stepper: classical Runge-Kutta in tiny steps, switches by bisection, and the rules of events taken from
//! their description in docs/numerics.md ("Rules of events"). It knows nothing of the engine.
//!
//! Where the motion itself hangs on less than the accuracy of either side, the run says that it is doubtful, and
//! why: that is the only ground on which a case is left out of the comparison.

use crate::case::{Case, Poly, Rule};

/// Steps in a period.
pub(crate) const STEPS: u32 = 600;
/// Orders of a guard's series that are looked at where it is zero.
const ORDERS: usize = 6;
/// Below this part of its own terms a coefficient is zero, to rounding.
const ZERO: f64 = 2e-12;
/// A variable near zero is the difference of terms of at least this size.
const SMALL: f64 = 0.1;
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

/// Whether to compare cases in which a held guard turns away: the engine locates a turn to the accuracy of its
/// interpolant only, and other guards of the same state are judged by what is left of the rate.
const TURNS: bool = false;
/// Whether to compare cases in which a chain of switches at one instant is found to lead nowhere: the engine forgets
/// within it that the guard it began with is zero.
const HELD_IN_CHAINS: bool = true;

/// Whether to compare cases in which two units switch at the instant of a sample: where one of them is found an ulp
/// before it, the engine takes the sample before the other.
const TWO_AT_A_SAMPLE: bool = true;

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
    /// On its right side: it fires where it reaches zero.
    Armed,
    /// Zero: nothing happens before it has come to its right side.
    Idle,
    /// Beyond zero and not going further, and firing would lead nowhere: it fires where it turns away.
    Held,
    /// It falls from zero, or is beyond.
    Due,
}

/// A guard just after a point, as its mode sees it: zero derivatives before the first that is not, the sign of that
/// one, and that of the next.
#[derive(Clone, Copy)]
struct Side {
    zeros: usize,
    sign: f64,
    trend: f64,
}

impl Side {
    fn ends(self) -> bool {
        self.sign < 0.0
    }

    fn may_be_held(self) -> bool {
        self.ends() && self.zeros == 0 && self.trend >= 0.0
    }
}

/// Modes, and all variables: states, cos, sin.
#[derive(Clone)]
struct Place {
    modes: Vec<usize>,
    v: Vec<f64>,
}

struct Stepper<'a> {
    case: &'a Case,
    last_first: bool,
    /// Time within the period.
    time: f64,
    at: Place,
    /// Rates in the present modes.
    field: Vec<Poly>,
    stands: Vec<Stand>,
    /// Rules held: unit and place in its mode.
    held: Vec<(usize, usize)>,
    recent: u32,
    out: Run,
}

impl Case {
    /// Rules in force, with their unit and place.
    fn rules(&self, modes: &[usize]) -> Vec<(usize, usize, &Rule)> {
        let of = |unit: usize| {
            let rules = self.units[unit].1[modes[unit]].rules.iter().enumerate();
            rules.map(move |(i, rule)| (unit, i, rule))
        };
        (0..modes.len()).flat_map(of).collect()
    }

    /// The field in these modes.
    fn field(&self, modes: &[usize]) -> Vec<Poly> {
        let mut field = self.rates.clone();
        for (&mode, (_, all)) in modes.iter().zip(&self.units) {
            for (state, add) in &all[mode].adds {
                field[*state].0.extend(add.0.iter().cloned());
            }
        }
        field
    }

    fn carry_out(&self, (unit, rule): (usize, &Rule), at: &mut Place) {
        let values: Vec<f64> = rule
            .resets
            .iter()
            .map(|(_, value)| value.value(&at.v))
            .collect();
        for ((state, _), value) in rule.resets.iter().zip(values) {
            at.v[*state] = value;
        }
        at.modes[unit] = rule.to;
    }

    /// Sides of the rules in force.
    fn sides(&self, at: &Place) -> Result<Vec<Side>, Doubt> {
        let field = self.field(&at.modes);
        let values = self.series(&field, &at.v, |c| c);
        let sizes: Vec<f64> = at.v.iter().map(|v| v.abs() + SMALL).collect();
        let sizes = self.series(&field, &sizes, f64::abs);
        let side = |(_, _, rule): &(usize, usize, &Rule)| {
            let guard = of_series(&rule.guard, &values, |c| rule.sign * c);
            let size = of_series(&rule.guard, &sizes, f64::abs);
            let mut signs = guard.iter().zip(size).map(|(g, size)| {
                let part = g / size.max(f64::MIN_POSITIVE);
                match part.abs() {
                    p if p <= ZERO => Ok(0.0),
                    p if p <= UNCLEAR => Err("nearly zero"),
                    _ => Ok(part.signum()),
                }
            });
            let mut nonzero = || {
                signs
                    .by_ref()
                    .find(|sign| *sign != Ok(0.0))
                    .unwrap_or(Ok(0.0))
            };
            let sign = nonzero()?;
            let zeros = guard
                .iter()
                .zip(size)
                .take_while(|(g, size)| g.abs() <= ZERO * size)
                .count();
            let trend = if sign < 0.0 { nonzero()? } else { 0.0 };
            Ok(Side { zeros, sign, trend })
        };
        self.rules(&at.modes).iter().map(side).collect()
    }

    /// Taylor coefficients of all variables, their numbers passed through `part`.
    fn series(&self, field: &[Poly], v: &[f64], part: fn(f64) -> f64) -> Vec<[f64; ORDERS]> {
        let n = field.len();
        let first = |&v: &f64| std::array::from_fn(|k| if k == 0 { part(v) } else { 0.0 });
        let mut out: Vec<[f64; ORDERS]> = v.iter().map(first).collect();
        for k in 1..ORDERS {
            let rate = |poly: &Poly| of_series(poly, &out, part)[k - 1];
            let mut next: Vec<f64> = field.iter().map(rate).collect();
            next.extend([
                part(-self.omega) * out[n + 1][k - 1],
                self.omega * out[n][k - 1],
            ]);
            for (series, next) in out.iter_mut().zip(next) {
                series[k] = next / k as f64;
            }
        }
        out
    }

    /// Whether firing a rule leads, by whatever fires with it, to modes that last.
    fn settles(&self, at: &Place, (unit, rule): (usize, &Rule)) -> Result<bool, Doubt> {
        let mut at = at.clone();
        let mut moved = vec![unit];
        self.carry_out((unit, rule), &mut at);
        let modes: usize = self.units.iter().map(|(_, modes)| modes.len()).sum();
        for _ in 0..2 * modes {
            let sides = self.sides(&at)?;
            let rules = self.rules(&at.modes);
            let next = rules.iter().zip(sides).find(|((unit, _, _), side)| {
                side.ends() && (moved.contains(unit) || !side.may_be_held())
            });
            let Some((&(unit, _, rule), _)) = next else {
                return Ok(true);
            };
            moved.push(unit);
            self.carry_out((unit, rule), &mut at);
        }
        Ok(false)
    }
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
        Self {
            case,
            last_first,
            time: 0.0,
            at: Place {
                modes: case.modes(),
                v,
            },
            field: case.field(&case.modes()),
            stands: Vec::new(),
            held: Vec::new(),
            recent: 0,
            out,
        }
    }

    fn total_time(&self) -> f64 {
        self.out.samples.len() as f64 * self.case.period() + self.time
    }

    /// One period, with its sample; false if the run is over.
    fn period(&mut self) -> Result<bool, Doubt> {
        let (period, n) = (self.case.period(), self.field.len());
        (self.time, self.recent) = (0.0, 0);
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
            if switched {
                let before = self.out.switches.len();
                if !self.at_once()? {
                    return Ok(false);
                }
                if self.out.switches.len() == before {
                    return Err("nearly zero");
                }
            }
        }
        if !self.at_once()? {
            return Ok(false);
        }
        self.out
            .samples
            .push((self.at.modes.clone(), self.at.v[..n].to_vec()));
        Ok(true)
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
            let mut v: Vec<f64> = self.at.v.iter().zip(k).map(|(v, k)| v + h * k).collect();
            let (sin, cos) = (self.case.omega * (self.time + h)).sin_cos();
            (v[n], v[n + 1]) = (cos, sin);
            v
        };
        let a = self.rates(&self.at.v);
        let b = self.rates(&at(&a, 0.5 * h));
        let c = self.rates(&at(&b, 0.5 * h));
        let d = self.rates(&at(&c, h));
        let mean = |i: usize| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0;
        at(&(0..a.len()).map(mean).collect::<Vec<_>>(), h)
    }

    /// The drive at a sample.
    fn exact_drive(&mut self) {
        let n = self.field.len();
        (self.at.v[n], self.at.v[n + 1]) = (1.0, 0.0);
    }

    /// Goes on by `h`, or to the place of the first switch before; tells whether there is one.
    fn step(&mut self, h: f64) -> Result<bool, Doubt> {
        let end = self.ahead(h);
        if end.iter().any(|x| x.is_nan() || x.abs() > LARGE) {
            return Err("large");
        }
        let mut found: Vec<(f64, usize)> = Vec::new();
        for place in 0..self.stands.len() {
            if let Some(time) = self.follow(place, &end, h)? {
                found.push((time, place));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(&(first, _)) = found.first() else {
            self.at.v = end;
            self.time += h;
            return Ok(false);
        };
        let mut gaps = found.iter().map(|&(time, _)| time - first);
        if gaps.any(|gap| gap > AT_ONCE && gap < TOO_CLOSE) {
            return Err("two switches nearly at once");
        }
        self.at.v = self.ahead(first);
        self.time += first;
        let from_sample = self.time.min(self.case.period() - self.time);
        if from_sample <= AT_ONCE {
            self.exact_drive();
        } else if from_sample < TOO_CLOSE {
            return Err("nearly at a sample");
        }
        Ok(true)
    }

    /// Where in a step to `end` a rule fires, if it does.
    fn follow(&mut self, place: usize, end: &[f64], h: f64) -> Result<Option<f64>, Doubt> {
        let (unit, index, rule) = self.case.rules(&self.at.modes)[place];
        let rate = |v: &[f64]| rule.sign * rule.guard.rate(v, &self.rates(v));
        let value = |v: &[f64]| rule.sign * rule.guard.value(v);
        let [g0, g1] = [&self.at.v[..], end].map(value);
        let [d0, d1] = [&self.at.v[..], end].map(rate);
        let size = size(&rule.guard, &self.at.v) + SMALL;
        match self.stands[place] {
            Stand::Armed if g1 <= 0.0 => {
                if d0.min(d1) > -GRAZE * size {
                    return Err("grazing");
                }
                return Ok(Some(self.bisect(h, value)));
            }
            Stand::Armed if d0 < 0.0 && d1 > 0.0 => {
                let lowest = g0 - 0.5 * d0 * d0 * h / (d1 - d0);
                if lowest < GRAZE * size {
                    return Err("grazing");
                }
            }
            Stand::Held if d0 > 0.0 && d1 <= 0.0 && !TURNS => return Err("turns (not compared)"),
            Stand::Held if d0 > 0.0 && d1 <= 0.0 => {
                if g1 > -GRAZE * size {
                    return Err("grazing");
                }
                return Ok(Some(self.bisect(h, rate)));
            }
            Stand::Idle | Stand::Held if g1 > UNCLEAR * size => {
                self.held.retain(|&held| held != (unit, index));
                self.stands[place] = Stand::Armed;
            }
            // It left zero for its right side and came back within a tiny step.
            Stand::Idle if g1 < -UNCLEAR * size => return Err("turns back"),
            _ => {}
        }
        Ok(None)
    }

    /// Time from now to where something that is negative after `h` reaches zero.
    fn bisect(&self, h: f64, value: impl Fn(&[f64]) -> f64) -> f64 {
        let (mut lo, mut hi) = (0.0, h);
        for _ in 0..55 {
            let middle = 0.5 * (lo + hi);
            if value(&self.ahead(middle)) > 0.0 {
                lo = middle;
            } else {
                hi = middle;
            }
        }
        hi
    }

    /// Carries out a rule, by its place among those in force.
    fn fire(&mut self, place: usize) {
        let (unit, _, rule) = self.case.rules(&self.at.modes)[place];
        self.out.switches.push(Switch {
            time: self.total_time(),
            unit,
            from: self.at.modes[unit],
            to: rule.to,
        });
        self.recent += 1;
        self.held.retain(|&(held, _)| held != unit);
        self.case.carry_out((unit, rule), &mut self.at);
        self.field = self.case.field(&self.at.modes);
    }

    /// Carries out what is due at this very instant, one after the other; false if that is too much.
    fn at_once(&mut self) -> Result<bool, Doubt> {
        loop {
            if self.recent > MOST {
                self.out.ending = Ending::Chattering(self.total_time());
                return Ok(false);
            }
            self.stand()?;
            if !TWO_AT_A_SAMPLE && self.two_at_a_sample() {
                return Err("two units at a sample (not compared)");
            }
            let mut due = (0..self.stands.len()).filter(|&i| self.stands[i] == Stand::Due);
            let (first, last) = (due.next(), due.next_back());
            self.out.tie |= last.is_some();
            match if self.last_first {
                last.or(first)
            } else {
                first
            } {
                Some(place) => self.fire(place),
                None => return Ok(true),
            }
        }
    }

    /// Whether different units switch at the instant of a sample.
    fn two_at_a_sample(&self) -> bool {
        let now = self.total_time();
        let latest = self.out.switches.iter().rev();
        let mut units = latest
            .take_while(|s| now - s.time <= AT_ONCE)
            .map(|s| s.unit);
        let first = units.next();
        let from_sample = self.time.min(self.case.period() - self.time);
        from_sample <= AT_ONCE && units.any(|unit| Some(unit) != first)
    }

    /// How each rule in force stands at this point.
    fn stand(&mut self) -> Result<(), Doubt> {
        let rules = self.case.rules(&self.at.modes);
        self.stands.clear();
        for (side, &(unit, index, rule)) in self.case.sides(&self.at)?.into_iter().zip(&rules) {
            let held = self.held.contains(&(unit, index));
            let stand = match (side.sign, side.zeros) {
                (1.0, 0) => Stand::Armed,
                (0.0 | 1.0, _) => Stand::Idle,
                _ if !side.may_be_held() => Stand::Due,
                _ if held => Stand::Held,
                _ if self.case.settles(&self.at, (unit, rule))? => Stand::Due,
                _ => Stand::Held,
            };
            if stand == Stand::Held && !held && !HELD_IN_CHAINS && self.time > 0.0 {
                return Err("held within a chain (not compared)");
            }
            if stand == Stand::Held && !held {
                self.held.push((unit, index));
            }
            if stand == Stand::Armed {
                self.held.retain(|&held| held != (unit, index));
            }
            self.stands.push(stand);
        }
        Ok(())
    }
}

/// Sum of the absolute values of the terms.
fn size(poly: &Poly, v: &[f64]) -> f64 {
    let term = |(c, factors): &(f64, Vec<usize>)| factors.iter().fold(*c, |p, &i| p * v[i]).abs();
    poly.0.iter().map(term).sum()
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
