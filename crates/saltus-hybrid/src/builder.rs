//! Writes a system down, quantity by quantity.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::function::Function;
use crate::program::{BuildError, Gate, Node, Operation, Program, Transition, Unit};
use crate::structure::Structure;
use crate::system::System;

/// Collects the parts of a [`System`].
///
/// ```
/// use saltus_hybrid::{SystemBuilder, Transition};
/// // A ball under gravity 1 that bounces with restitution 0.8.
/// let mut b = SystemBuilder::new(2);
/// let (height, speed) = (b.state(0), b.state(1));
/// let fall = b.linear(-1.0, &[]);
/// let rebound = b.linear(0.0, &[(-0.8, speed)]);
/// b.derivative(0, speed);
/// b.derivative(1, fall);
/// b.unit(vec![vec![Transition::falling(height, 0).reset(1, rebound)]]);
/// let ball = b.build(10.0)?;
/// assert_eq!(ball.state_len(), 2);
/// # Ok::<(), saltus_hybrid::BuildError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SystemBuilder {
    pub(crate) program: Program,
}

impl SystemBuilder {
    /// A system of `states` states.
    pub fn new(states: usize) -> Self {
        Self {
            program: Program::new(states),
        }
    }

    fn push(&mut self, op: Operation) -> Vec<Node> {
        self.program.push(op).map(Node::Op).collect()
    }

    /// The node of state `index`.
    pub fn state(&self, index: usize) -> Node {
        Node::State(index)
    }

    /// Lets errors of state `index` be relative to `scale` where the state is smaller than that. They are relative to
    /// how large the state has been in this period and the one before, and to nothing smaller.
    ///
    /// # Panics
    /// If there is no such state.
    pub fn scale(&mut self, index: usize, scale: f64) {
        self.program.scales[index] = scale;
    }

    /// Lets errors of all states be relative to the largest of them, and to `scale` where that is smaller: they are
    /// coordinates of one body, and a small one matters by its share of the whole. A state beyond 16 scales is no part
    /// of it any more, and each is then relative to its own size. Replaces all scales so far.
    pub fn scale_together(&mut self, scale: f64) {
        self.program.scales.fill(scale);
        self.program.together = true;
    }

    /// Drives the system at angular frequency `omega`; gives cos(omega t) and sin(omega t).
    /// Call it once, before any quadrature.
    pub fn drive(&mut self, omega: f64) -> (Node, Node) {
        debug_assert!(self.program.drive.is_none() && self.program.quadratures == 0);
        self.program.drive = Some(omega);
        let (cos, sin) = (
            Node::State(self.program.declared),
            Node::State(self.program.declared + 1),
        );
        let dcos = self.linear(0.0, &[(-omega, sin)]);
        let dsin = self.linear(0.0, &[(omega, cos)]);
        self.program.derivative.extend([Some(dcos), Some(dsin)]);
        (cos, sin)
    }

    /// constant + sum of coefficient times node.
    pub fn linear(&mut self, constant: f64, terms: &[(f64, Node)]) -> Node {
        let constant = self.program.push_coefficient(constant);
        for &(c, _) in terms {
            self.program.push_coefficient(c);
        }
        let terms = terms.iter().map(|&(_, node)| node).collect();
        let sum = self.program.push(Operation::Linear { constant, terms });
        Node::Op(sum.start)
    }

    /// A matrix times `nodes`, one node per row: the same as one [`Self::linear`] for each row, and
    /// faster where few entries are zero.
    ///
    /// # Panics
    /// If a row is not as long as `nodes`.
    pub fn matrix(&mut self, nodes: &[Node], rows: &[Vec<f64>]) -> Vec<Node> {
        assert!(rows.iter().all(|row| row.len() == nodes.len()));
        let weights = self.program.push_weights(rows, nodes.len());
        if weights.is_empty() {
            return Vec::new();
        }
        self.push(Operation::Matrix {
            weights: (weights.start, weights.end),
            nodes: nodes.to_vec(),
        })
    }

    /// Sum of products of two nodes each.
    pub fn dot(&mut self, pairs: &[(Node, Node)]) -> Node {
        let products = self.products(pairs);
        let terms: Vec<_> = products.into_iter().map(|node| (1.0, node)).collect();
        self.linear(0.0, &terms)
    }

