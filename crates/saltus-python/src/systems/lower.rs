//! From formulas to a program: sums are gathered, products become quantities of their own, each made once.
//!
//! A formula is a sum of coefficients times quantities. It stays one until something needs it as a single
//! quantity: a product, a rate, a guard, a reset, or a second use. Terms keep the order in which they were
//! written, so a system gives the same bits as when it is written with the engine's own builder.

use std::collections::HashMap;

use super::blueprint::{Blueprint, Clock, Function, Leave, Step, Terms, Value};
use super::coefficients::{Coefficient, Coefficients};
use super::formula::{Binary, Op, Unary};
use super::input::{Astray, Definition};

/// An operation in the form that later operations build on.
#[derive(Clone, Debug)]
enum Form {
    /// A sum; without terms, a number.
    Sum {
        constant: Option<Coefficient>,
        terms: Terms,
    },
    /// A number for each mode of a unit.
    Switched {
        unit: usize,
        by_mode: Vec<Coefficient>,
    },
}

/// An operation of the program, by which equal ones are recognised.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Made {
    Linear(Option<Coefficient>, Terms),
    Gate(usize, Vec<Coefficient>, Terms),
    Product(Value, Value),
    Quotient(Value, Value),
    Power(Value, Coefficient),
    Function(Function, Value),
    /// The second result of the pair before it.
    Second(Function, Value),
}

