//! A forced hybrid system as a short straight-line program: the one description from which values,
//! Taylor coefficients and lanes are computed.
//!
//! A state x obeys x' = f(x, cos(Omega t), sin(Omega t)), f being built from sums and products, so
//! that it is polynomial. What can switch is a [`Unit`]: a small automaton whose mode selects some
//! of the coefficients ([`SystemBuilder::gate`]). A mode lasts while each of its guards is positive.

use std::sync::Arc;

use crate::compile::{Parts, Structure};
use crate::series::Series;
use crate::special::{self, Shape};

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

/// A mode of a unit, by its place in the list given to [`SystemBuilder::unit`].
pub type Mode = usize;

/// What ends a mode, and what happens then.
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
    /// Guards that are zero after the switch by construction, with the multiplicity of that zero. It need not
    /// be said: zeros are found, to rounding, where they are. Said, it also holds where rounding hides it.
    pub vanishing: Vec<(Node, u8)>,
}

impl Transition {
    /// Leave for `to` when `guard` falls to zero.
    pub fn falling(guard: Node, to: Mode) -> Self {
        Self {
            guard,
            sign: 1.0,
            to,
            resets: Vec::new(),
            vanishing: Vec::new(),
        }
    }

    /// Leave for `to` when `guard` rises to zero.
    pub fn rising(guard: Node, to: Mode) -> Self {
        Self {
            sign: -1.0,
            ..Self::falling(guard, to)
        }
    }

    /// With `state` := `value` at the switch.
    #[must_use]
    pub fn reset(mut self, state: usize, value: Node) -> Self {
        self.resets.push((state, value));
        self
    }

    /// With `guard` zero to `multiplicity` after the switch.
    #[must_use]
    pub fn vanishing(mut self, guard: Node, multiplicity: u8) -> Self {
        self.vanishing.push((guard, multiplicity));
        self
    }
}

/// Why a builder's parts do not make a system.
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

/// A system: a structure and its numbers. Cheap to clone.
#[derive(Clone, Debug)]
pub struct System {
    pub(crate) structure: Arc<Structure>,
    pub(crate) coefficients: Arc<[f64]>,
    pub(crate) tables: Arc<[f64]>,
    /// Of each state that takes part in error control.
    pub(crate) scales: Arc<[f64]>,
    pub(crate) period: f64,
    /// What it was built from, but for the coefficients.
    pub(crate) plan: Arc<SystemBuilder>,
}

impl System {
    /// Forcing period 2 pi/Omega, or the sampling interval of a system that is not driven.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Length of the state vector, drive and quadratures included.
    pub fn state_len(&self) -> usize {
        self.structure.states
    }

    /// Number of states declared at the start: those that may be chosen freely.
    pub fn declared_len(&self) -> usize {
        self.plan.declared
    }

    /// Number of units that switch.
    pub fn unit_count(&self) -> usize {
        self.structure.units.len()
    }

    /// Whether both have the same program, so that they may share a run.
    pub fn same_structure(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.structure, &other.structure) || self.structure == other.structure
    }

    /// This system with the structure object of `other`, if they are equal: makes later comparisons cheap.
    #[must_use]
    pub fn sharing(mut self, other: &Self) -> Self {
        if self.same_structure(other) {
            self.structure = Arc::clone(&other.structure);
        }
        self
    }

    /// A point with the drive at phase 0 and quadratures at 0; `x` holds the states declared by
    /// [`SystemBuilder::state`], in order.
    ///
    /// # Panics
    /// If `x` or `modes` are longer than the system's.
    pub fn point(&self, modes: &[Mode], x: &[f64]) -> Point {
        assert!(x.len() <= self.structure.states && modes.len() == self.structure.units.len());
        let mut state = vec![0.0; self.structure.states];
        state[..x.len()].copy_from_slice(x);
        if let Some((cos, sin)) = self.structure.drive {
            (state[cos], state[sin]) = (1.0, 0.0);
        }
        Point {
            modes: modes.to_vec(),
            x: state,
        }
    }

    /// Coefficients in force for these modes, in the order in which the program reads them.
    pub(crate) fn stream(&self, modes: &[Mode]) -> Vec<f64> {
        let stream = self.structure.stream.iter();
        let mut out: Vec<f64> = stream.map(|&c| self.coefficients[c as usize]).collect();
        for (place, value) in self.switched_in(modes) {
            out[place] = value;
        }
        out
    }

    /// Place in the stream and value of the coefficients that depend on modes.
    pub(crate) fn switched_in(&self, modes: &[Mode]) -> impl Iterator<Item = (usize, f64)> {
        let switched = self.structure.switched.iter();
        switched.map(|&(place, unit, table)| (place, self.tables[table + modes[unit]]))
    }

    /// Whether the engine has straight-line code for this program, beside the interpreter for all.
    pub fn is_specialised(&self) -> bool {
        Shape::of(&self.structure).is_some()
    }

    /// This program written out as straight-line code for the engine's `special` folder, if it can be.
    pub fn source(&self) -> Option<String> {
        special::source(&self.structure)
    }

    /// That code as the engine has it.
    pub fn written_source(&self) -> Option<&'static str> {
        Shape::of(&self.structure).map(Shape::written)
    }

    /// Flat index of a node in the output of [`Evaluator::nodes`].
    pub fn index(&self, node: Node) -> usize {
        match node {
            Node::State(i) => i,
            Node::Op(i) => self.structure.states + i,
        }
    }
}

