//! A forced hybrid system as a short straight-line program: the one description from which values,
//! Taylor coefficients and lanes are computed.
//!
//! A state x obeys x' = f(x, cos(Omega t), sin(Omega t)), f being built from sums and products, so
//! that it is polynomial. What can switch is a [`Unit`]: a small automaton whose mode selects some
//! of the coefficients ([`SystemBuilder::gate`]). A mode lasts while each of its guards is positive.

use std::sync::Arc;

use crate::compile::Structure;
use crate::series::Series;

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
    /// Guards that are zero after the switch by construction, with the multiplicity of that zero.
    /// The guard that fired is one of them without being named.
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
    pub(crate) period: f64,
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

    /// Coefficients in force for these modes.
    pub(crate) fn coefficients_in(&self, modes: &[Mode]) -> Vec<f64> {
        let mut out = self.coefficients.to_vec();
        for &(slot, unit, table) in &self.structure.switched {
            out[slot] = self.tables[table + modes[unit]];
        }
        out
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
            coefficients: system.coefficients_in(&modes),
            modes,
            series: Series::new(&system.structure, 0),
            system: system.clone(),
        }
    }

    /// Every node at (modes, x), states first; see [`System::index`].
    pub fn nodes(&mut self, modes: &[Mode], x: &[f64]) -> &[f64] {
        if self.modes != modes {
            self.modes.copy_from_slice(modes);
            self.coefficients = self.system.coefficients_in(modes);
        }
        let structure = &self.system.structure;
        for (i, &value) in x[..structure.states].iter().enumerate() {
            *self.series.value(i) = value;
        }
        crate::series::values(structure, &self.coefficients, &mut self.series);
        self.series.all()
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
    declared: usize,
    drive: Option<f64>,
    quadratures: usize,
    derivative: Vec<Option<Node>>,
    ops: Vec<RawOp>,
    /// Nodes that the operations make.
    nodes: usize,
    coefficients: Vec<f64>,
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
    Dot(Vec<(Node, Node)>),
    Products(Vec<(Node, Node)>),
}

impl RawOp {
    /// How many nodes it makes.
    pub(crate) fn nodes(&self) -> usize {
        match self {
            Self::Linear { .. } | Self::Dot(_) => 1,
            Self::Products(list) => list.len(),
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
        let start = self.coefficients.len();
        for row in rows {
            assert_eq!(row.len(), nodes.len());
            self.coefficients.extend(row);
        }
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
        self.push(RawOp::Dot(pairs.to_vec()))
    }

    /// Many products of two nodes each, none of which may be a factor of another: the same as one
    /// [`Self::dot`] for each, and faster.
    pub fn products(&mut self, pairs: &[(Node, Node)]) -> Vec<Node> {
        let first = self.nodes;
        self.push(RawOp::Products(pairs.to_vec()));
        (first..self.nodes).map(Node::Op).collect()
    }

    /// `node` times a number that depends on the mode of `unit`, one for each mode.
    pub fn gate(&mut self, unit: Unit, by_mode: &[f64], node: Node) -> Node {
        let out = self.linear(0.0, &[(by_mode[0], node)]);
        self.switched
            .push((self.coefficients.len() - 1, unit.0, by_mode.to_vec()));
        out
    }

    /// Sets x' of state `index`.
    pub fn derivative(&mut self, index: usize, value: Node) {
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
    pub fn build(self, period: f64) -> Result<System, BuildError> {
        let period = self
            .drive
            .map_or(period, |omega| std::f64::consts::TAU / omega);
        if !(period > 0.0 && period.is_finite()) {
            return Err(BuildError::Period(period));
        }
        if let Some(index) = self.coefficients.iter().position(|c| !c.is_finite()) {
            return Err(BuildError::NotFinite {
                index,
                value: self.coefficients[index],
            });
        }
        let mut structure = Structure::new(self.derivative.len(), &self.ops)?;
        structure.controlled -= self.quadratures;
        structure.drive = self.drive.map(|_| (self.declared, self.declared + 1));
        structure.derive(&self.derivative)?;
        structure.watch(&self.units)?;
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
            structure.switched.push((*slot, *unit, tables.len()));
            tables.extend(values);
        }
        Ok(System {
            structure: Arc::new(structure),
            coefficients: self.coefficients.into(),
            tables: tables.into(),
            period,
        })
    }
}
