//! A program whose numbers are formulas of the parameters: from it come the systems of all members.

use saltus_hybrid::{BuildError, Node, System, SystemBuilder, Transition, Unit};

use super::coefficients::{Coefficient, Coefficients, Values};

/// A quantity of the program: a state (the forcing's cosine and sine come after the user's) or a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Value {
    State(usize),
    Made(usize),
}

/// A sum of quantities.
pub(crate) type Terms = Vec<(Coefficient, Value)>;

/// Operations of the engine; `out` is the place of the result.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    Linear {
        out: usize,
        constant: Option<Coefficient>,
        terms: Terms,
    },
    Gate {
        out: usize,
        unit: usize,
        by_mode: Vec<Coefficient>,
        terms: Terms,
    },
    Squares(Vec<(usize, Value)>),
    Products(Vec<(usize, Value, Value)>),
    Quotient {
        out: usize,
        dividend: Value,
        divisor: Value,
    },
    Power {
        out: usize,
        base: Value,
        exponent: Coefficient,
    },
    Function {
        out: usize,
        function: Function,
        of: Value,
    },
}

/// Elementary functions of the engine. Of a pair the second result is the place after the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Function {
    Exp,
    Log,
    SinCos,
    Tan,
    SinhCosh,
    Tanh,
    Arcsin,
    Arctan,
}

impl Function {
    /// Whether it has two results.
    pub(crate) fn is_pair(self) -> bool {
        matches!(self, Self::SinCos | Self::SinhCosh)
    }

    fn build(self, b: &mut SystemBuilder, u: Node) -> Vec<Node> {
        match self {
            Self::Exp => vec![b.exp(u)],
            Self::Log => vec![b.log(u)],
            Self::SinCos => <[Node; 2]>::from(b.sin_cos(u)).into(),
            Self::Tan => vec![b.tan(u)],
            Self::SinhCosh => <[Node; 2]>::from(b.sinh_cosh(u)).into(),
            Self::Tanh => vec![b.tanh(u)],
            Self::Arcsin => vec![b.asin(u)],
            Self::Arctan => vec![b.atan(u)],
        }
    }
}

/// A transition out of a mode: as [`Transition`], of quantities or of places that stand for them.
#[derive(Clone, Debug)]
pub(crate) struct Leave<V = Value> {
    pub(crate) guard: V,
    pub(crate) sign: f64,
    pub(crate) to: usize,
    pub(crate) resets: Vec<(usize, V)>,
    pub(crate) vanishing: Vec<(V, u8)>,
}

/// Clock of the samples.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Clock<C = Coefficient> {
    /// Once in each period of the forcing, at this angular frequency.
    Forcing(C),
    /// At this interval.
    Interval(C),
}

#[derive(Clone, Debug)]
pub(crate) struct Blueprint {
    pub(crate) coefficients: Coefficients,
    pub(crate) clock: Clock,
    pub(crate) steps: Vec<Step>,
    /// Number of quantities that the steps make.
    pub(crate) made: usize,
    /// The rate of each state.
    pub(crate) rates: Vec<Value>,
    /// The scale of each state, where one is given.
    pub(crate) scales: Vec<Option<Coefficient>>,
    /// Transitions out of each mode of each unit.
    pub(crate) units: Vec<Vec<Vec<Leave>>>,
    /// Units that follow the sign of the guard of their first mode.
    pub(crate) signs: Vec<usize>,
}

/// Reasons why there is no system at some parameters.
#[derive(Clone, Debug, thiserror::Error)]
pub(crate) enum Unbuildable {
    #[error("{what} is {value} at the parameters {parameters:?}: a {right} number is needed")]
    Number {
        what: &'static str,
        value: f64,
        parameters: Vec<f64>,
        right: &'static str,
    },
    #[error(transparent)]
    Build(#[from] BuildError),
}

impl Blueprint {
    pub(crate) fn states(&self) -> usize {
        self.rates.len()
    }

    /// The system at these values of the parameters.
    pub(crate) fn system(&self, parameters: &[f64]) -> Result<System, Unbuildable> {
        let values = self.checked(parameters)?;
        let mut b = SystemBuilder::new(self.states());
        let mut nodes = Nodes(vec![Node::State(0); self.made]);
        let period = match self.clock {
            Clock::Forcing(omega) => {
                b.drive(values.of(omega));
                0.0
            }
            Clock::Interval(interval) => values.of(interval),
        };
        let units: Vec<Unit> = self.units.iter().map(|_| b.reserve_unit()).collect();
        for step in &self.steps {
            nodes.take(step, &values, &units, &mut b);
        }
        for (state, &rate) in self.rates.iter().enumerate() {
            b.derivative(state, nodes.of(rate));
        }
        for (state, scale) in self.scales.iter().enumerate() {
            if let Some(scale) = scale {
                b.scale(state, values.of(*scale));
            }
        }
        for (number, (unit, modes)) in units.into_iter().zip(&self.units).enumerate() {
            if self.signs.contains(&number)
                && let Some(leave) = modes.iter().flatten().next()
            {
                b.follow_sign(unit, nodes.of(leave.guard));
                continue;
            }
            let leave = |leave: &Leave| nodes.transition(leave);
            let modes = modes.iter().map(|all| all.iter().map(leave).collect());
            b.define_unit(unit, modes.collect());
        }
        Ok(b.build(period)?)
    }