/// Phase and state together; neither means anything alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Mode of each unit.
    pub modes: Vec<Mode>,
    /// State, drive and quadratures included.
    pub x: Vec<f64>,
}

/// Values of all nodes at a point. Keeps its buffers.
#[derive(Clone, Debug)]
pub struct Evaluator {
    system: System,
    modes: Vec<Mode>,
    coefficients: Vec<f64>,
    series: Series<f64>,
}

impl Evaluator {
    /// For this system.
    pub fn new(system: &System) -> Self {
        let modes = vec![0; system.unit_count()];
        Self {
            coefficients: system.stream(&modes),
            modes,
            series: Series::new(&system.structure, 1),
            system: system.clone(),
        }
    }

    /// Every node at (modes, x), states first; see [`System::index`].
    pub fn nodes(&mut self, modes: &[Mode], x: &[f64]) -> &[f64] {
        if self.modes != modes {
            self.modes.copy_from_slice(modes);
            self.coefficients = self.system.stream(modes);
        }
        let structure = &self.system.structure;
        for (i, &value) in x[..structure.states].iter().enumerate() {
            *self.series.value(structure.state_slots[i]) = value;
        }
        crate::series::values(structure, &self.coefficients, &mut self.series);
        self.series.now()
    }

    /// Derivative of every node while the states change at the rates `dx`, at the point that
    /// [`Self::nodes`] was called for last. What follows adiabatically changes as it does in time.
    pub fn along(&mut self, dx: &[f64]) -> &[f64] {
        let structure = &self.system.structure;
        crate::series::along(structure, &self.coefficients, dx, &mut self.series);
        self.series.now()
    }
}

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
    pub(crate) declared: usize,
    drive: Option<f64>,
    pub(crate) quadratures: usize,
    scales: Vec<f64>,
    /// Whether all states are as large as the largest.
    pub(crate) together: bool,
    pub(crate) derivative: Vec<Option<Node>>,
    pub(crate) ops: Vec<RawOp>,
    /// Nodes that the operations make.
    pub(crate) nodes: usize,
    pub(crate) coefficients: Vec<f64>,
    switched: Vec<(usize, usize, Vec<f64>)>,
    units: Vec<Vec<Vec<Transition>>>,
}

#[derive(Clone, Debug)]
pub(crate) enum RawOp {
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
}

impl RawOp {
    /// How many nodes it makes.
    pub(crate) fn nodes(&self) -> usize {
        match self {
            Self::Linear { .. } => 1,
            Self::Squares(list) => list.len(),
            Self::Products(list) => list.len(),
            Self::Cubic { y, .. } => 3 * y.len(),
            Self::Adiabatic { count, .. } => *count,
            Self::Matrix { weights, nodes } => (weights.1 - weights.0) / nodes.len(),
        }
    }
}

impl SystemBuilder {
    /// A system of `states` states.
    pub fn new(states: usize) -> Self {
        Self {
            declared: states,
            drive: None,
            quadratures: 0,
            scales: vec![0.0; states],
            together: false,
            derivative: vec![None; states],
            ops: Vec::new(),
            nodes: 0,
            coefficients: Vec::new(),
            switched: Vec::new(),
            units: Vec::new(),
        }
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
        self.scales[index] = scale;
    }