/// Reasons why formulas are no program.
#[derive(Clone, Debug, thiserror::Error)]
pub(crate) enum NoProgram {
    #[error(
        "the absolute value of something that changes with time switches: a unit has to stand for it"
    )]
    Switches,
    #[error("the exponent of a power must not change with time")]
    Exponent,
    #[error("{0} must not change with time")]
    Moving(&'static str),
    #[error(transparent)]
    Astray(#[from] Astray),
}

/// The program of a definition.
pub(crate) fn lower(definition: &Definition) -> Result<Blueprint, NoProgram> {
    definition.check()?;
    let states = definition.rates.len();
    let mut lowering = Lowering {
        states,
        uses: definition.uses(),
        coefficients: Coefficients::default(),
        forms: Vec::with_capacity(definition.ops.len()),
        made: Vec::new(),
        levels: Vec::new(),
        known: HashMap::new(),
    };
    for op in &definition.ops {
        lowering.take(op)?;
    }
    let clock = match definition.clock {
        Clock::Forcing(omega) => Clock::Forcing(lowering.fixed(omega, "the forcing frequency")?),
        Clock::Interval(time) => Clock::Interval(lowering.fixed(time, "the interval")?),
    };
    let mut scale = |at: &Option<usize>| {
        at.map(|at| lowering.fixed(at, "the scale of a state"))
            .transpose()
    };
    let scales: Result<_, NoProgram> = definition.scales.iter().map(&mut scale).collect();
    let scales = scales?;
    let rates = definition
        .rates
        .iter()
        .map(|&rate| lowering.value(rate))
        .collect();
    let mut units = Vec::new();
    for modes in &definition.units {
        let leaves = |all: &Vec<Leave<usize>>| all.iter().map(|l| lowering.leave(l)).collect();
        units.push(modes.iter().map(leaves).collect());
    }
    Ok(Blueprint {
        clock,
        steps: lowering.steps(),
        made: lowering.made.len(),
        coefficients: lowering.coefficients,
        rates,
        scales,
        units,
        signs: definition.signs.clone(),
    })
}

struct Lowering {
    states: usize,
    /// Number of times that each operation is read.
    uses: Vec<usize>,
    coefficients: Coefficients,
    forms: Vec<Form>,
    made: Vec<Made>,
    /// Number of products between each quantity and the states.
    levels: Vec<usize>,
    known: HashMap<Made, Value>,
}

impl Lowering {
    fn take(&mut self, op: &Op) -> Result<(), NoProgram> {
        let form = match op {
            Op::Number(value) => number(self.coefficients.number(*value)),
            Op::Parameter(index) => number(self.coefficients.parameter(*index)),
            Op::State(index) => self.quantity(Value::State(*index)),
            Op::Cos => self.quantity(Value::State(self.states)),
            Op::Sin => self.quantity(Value::State(self.states + 1)),
            Op::Unary(op, a) => self.unary(*op, *a)?,
            Op::Binary(op, a, b) => self.binary(*op, *a, *b)?,
            Op::Choice { unit, by_mode } => self.choice(*unit, by_mode),
        };
        let shared = self.uses[self.forms.len()] > 1;
        let form = match form {
            Form::Sum { constant, terms } if shared && is_long(constant, &terms) => {
                let value = self.linear(constant, terms);
                self.quantity(value)
            }
            other => other,
        };
        self.forms.push(form);
        Ok(())
    }

    /// The form of an operation, taken away if this is its only use.
    fn form(&mut self, at: usize) -> Form {
        if self.uses[at] > 1 {
            return self.forms[at].clone();
        }
        std::mem::replace(&mut self.forms[at], empty())
    }

    fn quantity(&mut self, value: Value) -> Form {
        let one = self.coefficients.number(1.0);
        Form::Sum {
            constant: None,
            terms: vec![(one, value)],
        }
    }

    fn unary(&mut self, op: Unary, a: usize) -> Result<Form, NoProgram> {
        let form = self.form(a);
        if let Some((unit, by_mode)) = self.numbers(&form) {
            let all = by_mode.into_iter();
            return Ok(switched(
                unit,
                all.map(|c| self.coefficients.unary(op, c)).collect(),
            ));
        }
        match op {
            Unary::Negative => {
                let minus = self.coefficients.number(-1.0);
                Ok(self.scaled(form, Binary::Multiply, minus))
            }
            Unary::Absolute => Err(NoProgram::Switches),
            _ => {
                let of = self.whole(form);
                let value = self.function(op, of);
                Ok(self.quantity(value))
            }
        }
    }

    /// A function of a quantity.
    fn function(&mut self, op: Unary, of: Value) -> Value {
        let (function, second) = match op {
            Unary::Sqrt => {
                let half = self.coefficients.number(0.5);
                return self.make(Made::Power(of, half));
            }
            Unary::Log => (Function::Log, false),
            Unary::Sin => (Function::SinCos, false),
            Unary::Cos => (Function::SinCos, true),
            Unary::Tan => (Function::Tan, false),
            Unary::Sinh => (Function::SinhCosh, false),
            Unary::Cosh => (Function::SinhCosh, true),
            Unary::Tanh => (Function::Tanh, false),
            Unary::Arcsin => (Function::Arcsin, false),
            Unary::Arctan => (Function::Arctan, false),
            Unary::Exp | Unary::Negative | Unary::Absolute => (Function::Exp, false),
        };
        let first = self.make(Made::Function(function, of));
        if !function.is_pair() {
            return first;
        }
        let other = self.make(Made::Second(function, of));
        if second { other } else { first }
    }

    fn binary(&mut self, op: Binary, a: usize, b: usize) -> Result<Form, NoProgram> {
        let (first, second) = (self.form(a), self.form(b));
        if let Some(form) = self.elementwise(op, &first, &second) {
            return Ok(form);
        }
        match op {
            Binary::Add => Ok(self.plus(first, second)),
            Binary::Subtract => {
                let minus = self.coefficients.number(-1.0);
                let second = self.scaled(second, Binary::Multiply, minus);
                Ok(self.plus(first, second))
            }
            Binary::Multiply => Ok(self.times(first, second)),
            Binary::Divide => match as_number(&second) {
                Some(c) => Ok(self.scaled(first, Binary::Divide, c)),
                None => Ok(self.divided(first, second)),
            },
            Binary::Power => self.power(first, &second),
        }
    }

    /// An operation on numbers, for each mode if one of them depends on that.
    fn elementwise(&mut self, op: Binary, a: &Form, b: &Form) -> Option<Form> {
        let ((first, mut left), (second, mut right)) = (self.numbers(a)?, self.numbers(b)?);
        if first.is_some() && second.is_some() && first != second {
            return None;
        }
        let modes = left.len().max(right.len());
        for side in [&mut left, &mut right] {
            let last = side[side.len() - 1];
            side.resize(modes, last);
        }
        let pairs = left.into_iter().zip(right);
        let all = pairs.map(|(a, b)| self.coefficients.binary(op, a, b));
        Some(switched(first.or(second), all.collect()))
    }

    /// The numbers of a form without states: one, or one for each mode of a unit.
    fn numbers(&self, form: &Form) -> Option<(Option<usize>, Vec<Coefficient>)> {
        match form {
            Form::Sum { .. } => as_number(form).map(|c| (None, vec![c])),
            Form::Switched { unit, by_mode } => Some((Some(*unit), by_mode.clone())),
        }
    }

    fn plus(&mut self, a: Form, b: Form) -> Form {
        let ((first, mut terms), (second, more)) = (self.sum(a), self.sum(b));
        let constant = match (first, second) {
            (Some(a), Some(b)) => Some(self.coefficients.binary(Binary::Add, a, b)),
            (one, other) => one.or(other),
        };
        terms.extend(more);
        let zero = |c: &Coefficient| self.coefficients.literal(*c) == Some(0.0);
        let constant = constant.filter(|c| terms.is_empty() || !zero(c));
        Form::Sum { constant, terms }
    }

    fn times(&mut self, a: Form, b: Form) -> Form {
        match (as_number(&a), as_number(&b)) {
            (Some(c), _) => return self.scaled(b, Binary::Multiply, c),
            (_, Some(c)) => return self.scaled(a, Binary::Multiply, c),
            _ => {}
        }
        match (a, b) {
            (Form::Switched { unit, by_mode }, other)
            | (other, Form::Switched { unit, by_mode }) => {
                let (constant, mut terms) = self.sum(other);
                if let Some(c) = constant {
                    terms.push((c, self.one()));
                }
                let value = self.make(Made::Gate(unit, by_mode, terms));
                self.quantity(value)
            }
            (a, b) => {
                let ((c, a), (d, b)) = (self.factor(a), self.factor(b));
                let value = self.product(a, b);
                let coefficient = self.coefficients.binary(Binary::Multiply, c, d);
                let form = self.quantity(value);
                self.scaled(form, Binary::Multiply, coefficient)
            }
        }
    }

    /// A sum divided by a number for each mode, that is times its reciprocal, or by a quantity.
    fn divided(&mut self, a: Form, by: Form) -> Form {
        let one = self.coefficients.number(1.0);
        if let Some(inverse) = self.elementwise(Binary::Divide, &number(one), &by) {
            return self.times(a, inverse);
        }
        let ((c, a), (d, b)) = (self.factor(a), self.factor(by));
        let value = self.make(Made::Quotient(a, b));
        let coefficient = self.coefficients.binary(Binary::Divide, c, d);
        let form = self.quantity(value);
        self.scaled(form, Binary::Multiply, coefficient)
    }

    fn power(&mut self, base: Form, exponent: &Form) -> Result<Form, NoProgram> {
        let by = as_number(exponent).ok_or(NoProgram::Exponent)?;
        let literal = self.coefficients.literal(by);
        let whole = literal.filter(|n| n.fract() == 0.0 && n.abs() <= 64.0);
        let Some(whole) = whole else {
            let base = self.whole(base);
            let value = self.make(Made::Power(base, by));
            return Ok(self.quantity(value));
        };
        let one = self.coefficients.number(1.0);
        let n = whole.abs() as u32;
        if n == 0 {
            return Ok(number(one));
        }
        if whole < 0.0 {
            let positive = number(self.coefficients.number(-whole));
            let raised = self.power(base, &positive)?;
            return Ok(self.divided(number(one), raised));
        }
        let (c, value) = self.factor(base);
        let exponent = self.coefficients.number(f64::from(n));
        let coefficient = self.coefficients.binary(Binary::Power, c, exponent);
        let value = self.raised(value, n);
        let form = self.quantity(value);
        Ok(self.scaled(form, Binary::Multiply, coefficient))
    }

    /// value^n, n >= 1, by squares.
    fn raised(&mut self, value: Value, n: u32) -> Value {
        match n {
            1 => value,
            n if n.is_multiple_of(2) => {
                let half = self.raised(value, n / 2);
                self.product(half, half)
            }
            n => {
                let even = self.raised(value, n - 1);
                self.product(even, value)
            }
        }
    }

    fn choice(&mut self, unit: usize, by_mode: &[usize]) -> Form {
        let forms: Vec<Form> = by_mode.iter().map(|&at| self.form(at)).collect();
        let zero = self.coefficients.number(0.0);
        let one = self.coefficients.number(1.0);
        let numbers: Vec<Coefficient> = forms
            .iter()
            .map(|form| as_number(form).unwrap_or(zero))
            .collect();
        let only_numbers = forms.iter().all(|form| as_number(form).is_some());
        let mut out = Form::Switched {
            unit,
            by_mode: numbers.clone(),
        };
        if only_numbers {
            return out;
        }
        if numbers.iter().all(|&c| c == zero) {
            out = number(zero);
        }
        for (mode, form) in forms.into_iter().enumerate() {
            if as_number(&form).is_none() {
                let mut only_here = vec![zero; by_mode.len()];
                only_here[mode] = one;
                let gate = Form::Switched {
                    unit,
                    by_mode: only_here,
                };
                let gated = self.times(gate, form);
                out = self.plus(out, gated);
            }
        }
        out
    }

    /// A form times, or divided by, a number.
    fn scaled(&mut self, form: Form, op: Binary, by: Coefficient) -> Form {
        if op == Binary::Multiply && self.coefficients.literal(by) == Some(0.0) {
            return number(by);
        }
        let mut scale = |c: Coefficient| self.coefficients.binary(op, c, by);
        match form {
            Form::Sum { constant, terms } => Form::Sum {
                constant: constant.map(&mut scale),
                terms: terms
                    .into_iter()
                    .map(|(c, value)| (scale(c), value))
                    .collect(),
            },
            Form::Switched { unit, by_mode } => Form::Switched {
                unit,
                by_mode: by_mode.into_iter().map(scale).collect(),
            },
        }
    }

    /// A form as a sum.
    fn sum(&mut self, form: Form) -> (Option<Coefficient>, Terms) {
        match form {
            Form::Sum { constant, terms } => (constant, terms),
            Form::Switched { unit, by_mode } => {
                let (one, value) = (self.coefficients.number(1.0), self.one());
                let value = self.make(Made::Gate(unit, by_mode, vec![(one, value)]));
                (None, vec![(one, value)])
            }
        }
    }

    /// A form as a number times a quantity.
    fn factor(&mut self, form: Form) -> (Coefficient, Value) {
        match self.sum(form) {
            (None, terms) if terms.len() == 1 => terms[0],
            (constant, terms) => {
                let one = self.coefficients.number(1.0);
                (one, self.linear(constant, terms))
            }
        }
    }

    /// An operation as a quantity.
    fn value(&mut self, at: usize) -> Value {
        let form = self.form(at);
        self.whole(form)
    }

    /// A form as a quantity.
    fn whole(&mut self, form: Form) -> Value {
        let (constant, terms) = self.sum(form);
        match (constant, terms.as_slice()) {
            (None, &[(c, value)]) if self.coefficients.literal(c) == Some(1.0) => value,
            _ => self.linear(constant, terms),
        }
    }

    /// An operation as a number.
    fn fixed(&mut self, at: usize, what: &'static str) -> Result<Coefficient, NoProgram> {
        let form = self.form(at);
        as_number(&form).ok_or(NoProgram::Moving(what))
    }

    fn leave(&mut self, leave: &Leave<usize>) -> Leave<Value> {
        Leave {
            guard: self.value(leave.guard),
            sign: leave.sign,
            to: leave.to,
            resets: leave
                .resets
                .iter()
                .map(|&(state, at)| (state, self.value(at)))
                .collect(),
            vanishing: leave
                .vanishing
                .iter()
                .map(|&(guard, multiplicity)| (self.value(guard), multiplicity))
                .collect(),
        }
    }

    /// The number one as a quantity.
    fn one(&mut self) -> Value {
        let one = self.coefficients.number(1.0);
        self.make(Made::Linear(Some(one), Vec::new()))
    }

    fn product(&mut self, a: Value, b: Value) -> Value {
        match self.known.get(&Made::Product(b, a)) {
            Some(&known) => known,
            None => self.make(Made::Product(a, b)),
        }
    }

    /// A sum as a quantity, each quantity in it once, in the order of their first appearance.
    fn linear(&mut self, constant: Option<Coefficient>, terms: Terms) -> Value {
        let mut merged: Terms = Vec::with_capacity(terms.len());
        let mut place: HashMap<Value, usize> = HashMap::with_capacity(terms.len());
        for (c, value) in terms {
            match place.get(&value) {
                Some(&at) => merged[at].0 = self.coefficients.binary(Binary::Add, merged[at].0, c),
                None => {
                    place.insert(value, merged.len());
                    merged.push((c, value));
                }
            }
        }
        merged.retain(|&(c, _)| self.coefficients.literal(c) != Some(0.0));
        self.make(Made::Linear(constant, merged))
    }

    fn make(&mut self, made: Made) -> Value {
        if let Some(&known) = self.known.get(&made) {
            return known;
        }
        let level = |value: &Value| match value {
            Value::State(_) => 0,
            Value::Made(i) => self.levels[*i],
        };
        let highest = |terms: &Terms| terms.iter().map(|(_, v)| level(v)).max().unwrap_or(0);
        self.levels.push(match &made {
            Made::Linear(_, terms) | Made::Gate(_, _, terms) => highest(terms),
            Made::Product(a, b) | Made::Quotient(a, b) => 1 + level(a).max(level(b)),
            Made::Power(of, _) | Made::Function(_, of) | Made::Second(_, of) => 1 + level(of),
        });
        let value = Value::Made(self.made.len());
        self.known.insert(made.clone(), value);
        self.made.push(made);
        value
    }

    /// The operations level by level, products side by side: many at once are faster.
    fn steps(&self) -> Vec<Step> {
        let mut steps = Vec::new();
        for level in 0..=self.levels.iter().copied().max().unwrap_or(0) {
            let (mut squares, mut products) = (Vec::new(), Vec::new());
            let (mut functions, mut sums) = (Vec::new(), Vec::new());
            let here = (0..self.made.len()).filter(|&i| self.levels[i] == level);
            for out in here {
                match &self.made[out] {
                    Made::Product(a, b) if a == b => squares.push((out, *a)),
                    Made::Product(a, b) => products.push((out, *a, *b)),
                    Made::Quotient(dividend, divisor) => functions.push(Step::Quotient {
                        out,
                        dividend: *dividend,
                        divisor: *divisor,
                    }),
                    Made::Power(base, exponent) => functions.push(Step::Power {
                        out,
                        base: *base,
                        exponent: *exponent,
                    }),
                    Made::Function(function, of) => functions.push(Step::Function {
                        out,
                        function: *function,
                        of: *of,
                    }),
                    Made::Second(..) => {}
                    Made::Linear(constant, terms) => sums.push(Step::Linear {
                        out,
                        constant: *constant,
                        terms: terms.clone(),
                    }),
                    Made::Gate(unit, by_mode, terms) => sums.push(Step::Gate {
                        out,
                        unit: *unit,
                        by_mode: by_mode.clone(),
                        terms: terms.clone(),
                    }),
                }
            }
            if !squares.is_empty() {
                steps.push(Step::Squares(squares));
            }
            if !products.is_empty() {
                steps.push(Step::Products(products));
            }
            steps.append(&mut functions);
            steps.append(&mut sums);
        }
        steps
    }
}

/// Placeholder of a form that has been taken away.
fn empty() -> Form {
    Form::Sum {
        constant: None,
        terms: Vec::new(),
    }
}

fn number(c: Coefficient) -> Form {
    Form::Sum {
        constant: Some(c),
        terms: Vec::new(),
    }
}

fn switched(unit: Option<usize>, by_mode: Vec<Coefficient>) -> Form {
    match unit {
        Some(unit) => Form::Switched { unit, by_mode },
        None => number(by_mode[0]),
    }
}

fn as_number(form: &Form) -> Option<Coefficient> {
    match form {
        Form::Sum {
            constant: Some(c),
            terms,
        } if terms.is_empty() => Some(*c),
        _ => None,
    }
}

fn is_long(constant: Option<Coefficient>, terms: &Terms) -> bool {
    terms.len() + usize::from(constant.is_some()) > 1 && !terms.is_empty()
}