    /// The squares of nodes: half the work of as many [`Self::products`].
    pub fn squares(&mut self, nodes: &[Node]) -> Vec<Node> {
        self.push(Operation::Squares(nodes.to_vec()))
    }

    /// The gradient of a quartic form in squares: for nodes y and a matrix A, the squares y_b^2 and the products
    /// y_a (sum_b A_ab y_b^2 + added_a). `added` holds one node for each y, made by
    /// one [`Self::matrix`] or [`Self::products`], or none. Fastest where A is zero outside its first
    /// `heads` rows and columns, or nearly so.
    ///
    /// # Panics
    /// If A is not square, or `heads` or `added` do not fit.
    pub fn cubic(
        &mut self,
        y: &[Node],
        a: &[Vec<f64>],
        heads: usize,
        added: &[Node],
    ) -> (Vec<Node>, Vec<Node>) {
        let count = y.len();
        assert!(a.len() == count && a.iter().all(|row| row.len() == count) && heads <= count);
        let neighbours = |pair: &[Node]| match (pair[0], pair[1]) {
            (Node::Op(i), Node::Op(j)) => j == i + 1,
            _ => false,
        };
        assert!(added.is_empty() || added.len() == count && added.windows(2).all(neighbours));
        let weights = self.program.push_weights(&a[..heads], count).start;
        self.program.push_weights(&a[heads..], heads);
        let mut extra = Vec::new();
        for (row, weights) in a.iter().enumerate().skip(heads) {
            for (column, &weight) in weights.iter().enumerate().skip(heads) {
                if weight != 0.0 {
                    extra.push((row, column, self.program.push_coefficient(weight)));
                }
            }
        }
        let mut nodes = self.push(Operation::Cubic {
            y: y.to_vec(),
            added: added.to_vec(),
            heads,
            weights,
            extra,
        });
        nodes.truncate(2 * count);
        let products = nodes.split_off(count);
        (nodes, products)
    }

    /// Announces `count` nodes that follow others adiabatically; see [`Self::define_adiabatic`]. A
    /// system has them once.
    ///
    /// # Panics
    /// If it has them already.
    pub fn reserve_adiabatic(&mut self, count: usize) -> Vec<Node> {
        let other = |op: &Operation| matches!(op, Operation::Adiabatic { .. });
        assert!(!self.program.operations.iter().any(other));
        self.append_adiabatic(count)
    }

    /// Announces such nodes beside others.
    pub(crate) fn append_adiabatic(&mut self, count: usize) -> Vec<Node> {
        self.push(Operation::Adiabatic {
            count,
            sources: Vec::new(),
            damping: 0,
            responses: Vec::new(),
        })
    }

    /// Defines the reserved nodes: x = sum over n >= 1 of R_n (D^2 + `damping` D)^n q, where q are
    /// `sources` and D is the time derivative along the solution. So fast, linear oscillators follow q
    /// beyond their static response, by one term for each R.
    ///
    /// # Panics
    /// If nothing was reserved, or an R is not of `count` rows of one number for each source.
    pub fn define_adiabatic(&mut self, sources: &[Node], damping: f64, r: &[Vec<Vec<f64>>]) {
        let damping = self.program.push_coefficient(damping);
        let mut starts = Vec::new();
        for matrix in r {
            assert!(matrix.iter().all(|row| row.len() == sources.len()));
            starts.push(self.program.push_weights(matrix, sources.len()).start);
        }
        let is_it = |op: &&mut Operation| matches!(op, Operation::Adiabatic { .. });
        let reserved = self
            .program
            .operations
            .iter_mut()
            .find(is_it)
            .expect("nodes were reserved");
        if let Operation::Adiabatic {
            count,
            sources: nodes,
            damping: place,
            responses,
        } = reserved
        {
            assert!(r.iter().all(|matrix| matrix.len() == *count));
            (*nodes, *place, *responses) = (sources.to_vec(), damping, starts);
        }
    }

    /// Products of two nodes each. Many at once are faster than one by one.
    pub fn products(&mut self, pairs: &[(Node, Node)]) -> Vec<Node> {
        self.push(Operation::Products(pairs.to_vec()))
    }

    /// `dividend` over `divisor`: a trajectory ends where the divisor is zero. The work of one product.
    pub fn quotient(&mut self, dividend: Node, divisor: Node) -> Node {
        let active = self.program.push_coefficient(1.0);
        self.one(Operation::Quotient {
            dividend,
            divisor,
            active,
        })
    }