    /// Lets errors of all states be relative to the largest of them, and to `scale` where that is smaller: they are one
    /// body, and what matters of a small part of it is its share of the whole. A state beyond 16 scales is not part of it
    /// any more, and each is then relative to its own size. Takes the place of all scales so far.
    pub fn scale_together(&mut self, scale: f64) {
        self.scales.fill(scale);
        self.together = true;
    }

    /// Drives the system at angular frequency `omega`; gives cos(omega t) and sin(omega t).
    /// Call it once, before any quadrature.
    pub fn drive(&mut self, omega: f64) -> (Node, Node) {
        debug_assert!(self.drive.is_none() && self.quadratures == 0);
        self.drive = Some(omega);
        let (cos, sin) = (Node::State(self.declared), Node::State(self.declared + 1));
        let dcos = self.linear(0.0, &[(-omega, sin)]);
        let dsin = self.linear(0.0, &[(omega, cos)]);
        self.derivative.extend([Some(dcos), Some(dsin)]);
        (cos, sin)
    }

    fn coefficient(&mut self, value: f64) -> usize {
        self.coefficients.push(value);
        self.coefficients.len() - 1
    }

    fn push(&mut self, op: RawOp) -> Node {
        let node = Node::Op(self.nodes);
        self.nodes += op.nodes();
        self.ops.push(op);
        node
    }

    /// constant + sum of coefficient times node.
    pub fn linear(&mut self, constant: f64, terms: &[(f64, Node)]) -> Node {
        let constant = self.coefficient(constant);
        for &(c, _) in terms {
            self.coefficient(c);
        }
        let terms = terms.iter().map(|&(_, node)| node).collect();
        self.push(RawOp::Linear { constant, terms })
    }

    /// A matrix times `nodes`, one node per row: the same as one [`Self::linear`] for each row, and
    /// faster where few entries are zero.
    ///
    /// # Panics
    /// If a row is not as long as `nodes`.
    pub fn matrix(&mut self, nodes: &[Node], rows: &[Vec<f64>]) -> Vec<Node> {
        assert!(rows.iter().all(|row| row.len() == nodes.len()));
        let start = self.coefficients.len();
        self.push_weights(rows, nodes.len());
        let first = self.nodes;
        if start < self.coefficients.len() {
            let weights = (start, self.coefficients.len());
            self.push(RawOp::Matrix {
                weights,
                nodes: nodes.to_vec(),
            });
        }
        (first..self.nodes).map(Node::Op).collect()
    }

    /// Sum of products of two nodes each.
    pub fn dot(&mut self, pairs: &[(Node, Node)]) -> Node {
        let products = self.products(pairs);
        let terms: Vec<_> = products.into_iter().map(|node| (1.0, node)).collect();
        self.linear(0.0, &terms)
    }

    /// The squares of nodes: half the work of as many [`Self::products`].
    pub fn squares(&mut self, nodes: &[Node]) -> Vec<Node> {
        let first = self.nodes;
        self.push(RawOp::Squares(nodes.to_vec()));
        (first..self.nodes).map(Node::Op).collect()
    }

