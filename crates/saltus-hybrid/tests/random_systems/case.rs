//! A small switching system as plain data: what the generator makes, both programs run, and a file keeps.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use saltus_hybrid::{BuildError, Node, Segment, System, SystemBuilder, Transition};

/// A sum of terms, each a coefficient times variables: the states by index, then cos and sin of the drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Poly(pub(crate) Vec<(f64, Vec<usize>)>);

/// A way out of a mode.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rule {
    pub(crate) guard: Poly,
    /// +1 if the mode lasts while the guard is positive, -1 if while it is negative.
    pub(crate) sign: f64,
    pub(crate) to: usize,
    pub(crate) resets: Vec<(usize, Poly)>,
}

/// What a mode adds to the rates of states, and what ends it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Mode {
    pub(crate) adds: Vec<(usize, Poly)>,
    pub(crate) rules: Vec<Rule>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Case {
    /// Angular frequency of the drive.
    pub(crate) omega: f64,
    pub(crate) periods: u64,
    pub(crate) start: Vec<f64>,
    pub(crate) rates: Vec<Poly>,
    /// Mode at the start, and all modes, of each unit.
    pub(crate) units: Vec<(usize, Vec<Mode>)>,
}

impl Poly {
    /// Value where the variables have these values.
    pub(crate) fn value(&self, v: &[f64]) -> f64 {
        let term = |(c, factors): &(f64, Vec<usize>)| factors.iter().fold(*c, |p, &i| p * v[i]);
        self.0.iter().map(term).sum()
    }

    /// Rate where the variables change at the rates `dv`.
    pub(crate) fn rate(&self, v: &[f64], dv: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (c, factors) in &self.0 {
            for at in 0..factors.len() {
                let factor = |(j, &i): (usize, &usize)| if j == at { dv[i] } else { v[i] };
                sum += c * factors.iter().enumerate().map(factor).product::<f64>();
            }
        }
        sum
    }
}

impl Case {
    /// Every polynomial of the case.
    pub(crate) fn polys(&mut self) -> impl Iterator<Item = &mut Poly> {
        let Self { rates, units, .. } = self;
        let modes = units.iter_mut().flat_map(|(_, modes)| modes);
        let of_modes = modes.flat_map(|mode| {
            let adds = mode.adds.iter_mut().map(|(_, add)| add);
            let of_rules = mode.rules.iter_mut().flat_map(|rule| {
                std::iter::once(&mut rule.guard)
                    .chain(rule.resets.iter_mut().map(|(_, value)| value))
            });
            adds.chain(of_rules)
        });
        rates.iter_mut().chain(of_modes)
    }

    pub(crate) fn modes(&self) -> Vec<usize> {
        self.units.iter().map(|&(mode, _)| mode).collect()
    }

    pub(crate) fn period(&self) -> f64 {
        std::f64::consts::TAU / self.omega
    }

    /// The segment that the engine runs.
    pub(crate) fn segment(&self) -> Result<Segment, BuildError> {
        let system = self.system()?;
        let start = system.point(&self.modes(), &self.start);
        Ok(Segment {
            system,
            start,
            periods: self.periods,
        })
    }

    fn system(&self) -> Result<System, BuildError> {
        let n = self.rates.len();
        let mut b = SystemBuilder::new(n);
        let (cos, sin) = b.drive(self.omega);
        let mut vars: Vec<Node> = (0..n).map(|i| b.state(i)).collect();
        vars.extend([cos, sin]);
        let units: Vec<_> = self.units.iter().map(|_| b.reserve_unit()).collect();
        let mut rates = Vec::new();
        for rate in &self.rates {
            rates.push(vec![(1.0, node(&mut b, &vars, rate))]);
        }
        for (&unit, (_, modes)) in units.iter().zip(&self.units) {
            for (at, mode) in modes.iter().enumerate() {
                let mut gate = vec![0.0; modes.len()];
                gate[at] = 1.0;
                for (state, add) in &mode.adds {
                    let add = node(&mut b, &vars, add);
                    rates[*state].push((1.0, b.gate(unit, &gate, add)));
                }
            }
        }
        for (state, rate) in rates.iter().enumerate() {
            let rate = b.linear(0.0, rate);
            b.derivative(state, rate);
        }
        for (&unit, (_, modes)) in units.iter().zip(&self.units) {
            let rules = |mode: &Mode| {
                mode.rules
                    .iter()
                    .map(|rule| transition(&mut b, &vars, rule))
                    .collect()
            };
            let modes = modes.iter().map(rules).collect();
            b.define_unit(unit, modes);
        }
        b.build(0.0)
    }
}

fn transition(b: &mut SystemBuilder, vars: &[Node], rule: &Rule) -> Transition {
    let guard = node(b, vars, &rule.guard);
    let mut out = if rule.sign > 0.0 {
        Transition::falling(guard, rule.to)
    } else {
        Transition::rising(guard, rule.to)
    };
    for (state, value) in &rule.resets {
        out = out.reset(*state, node(b, vars, value));
    }
    out
}