    /// Whether all numbers are what the engine needs at these parameters.
    pub(crate) fn check(&self, parameters: &[f64]) -> Result<(), Unbuildable> {
        self.checked(parameters).map(drop)
    }

    fn checked(&self, parameters: &[f64]) -> Result<Values, Unbuildable> {
        let values = self.coefficients.values(parameters);
        let refuse = |what, value, right| {
            Err(Unbuildable::Number {
                what,
                value,
                parameters: parameters.to_vec(),
                right,
            })
        };
        let positive = |x: f64| x > 0.0 && x.is_finite();
        match self.clock {
            Clock::Forcing(c) if !positive(values.of(c)) => {
                refuse("the forcing frequency", values.of(c), "positive")
            }
            Clock::Interval(c) if !positive(values.of(c)) => {
                refuse("the interval", values.of(c), "positive")
            }
            _ => {
                let mut scales = self.scales.iter().flatten().map(|&c| values.of(c));
                if let Some(value) = scales.find(|&x| !positive(x)) {
                    return refuse("the scale of a state", value, "positive");
                }
                match self.used().map(|c| values.of(c)).find(|x| !x.is_finite()) {
                    Some(value) => refuse("a coefficient", value, "finite"),
                    None => Ok(values),
                }
            }
        }
    }

    /// The numbers that enter the engine.
    fn used(&self) -> impl Iterator<Item = Coefficient> {
        self.steps.iter().flat_map(|step| -> Vec<Coefficient> {
            let of = |terms: &Terms| terms.iter().map(|&(c, _)| c).collect::<Vec<_>>();
            match step {
                Step::Linear {
                    constant, terms, ..
                } => of(terms).into_iter().chain(*constant).collect(),
                Step::Gate { by_mode, terms, .. } => [of(terms), by_mode.clone()].concat(),
                Step::Power { exponent, .. } => vec![*exponent],
                Step::Squares(_)
                | Step::Products(_)
                | Step::Quotient { .. }
                | Step::Function { .. } => Vec::new(),
            }
        })
    }
}

/// The engine's nodes of the quantities made so far.
struct Nodes(Vec<Node>);

impl Nodes {
    fn of(&self, value: Value) -> Node {
        match value {
            Value::State(i) => Node::State(i),
            Value::Made(i) => self.0[i],
        }
    }

    fn take(&mut self, step: &Step, values: &Values, units: &[Unit], b: &mut SystemBuilder) {
        let sum = |nodes: &Self, terms: &Terms| -> Vec<(f64, Node)> {
            let term = |&(c, value): &(Coefficient, Value)| (values.of(c), nodes.of(value));
            terms.iter().map(term).collect()
        };
        match step {
            Step::Linear {
                out,
                constant,
                terms,
            } => {
                let constant = constant.map_or(0.0, |c| values.of(c));
                self.0[*out] = b.linear(constant, &sum(self, terms));
            }
            Step::Gate {
                out,
                unit,
                by_mode,
                terms,
            } => {
                let by_mode: Vec<f64> = by_mode.iter().map(|&c| values.of(c)).collect();
                self.0[*out] = b.gated_linear(units[*unit], &by_mode, &sum(self, terms));
            }
            Step::Quotient {
                out,
                dividend,
                divisor,
            } => self.0[*out] = b.quotient(self.of(*dividend), self.of(*divisor)),
            Step::Power {
                out,
                base,
                exponent,
            } => self.0[*out] = b.power(self.of(*base), values.of(*exponent)),
            Step::Function { out, function, of } => {
                self.put(*out.., function.build(b, self.of(*of)));
            }
            Step::Squares(list) => {
                let of: Vec<Node> = list.iter().map(|&(_, value)| self.of(value)).collect();
                self.put(list.iter().map(|&(out, _)| out), b.squares(&of));
            }
            Step::Products(list) => {
                let pair = |&(_, a, b): &(usize, Value, Value)| (self.of(a), self.of(b));
                let pairs: Vec<_> = list.iter().map(pair).collect();
                self.put(list.iter().map(|&(out, ..)| out), b.products(&pairs));
            }
        }
    }

    fn put(&mut self, outs: impl Iterator<Item = usize>, made: Vec<Node>) {
        outs.zip(made).for_each(|(out, node)| self.0[out] = node);
    }

    fn transition(&self, leave: &Leave) -> Transition {
        Transition {
            guard: self.of(leave.guard),
            sign: leave.sign,
            to: leave.to,
            resets: leave
                .resets
                .iter()
                .map(|&(state, value)| (state, self.of(value)))
                .collect(),
            vanishing: leave
                .vanishing
                .iter()
                .map(|&(guard, multiplicity)| (self.of(guard), multiplicity))
                .collect(),
        }
    }
}