    /// `base` to a power that is no whole number, such as 1/2 for the square root. A trajectory ends where the base is
    /// negative by more than rounding (1e-9); at zero it goes on, in short steps. The work of one product and a half.
    pub fn power(&mut self, base: Node, exponent: f64) -> Node {
        let exponent = self.program.push_coefficient(exponent);
        let active = self.program.push_coefficient(1.0);
        self.one(Operation::Power {
            base,
            exponent,
            active,
        })
    }

    /// exp u. The work of one product and a value, as that of every function below but for quantities that it names.
    pub fn exp(&mut self, u: Node) -> Node {
        let own = self.ahead(0);
        self.function(Function::Exp, u, own, false)
    }

    /// Natural logarithm of u; with 1/u. A trajectory ends where u is not positive.
    pub fn log(&mut self, u: Node) -> Node {
        let inverse = self.ahead(2);
        let log = self.function(Function::Log, u, inverse, false);
        let one = self.linear(1.0, &[]);
        self.quotient(one, u);
        log
    }

    /// (sin u, cos u).
    pub fn sin_cos(&mut self, u: Node) -> (Node, Node) {
        self.pair(Function::Sin, Function::Cos, true, u)
    }

    /// (sinh u, cosh u).
    pub fn sinh_cosh(&mut self, u: Node) -> (Node, Node) {
        self.pair(Function::Sinh, Function::Cosh, false, u)
    }

    /// tan u; with its square.
    pub fn tan(&mut self, u: Node) -> Node {
        self.with_square(Function::Tan, 1.0, u)
    }

    /// tanh u; with its square.
    pub fn tanh(&mut self, u: Node) -> Node {
        self.with_square(Function::Tanh, -1.0, u)
    }

    /// Inverse sine of u; with 1/sqrt(1 - u^2). A trajectory ends where u is beyond -1 or 1.
    pub fn asin(&mut self, u: Node) -> Node {
        let square = self.squares(&[u])[0];
        let below = self.linear(1.0, &[(-1.0, square)]);
        let slope = self.power(below, -0.5);
        self.function(Function::Asin, u, slope, false)
    }

    /// Inverse tangent of u; with 1/(1 + u^2).
    pub fn atan(&mut self, u: Node) -> Node {
        let square = self.squares(&[u])[0];
        let one = self.linear(1.0, &[]);
        let above = self.linear(1.0, &[(1.0, square)]);
        let slope = self.quotient(one, above);
        self.function(Function::Atan, u, slope, false)
    }

    fn one(&mut self, op: Operation) -> Node {
        Node::Op(self.program.push(op).start)
    }

    /// The node that is made after so many others.
    fn ahead(&self, others: usize) -> Node {
        Node::Op(self.program.nodes + others)
    }

    fn function(&mut self, function: Function, of: Node, slope: Node, minus: bool) -> Node {
        let active = self.program.push_coefficient(1.0);
        self.one(Operation::Function {
            function,
            of,
            slope,
            minus,
            active,
        })
    }

    /// Two functions, each the slope of the other; the second rises by minus the first if `minus`.
    fn pair(&mut self, first: Function, second: Function, minus: bool, u: Node) -> (Node, Node) {
        let [one, other] = [0, 1].map(|others| self.ahead(others));
        self.function(first, u, other, false);
        self.function(second, u, one, minus);
        (one, other)
    }

    /// A function y whose slope is 1 + `sign` y^2.
    fn with_square(&mut self, function: Function, sign: f64, u: Node) -> Node {
        let slope = self.ahead(2);
        let y = self.function(function, u, slope, false);
        let square = self.squares(&[y])[0];
        self.linear(1.0, &[(sign, square)]);
        y
    }

    /// `node` times a number that depends on the mode of `unit`, one for each mode.
    pub fn gate(&mut self, unit: Unit, by_mode: &[f64], node: Node) -> Node {
        self.gated_linear(unit, by_mode, &[(1.0, node)])
    }

    /// A sum without constant, times a number that depends on the mode of `unit`, one for each mode.
    pub fn gated_linear(&mut self, unit: Unit, by_mode: &[f64], terms: &[(f64, Node)]) -> Node {
        let first = self.program.coefficients.len() + 1;
        let out = self.linear(0.0, terms);
        for (i, (weight, _)) in terms.iter().enumerate() {
            let values = by_mode.iter().map(|gate| gate * weight).collect();
            self.program.gates.push(Gate {
                coefficient: first + i,
                unit: unit.0,
                by_mode: values,
            });
        }
        out
    }