fn node(b: &mut SystemBuilder, vars: &[Node], poly: &Poly) -> Node {
    let (mut constant, mut terms) = (0.0, Vec::new());
    for (c, factors) in &poly.0 {
        match &factors[..] {
            [] => constant += c,
            [first, rest @ ..] => {
                let product = |node, &i: &usize| b.products(&[(node, vars[i])])[0];
                terms.push((*c, rest.iter().fold(vars[*first], product)));
            }
        }
    }
    b.linear(constant, &terms)
}

/// One statement a line: `state 0.5 = -1 x0 + 0.3 c` (start and rate of the next state), `unit 0` (with its
/// mode at the start), `mode`, `add 1 = 0.2`, `leave 1 rising 1 x0 + -0.5` (to mode 1), `set 0 = -0.8 x0`.
impl Display for Case {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "omega {}\nperiods {}", self.omega, self.periods)?;
        for (start, rate) in self.start.iter().zip(&self.rates) {
            writeln!(f, "state {start} = {}", Words(rate, self.start.len()))?;
        }
        for (start, modes) in &self.units {
            writeln!(f, "unit {start}")?;
            for mode in modes {
                writeln!(f, "mode")?;
                for (state, add) in &mode.adds {
                    writeln!(f, "add {state} = {}", Words(add, self.start.len()))?;
                }
                for rule in &mode.rules {
                    let way = if rule.sign > 0.0 { "falling" } else { "rising" };
                    let guard = Words(&rule.guard, self.start.len());
                    writeln!(f, "leave {} {way} {guard}", rule.to)?;
                    for (state, value) in &rule.resets {
                        writeln!(f, "set {state} = {}", Words(value, self.start.len()))?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// A polynomial of so many states, to be written.
struct Words<'a>(&'a Poly, usize);

impl Display for Words<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (at, (c, factors)) in self.0.0.iter().enumerate() {
            write!(f, "{}{c}", if at > 0 { " + " } else { "" })?;
            for &i in factors {
                match i.checked_sub(self.1) {
                    None => write!(f, " x{i}")?,
                    Some(0) => write!(f, " c")?,
                    Some(_) => write!(f, " s")?,
                }
            }
        }
        Ok(())
    }
}

impl FromStr for Case {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let states = text
            .lines()
            .filter(|line| line.starts_with("state "))
            .count();
        let mut case = Self::default();
        for line in text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty())
        {
            case.statement(line, states)
                .ok_or_else(|| format!("not a statement: {line}"))?;
        }
        Ok(case)
    }
}

impl Case {
    fn statement(&mut self, line: &str, states: usize) -> Option<()> {
        let (verb, rest) = line.split_once(' ').unwrap_or((line, ""));
        let assignment = || {
            let (to, value) = rest.split_once(" =")?;
            Some((to, poly(value, states)?))
        };
        let modes = self.units.last_mut().map(|unit| &mut unit.1);
        match verb {
            "omega" => self.omega = rest.parse().ok()?,
            "periods" => self.periods = rest.parse().ok()?,
            "state" => {
                let (start, rate) = assignment()?;
                self.start.push(start.parse().ok()?);
                self.rates.push(rate);
            }
            "unit" => self.units.push((rest.parse().ok()?, Vec::new())),
            "mode" => modes?.push(Mode::default()),
            "add" => {
                let (to, value) = assignment()?;
                modes?.last_mut()?.adds.push((to.parse().ok()?, value));
            }
            "leave" => {
                let mut words = rest.splitn(3, ' ');
                let to = words.next()?.parse().ok()?;
                let sign = if words.next()? == "falling" {
                    1.0
                } else {
                    -1.0
                };
                let guard = poly(words.next()?, states)?;
                let rule = Rule {
                    guard,
                    sign,
                    to,
                    resets: Vec::new(),
                };
                modes?.last_mut()?.rules.push(rule);
            }
            "set" => {
                let (to, value) = assignment()?;
                let rule = modes?.last_mut()?.rules.last_mut()?;
                rule.resets.push((to.parse().ok()?, value));
            }
            _ => return None,
        }
        Some(())
    }
}

fn poly(text: &str, states: usize) -> Option<Poly> {
    let variable = |word: &str| match word {
        "c" => Some(states),
        "s" => Some(states + 1),
        _ => word.strip_prefix('x')?.parse().ok(),
    };
    let term = |text: &str| {
        let mut words = text.split_whitespace();
        let c = words.next()?.parse().ok()?;
        Some((c, words.map(variable).collect::<Option<_>>()?))
    };
    let terms = text.split(" + ").filter(|t| !t.trim().is_empty());
    Some(Poly(terms.map(term).collect::<Option<_>>()?))
}
