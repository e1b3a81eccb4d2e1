//! Formulas as Python hands them over: a list of operations, each on earlier ones.

use pyo3::prelude::*;

/// An operation; a `usize` is the place of an earlier one.
#[derive(Clone, Debug)]
pub(crate) enum Op {
    Number(f64),
    Parameter(usize),
    State(usize),
    /// Cosine of the forcing phase.
    Cos,
    /// Sine of the forcing phase.
    Sin,
    Unary(Unary, usize),
    Binary(Binary, usize, usize),
    /// The formula that the mode of a unit selects.
    Choice {
        unit: usize,
        by_mode: Vec<usize>,
    },
}

/// Operations on one number. The absolute value is for numbers that do not change with time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Unary {
    Negative,
    Sqrt,
    Exp,
    Log,
    Sin,
    Cos,
    Tan,
    Sinh,
    Cosh,
    Tanh,
    Arcsin,
    Arctan,
    Absolute,
}

impl Unary {
    pub(crate) fn of(self, x: f64) -> f64 {
        match self {
            Self::Negative => -x,
            Self::Sqrt => x.sqrt(),
            Self::Exp => x.exp(),
            Self::Log => x.ln(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Arcsin => x.asin(),
            Self::Arctan => x.atan(),
            Self::Absolute => x.abs(),
        }
    }
}

/// Operations on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

impl Binary {
    pub(crate) fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            // Small whole powers as products, as `x * x` elsewhere.
            Self::Power if b.fract() == 0.0 && b.abs() <= 64.0 => a.powi(b as i32),
            Self::Power => a.powf(b),
        }
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Op {
    type Error = PyErr;

    /// From (name, places of its operands, a number or an index).
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let (name, of, value): (String, Vec<usize>, f64) = object.extract()?;
        // no index is other than a whole number
        let index = match value as usize {
            index if index as f64 == value => index,
            _ => usize::MAX,
        };
        let unknown = || crate::error::of_definition(format!("no operation {name} of {of:?}"));
        let unary = match name.as_str() {
            "negative" => Some(Unary::Negative),
            "sqrt" => Some(Unary::Sqrt),
            "exp" => Some(Unary::Exp),
            "log" => Some(Unary::Log),
            "sin" => Some(Unary::Sin),
            "cos" => Some(Unary::Cos),
            "tan" => Some(Unary::Tan),
            "sinh" => Some(Unary::Sinh),
            "cosh" => Some(Unary::Cosh),
            "tanh" => Some(Unary::Tanh),
            "arcsin" => Some(Unary::Arcsin),
            "arctan" => Some(Unary::Arctan),
            "absolute" => Some(Unary::Absolute),
            _ => None,
        };
        let binary = match name.as_str() {
            "add" => Some(Binary::Add),
            "subtract" => Some(Binary::Subtract),
            "multiply" => Some(Binary::Multiply),
            "divide" => Some(Binary::Divide),
            "power" => Some(Binary::Power),
            _ => None,
        };
        match (unary, binary, of.as_slice()) {
            (Some(op), _, &[a]) => Ok(Self::Unary(op, a)),
            (_, Some(op), &[a, b]) => Ok(Self::Binary(op, a, b)),
            (None, None, []) => match name.as_str() {
                "number" => Ok(Self::Number(value)),
                "parameter" => Ok(Self::Parameter(index)),
                "state" => Ok(Self::State(index)),
                "forcing cos" => Ok(Self::Cos),
                "forcing sin" => Ok(Self::Sin),
                _ => Err(unknown()),
            },
            (None, None, _) if name == "choice" => Ok(Self::Choice {
                unit: index,
                by_mode: of,
            }),
            _ => Err(unknown()),
        }
    }
}

impl Op {
    /// The operations that it reads.
    pub(crate) fn reads(&self) -> Vec<usize> {
        match self {
            Self::Unary(_, a) => vec![*a],
            Self::Binary(_, a, b) => vec![*a, *b],
            Self::Choice { by_mode, .. } => by_mode.clone(),
            _ => Vec::new(),
        }
    }
}
