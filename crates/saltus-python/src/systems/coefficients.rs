//! Numbers of a program as formulas of the parameters, each computed once for each member.

use std::collections::HashMap;

use super::formula::{Binary, Unary};

/// A number of the program, by its place in [`Coefficients`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Coefficient(usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Rule {
    /// The bits of a number.
    Number(u64),
    Parameter(usize),
    Unary(Unary, Coefficient),
    Binary(Binary, Coefficient, Coefficient),
}

/// All numbers of a program. Equal formulas are kept once, and a formula without parameters is a number at once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Coefficients {
    rules: Vec<Rule>,
    known: HashMap<Rule, Coefficient>,
}

impl Coefficients {
    fn place(&mut self, rule: Rule) -> Coefficient {
        let rules = &mut self.rules;
        *self.known.entry(rule).or_insert_with(|| {
            rules.push(rule);
            Coefficient(rules.len() - 1)
        })
    }

    pub(crate) fn number(&mut self, value: f64) -> Coefficient {
        self.place(Rule::Number(value.to_bits()))
    }

    pub(crate) fn parameter(&mut self, index: usize) -> Coefficient {
        self.place(Rule::Parameter(index))
    }

    /// Its value if it holds no parameter.
    pub(crate) fn literal(&self, c: Coefficient) -> Option<f64> {
        match self.rules[c.0] {
            Rule::Number(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    pub(crate) fn unary(&mut self, op: Unary, a: Coefficient) -> Coefficient {
        match self.literal(a) {
            Some(a) => self.number(op.of(a)),
            None => self.place(Rule::Unary(op, a)),
        }
    }

    pub(crate) fn binary(&mut self, op: Binary, a: Coefficient, b: Coefficient) -> Coefficient {
        match (op, self.literal(a), self.literal(b)) {
            (_, Some(a), Some(b)) => self.number(op.of(a, b)),
            (Binary::Multiply, Some(1.0), _) => b,
            (Binary::Multiply | Binary::Divide, _, Some(1.0)) => a,
            (Binary::Multiply, Some(-1.0), _) => self.unary(Unary::Negative, b),
            (Binary::Multiply, _, Some(-1.0)) => self.unary(Unary::Negative, a),
            _ => self.place(Rule::Binary(op, a, b)),
        }
    }

    /// The value of each number.
    pub(crate) fn values(&self, parameters: &[f64]) -> Values {
        let mut values = Vec::with_capacity(self.rules.len());
        for rule in &self.rules {
            values.push(match *rule {
                Rule::Number(bits) => f64::from_bits(bits),
                Rule::Parameter(index) => parameters[index],
                Rule::Unary(op, a) => op.of(values[a.0]),
                Rule::Binary(op, a, b) => op.of(values[a.0], values[b.0]),
            });
        }
        Values(values)
    }
}

/// The numbers of one member.
pub(crate) struct Values(Vec<f64>);

impl Values {
    pub(crate) fn of(&self, c: Coefficient) -> f64 {
        self.0[c.0]
    }
}