    /// The gradient of a quartic form in squares: for nodes y and a matrix A, the products
    /// y_a (sum_b A_ab y_b^2 + added_a), and the squares y_b^2. `added` holds one node for each y, made by
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
        let weights = self.coefficients.len();
        self.push_weights(&a[..heads], count);
        self.push_weights(&a[heads..], heads);
        let mut extra = Vec::new();
        for (row, weights) in a.iter().enumerate().skip(heads) {
            for (column, &weight) in weights.iter().enumerate().skip(heads) {
                if weight != 0.0 {
                    extra.push((row, column, self.coefficient(weight)));
                }
            }
        }
        let first = self.nodes;
        self.push(RawOp::Cubic {
            y: y.to_vec(),
            added: added.to_vec(),
            heads,
            weights,
            extra,
        });
        let nodes = |from: usize| (from..from + count).map(Node::Op).collect();
        (nodes(first), nodes(first + count))
    }

    /// Announces `count` nodes that follow others adiabatically; see [`Self::define_adiabatic`]. A
    /// system has them once.
    ///
    /// # Panics
    /// If it has them already.
    pub fn reserve_adiabatic(&mut self, count: usize) -> Vec<Node> {
        let other = |op: &RawOp| matches!(op, RawOp::Adiabatic { .. });
        assert!(!self.ops.iter().any(other));
        self.append_adiabatic(count)
    }

    /// As [`Self::reserve_adiabatic`], beside others.
    pub(crate) fn append_adiabatic(&mut self, count: usize) -> Vec<Node> {
        let first = self.nodes;
        self.push(RawOp::Adiabatic {
            count,
            sources: Vec::new(),
            damping: 0,
            responses: Vec::new(),
        });
        (first..self.nodes).map(Node::Op).collect()
    }

    /// Says what the reserved nodes are: x = sum over n >= 1 of R_n (D^2 + `damping` D)^n q, where q are
    /// `sources` and D is the time derivative along the solution. This is how fast, linear oscillators
    /// follow q beyond their static response, as far as the list of R goes.
    ///
    /// # Panics
    /// If nothing was reserved, or an R is not of `count` rows of one number for each source.
    pub fn define_adiabatic(&mut self, sources: &[Node], damping: f64, r: &[Vec<Vec<f64>>]) {
        let damping = self.coefficient(damping);
        let mut starts = Vec::new();
        for matrix in r {
            assert!(matrix.iter().all(|row| row.len() == sources.len()));
            starts.push(self.coefficients.len());
            self.push_weights(matrix, sources.len());
        }
        let is_it = |op: &&mut RawOp| matches!(op, RawOp::Adiabatic { .. });
        let reserved = self
            .ops
            .iter_mut()
            .find(is_it)
            .expect("nodes were reserved");
        if let RawOp::Adiabatic {
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

    /// Rows by fours, within these node by node: the order in which the series code reads them.
    fn push_weights(&mut self, rows: &[Vec<f64>], columns: usize) {
        for block in rows.chunks(4) {
            for column in 0..columns {
                self.coefficients
                    .extend(block.iter().map(|row| row[column]));
            }
        }
    }

    /// The rows of [`Self::push_weights`], from these coefficients.
    fn rows_of(weights: &[f64], columns: usize) -> Vec<Vec<f64>> {
        let mut rows = Vec::new();
        for block in weights.chunks(4 * columns) {
            let height = block.len() / columns;
            let row = |i: usize| block.iter().skip(i).step_by(height).copied().collect();
            rows.extend((0..height).map(row));
        }
        rows
    }

    /// The rows of a [`RawOp::Matrix`].
    pub(crate) fn rows(
        coefficients: &[f64],
        weights: (usize, usize),
        columns: usize,
    ) -> Vec<Vec<f64>> {
        Self::rows_of(&coefficients[weights.0..weights.1], columns)
    }

    /// The matrix A of a [`RawOp::Cubic`].
    pub(crate) fn cubic_matrix(coefficients: &[f64], op: &RawOp) -> Vec<Vec<f64>> {
        let RawOp::Cubic {
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
        let mut a = Self::rows_of(&coefficients[*weights..middle], count);
        let mut rest = Self::rows_of(
            &coefficients[middle..middle + (count - heads) * heads],
            heads,
        );
        rest.iter_mut().for_each(|row| row.resize(count, 0.0));
        a.append(&mut rest);
        for &(row, column, weight) in extra {
            a[row][column] = coefficients[weight];
        }
        a
    }

    /// Products of two nodes each. Many at once are faster than one by one.
    pub fn products(&mut self, pairs: &[(Node, Node)]) -> Vec<Node> {
        let first = self.nodes;
        self.push(RawOp::Products(pairs.to_vec()));
        (first..self.nodes).map(Node::Op).collect()
    }

    /// `node` times a number that depends on the mode of `unit`, one for each mode.
    pub fn gate(&mut self, unit: Unit, by_mode: &[f64], node: Node) -> Node {
        self.gated_linear(unit, by_mode, &[(1.0, node)])
    }

    /// A sum without constant, times a number that depends on the mode of `unit`, one for each mode.
    pub fn gated_linear(&mut self, unit: Unit, by_mode: &[f64], terms: &[(f64, Node)]) -> Node {
        let first = self.coefficients.len() + 1;
        let out = self.linear(0.0, terms);
        for (i, (weight, _)) in terms.iter().enumerate() {
            let values = by_mode.iter().map(|gate| gate * weight).collect();
            self.switched.push((first + i, unit.0, values));
        }
        out
    }

    /// Lets a coefficient follow the modes as another one does, times `factor`.
    pub(crate) fn switch_likewise(&mut self, other: usize, coefficient: usize, factor: f64) {
        let known = self.switched.iter().find(|(at, ..)| *at == other);
        let scaled = known.map(|(_, unit, values)| {
            let values = values.iter().map(|value| factor * value).collect();
            (coefficient, *unit, values)
        });
        self.switched.extend(scaled);
    }

    /// Sets x' of state `index`.
    pub fn derivative(&mut self, index: usize, value: Node) {
        // States move on in the order of their indices, so one may only follow a later one directly.
        let value = match value {
            Node::State(i) if i <= index => self.linear(0.0, &[(1.0, value)]),
            _ => value,
        };
        self.derivative[index] = Some(value);
    }

    /// Announces a unit, so that gates can name it before its guards exist.
    pub fn reserve_unit(&mut self) -> Unit {
        self.units.push(Vec::new());
        Unit(self.units.len() - 1)
    }

    /// The modes of a reserved unit, each a list of what ends it.
    pub fn define_unit(&mut self, unit: Unit, modes: Vec<Vec<Transition>>) {
        self.units[unit.0] = modes;
    }

    /// A unit with its modes, each a list of what ends it.
    pub fn unit(&mut self, modes: Vec<Vec<Transition>>) -> Unit {
        let unit = self.reserve_unit();
        self.define_unit(unit, modes);
        unit
    }

    /// The time integral of `integrand`, kept out of the error control: the rest of the state is
    /// the same to the bit with and without it. Call it after [`Self::drive`].
    pub fn quadrature(&mut self, integrand: Node) -> usize {
        self.quadratures += 1;
        self.derivative.push(Some(integrand));
        self.derivative.len() - 1
    }

    /// The system; `period` is the sampling interval where nothing drives it, else it is 2 pi/omega.
    ///
    /// # Errors
    /// [`BuildError`] names the part that is missing or wrong.
    pub fn build(mut self, period: f64) -> Result<System, BuildError> {
        let period = self
            .drive
            .map_or(period, |omega| std::f64::consts::TAU / omega);
        if !(period > 0.0 && period.is_finite()) {
            return Err(BuildError::Period(period));
        }
        let scales = self
            .scales
            .iter()
            .position(|s| !(*s >= 0.0 && s.is_finite()) || self.together && *s == 0.0);
        if let Some(state) = scales {
            let scale = self.scales[state];
            return Err(BuildError::Scale { state, scale });
        }
        if let Some(index) = self.coefficients.iter().position(|c| !c.is_finite()) {
            return Err(BuildError::NotFinite {
                index,
                value: self.coefficients[index],
            });
        }
        let mut structure = Structure::new(&Parts {
            states: self.derivative.len(),
            ops: &self.ops,
            derivative: &self.derivative,
            units: &self.units,
            switched: &self.switched,
        })?;
        structure.controlled -= self.quadratures;
        let controlled = structure.controlled;
        structure.drive = self.drive.map(|_| (self.declared, self.declared + 1));
        let mut tables = Vec::new();
        for (slot, unit, values) in &self.switched {
            if self.units[*unit].len() != values.len() {
                return Err(BuildError::Undefined(format!(
                    "a gate of unit {unit} in some mode"
                )));
            }
            if let Some(&value) = values.iter().find(|v| !v.is_finite()) {
                return Err(BuildError::NotFinite {
                    index: *slot,
                    value,
                });
            }
            for (place, &coefficient) in structure.stream.iter().enumerate() {
                if coefficient as usize == *slot {
                    structure.switched.push((place, *unit, tables.len()));
                }
            }
            tables.extend(values);
        }
        Ok(System {
            structure: Arc::new(structure),
            coefficients: std::mem::take(&mut self.coefficients).into(),
            tables: tables.into(),
            scales: self
                .scales
                .iter()
                .copied()
                .chain([1.0; 2])
                .take(controlled)
                .collect(),
            period,
            plan: Arc::new(self),
        })
    }
}