    /// Lets a coefficient follow the modes as another one does, times `factor`.
    pub(crate) fn switch_likewise(&mut self, other: usize, coefficient: usize, factor: f64) {
        let mut gates = self.program.gates.iter();
        let known = gates.find(|gate| gate.coefficient == other);
        let scaled = known.map(|gate| Gate {
            coefficient,
            unit: gate.unit,
            by_mode: gate.by_mode.iter().map(|value| factor * value).collect(),
        });
        self.program.gates.extend(scaled);
    }

    /// Sets x' of state `index`.
    pub fn derivative(&mut self, index: usize, value: Node) {
        // States move on in the order of their indices, so one may only follow a later one directly.
        let value = match value {
            Node::State(i) if i <= index => self.linear(0.0, &[(1.0, value)]),
            _ => value,
        };
        self.program.derivative[index] = Some(value);
    }

    /// Announces a unit, so that gates can name it before its guards exist.
    pub fn reserve_unit(&mut self) -> Unit {
        self.program.units.push(Vec::new());
        Unit(self.program.units.len() - 1)
    }

    /// Gives a reserved unit its modes, each a list of the transitions that end it.
    pub fn define_unit(&mut self, unit: Unit, modes: Vec<Vec<Transition>>) {
        self.program.units[unit.0] = modes;
    }

    /// Adds a unit with its modes, each a list of the transitions that end it.
    pub fn unit(&mut self, modes: Vec<Vec<Transition>>) -> Unit {
        let unit = self.reserve_unit();
        self.define_unit(unit, modes);
        unit
    }

    /// Gives a reserved unit two modes that follow the sign of a quantity: 0 while it is negative, 1 while it is
    /// positive. Wherever a [`System::point`] is made they are those of the state there.
    pub fn follow_sign(&mut self, unit: Unit, of: Node) {
        let modes = [Transition::rising(of, 1), Transition::falling(of, 0)];
        self.define_unit(unit, modes.map(|leave| vec![leave]).into());
        self.program.signs.push(unit.0);
    }

    /// The time integral of `integrand`, kept out of the error control: the rest of the state is
    /// the same to the bit with and without it. Call it after [`Self::drive`].
    pub fn quadrature(&mut self, integrand: Node) -> usize {
        self.program.quadratures += 1;
        self.program.derivative.push(Some(integrand));
        self.program.derivative.len() - 1
    }

    /// The system; `period` is the sampling interval where nothing drives it, else it is 2 pi/omega.
    ///
    /// # Errors
    /// [`BuildError`] for a part that is missing or wrong.
    pub fn build(self, period: f64) -> Result<System, BuildError> {
        let mut program = self.program;
        let period = program.sampling_interval(period)?;
        program.check_numbers()?;
        program.note_idle_modes();
        let mut structure = Structure::of(&program)?;
        let tables = structure.note_gates(&program)?;
        let scales = program.scales.iter().copied().chain([1.0; 2]);
        Ok(System {
            scales: scales.take(structure.controlled).collect(),
            structure: Arc::new(structure),
            coefficients: std::mem::take(&mut program.coefficients).into(),
            tables: tables.into(),
            period,
            program: Arc::new(program),
        })
    }
}

impl Program {
    /// Period of the drive; the one given where there is none.
    fn sampling_interval(&self, given: f64) -> Result<f64, BuildError> {
        let period = self.drive.map_or(given, |omega| TAU / omega);
        if period > 0.0 && period.is_finite() {
            Ok(period)
        } else {
            Err(BuildError::Period(period))
        }
    }

    fn check_numbers(&self) -> Result<(), BuildError> {
        let wrong =
            |scale: &f64| !(*scale >= 0.0 && scale.is_finite()) || self.together && *scale == 0.0;
        if let Some(state) = self.scales.iter().position(wrong) {
            let scale = self.scales[state];
            return Err(BuildError::Scale { state, scale });
        }
        match self.coefficients.iter().position(|c| !c.is_finite()) {
            Some(index) => Err(BuildError::NotFinite {
                index,
                value: self.coefficients[index],
            }),
            None => Ok(()),
        }
    }
}
