//! The words that a system is written in, and the program they make: plain data.
//!
//! A state x obeys x' = f(x, cos(Omega t), sin(Omega t)), f being built from sums, products, quotients, powers and
//! elementary functions. A part that can switch is a [`Unit`]: a small automaton whose mode selects
//! some of the coefficients. A mode lasts while each of its guards is positive.

use std::ops::Range;

use crate::function::Function;

/// A quantity of the program: a state or the result of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// State by index.
    State(usize),
    /// Operation by index.
    Op(usize),
}

/// Something that switches on its own, such as one person's contact with the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit(pub(crate) usize);

/// A mode of a unit, by its place in the list given to [`SystemBuilder::unit`](crate::SystemBuilder::unit).
pub type Mode = usize;

/// The end of a mode: the guard that ends it, the mode that follows, the states that jump.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// The quantity watched.
    pub guard: Node,
    /// +1 if the mode lasts while the guard is positive, -1 if while it is negative.
    pub sign: f64,
    /// The mode that follows.
    pub to: Mode,
    /// States that jump: x := value of the node, all evaluated before the first assignment.
    pub resets: Vec<(usize, Node)>,
    /// Guards that are zero after the switch by construction, with the multiplicity of that zero. Zeros are found
    /// to rounding without this list; an entry also holds where rounding hides the zero.
    pub vanishing: Vec<(Node, u8)>,
}

impl Transition {
    /// Leaves for `to` when `guard` falls to zero.
    pub fn falling(guard: Node, to: Mode) -> Self {
        Self {
            guard,
            sign: 1.0,
            to,
            resets: Vec::new(),
            vanishing: Vec::new(),
        }
    }

    /// Leaves for `to` when `guard` rises to zero.
    pub fn rising(guard: Node, to: Mode) -> Self {
        Self {
            sign: -1.0,
            ..Self::falling(guard, to)
        }
    }

    /// Adds the reset `state` := `value` at the switch.
    #[must_use]
    pub fn reset(mut self, state: usize, value: Node) -> Self {
        self.resets.push((state, value));
        self
    }

    /// Declares `guard` zero to `multiplicity` after the switch.
    #[must_use]
    pub fn vanishing(mut self, guard: Node, multiplicity: u8) -> Self {
        self.vanishing.push((guard, multiplicity));
        self
    }
}

/// An operation of the program: some nodes made from others. Weights and constants are places among the
/// coefficients.
#[derive(Clone, Debug)]
pub(crate) enum Operation {
    Linear {
        constant: usize,
        terms: Vec<Node>,
    },
    Matrix {
        weights: (usize, usize),
        nodes: Vec<Node>,
    },
    Squares(Vec<Node>),
    Products(Vec<(Node, Node)>),
    Adiabatic {
        count: usize,
        sources: Vec<Node>,
        damping: usize,
        responses: Vec<usize>,
    },
    Cubic {
        y: Vec<Node>,
        added: Vec<Node>,
        heads: usize,
        weights: usize,
        extra: Vec<(usize, usize, usize)>,
    },
    /// The first over the second. In modes in which nothing needs the result the coefficient `active` is 0: this and the
    /// next two then operate on numbers that do no harm.
    Quotient {
        dividend: Node,
        divisor: Node,
        active: usize,
    },
    Power {
        base: Node,
        exponent: usize,
        active: usize,
    },
    /// y = F(of), whose rate is the slope times that of its argument, or minus that. The slope may come later.
    Function {
        function: Function,
        of: Node,
        slope: Node,
        minus: bool,
        active: usize,
    },
}

impl Operation {
    /// Number of nodes that it makes.
    pub(crate) fn nodes(&self) -> usize {
        match self {
            Self::Linear { .. }
            | Self::Quotient { .. }
            | Self::Power { .. }
            | Self::Function { .. } => 1,
            Self::Squares(list) => list.len(),
            Self::Products(list) => list.len(),
            Self::Cubic { y, .. } => 3 * y.len(),
            Self::Adiabatic { count, .. } => *count,
            Self::Matrix { weights, nodes } => (weights.1 - weights.0) / nodes.len(),
        }
    }
}

/// A coefficient that depends on the mode of a unit.
#[derive(Clone, Debug)]
pub(crate) struct Gate {
    /// Its place among the coefficients.
    pub(crate) coefficient: usize,
    pub(crate) unit: usize,
    /// Its value in each mode.
    pub(crate) by_mode: Vec<f64>,
}

/// A system as it was described.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    /// States declared at the start; those of the drive and the quadratures follow.
    pub(crate) declared: usize,
    /// Angular frequency of the drive.
    pub(crate) drive: Option<f64>,
    pub(crate) quadratures: usize,
    /// Size of each declared state below which its errors are not relative to it; 0 for none.
    pub(crate) scales: Vec<f64>,
    /// Whether all states are as large as the largest.
    pub(crate) together: bool,
    /// Rate of each state.
    pub(crate) derivative: Vec<Option<Node>>,
    pub(crate) operations: Vec<Operation>,
    /// Nodes that the operations make.
    pub(crate) nodes: usize,
    pub(crate) coefficients: Vec<f64>,
    pub(crate) gates: Vec<Gate>,
    /// Transitions of each mode of each unit.
    pub(crate) units: Vec<Vec<Vec<Transition>>>,
    /// Units that follow the sign of a quantity.
    pub(crate) signs: Vec<usize>,
}

impl Program {
    /// An empty program of this many states.
    pub(crate) fn new(states: usize) -> Self {
        Self {
            declared: states,
            drive: None,
            quadratures: 0,
            scales: vec![0.0; states],
            together: false,
            derivative: vec![None; states],
            operations: Vec::new(),
            nodes: 0,
            coefficients: Vec::new(),
            gates: Vec::new(),
            units: Vec::new(),
            signs: Vec::new(),
        }
    }

    /// Appends an operation; the nodes that it makes, by index.
    pub(crate) fn push(&mut self, op: Operation) -> Range<usize> {
        let first = self.nodes;
        self.nodes += op.nodes();
        self.operations.push(op);
        first..self.nodes
    }

    /// Appends a coefficient; its place.
    pub(crate) fn push_coefficient(&mut self, value: f64) -> usize {
        self.coefficients.push(value);
        self.coefficients.len() - 1
    }

    /// Appends the rows of a matrix by fours, within these node by node: the order in which the series code reads
    /// them. Gives their places.
    pub(crate) fn push_weights(&mut self, rows: &[Vec<f64>], columns: usize) -> Range<usize> {
        let first = self.coefficients.len();
        for block in rows.chunks(4) {
            for column in 0..columns {
                let weights = block.iter().map(|row| row[column]);
                self.coefficients.extend(weights);
            }
        }
        first..self.coefficients.len()
    }

    /// The rows of an [`Operation::Matrix`].
    pub(crate) fn matrix(&self, weights: (usize, usize), columns: usize) -> Vec<Vec<f64>> {
        rows_of(&self.coefficients[weights.0..weights.1], columns)
    }

    /// The matrix A of an [`Operation::Cubic`].
    pub(crate) fn cubic_matrix(&self, op: &Operation) -> Vec<Vec<f64>> {
        let Operation::Cubic {
            y,
            heads,
            weights,
            extra,
            ..
        } = op
        else {
            return Vec::new();
        };
        let (count, heads) = (y.len(), *heads);
        let middle = weights + heads * count;
        let end = middle + (count - heads) * heads;
        let mut a = rows_of(&self.coefficients[*weights..middle], count);
        let mut rest = rows_of(&self.coefficients[middle..end], heads);
        rest.iter_mut().for_each(|row| row.resize(count, 0.0));
        a.append(&mut rest);
        for &(row, column, weight) in extra {
            a[row][column] = self.coefficients[weight];
        }
        a
    }
}

/// The rows that [`Program::push_weights`] appended, from these coefficients.
fn rows_of(weights: &[f64], columns: usize) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for block in weights.chunks(4 * columns) {
        let height = block.len() / columns;
        let row = |i: usize| block.iter().skip(i).step_by(height).copied().collect();
        rows.extend((0..height).map(row));
    }
    rows
}

/// Reason why the parts of a builder do not make a system.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A state without a derivative.
    #[error("state {0} has no derivative")]
    NoDerivative(usize),
    /// A state, operation, unit or mode that does not exist or comes later in the program.
    #[error("{0} is not defined at that point of the program")]
    Undefined(String),
    /// A coefficient that is not a finite number.
    #[error("coefficient {index} is {value}: a finite number is needed")]
    NotFinite {
        /// Its index.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// More quantities than an index can name.
    #[error("the program has {0} quantities, at most 65536 are possible: take fewer terms")]
    TooLarge(usize),
    /// A scale that is no size.
    #[error("the scale of state {state} is {scale}: a positive number is needed, or 0 for none")]
    Scale {
        /// The state.
        state: usize,
        /// The number given.
        scale: f64,
    },
    /// A period that is not positive.
    #[error("the period is {0}: a positive number is needed")]
    Period(f64),
}
