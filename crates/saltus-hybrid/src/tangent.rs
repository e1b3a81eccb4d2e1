//! Variational equations of a program, as more of the same program.
//!
//! A column d of the tangent flow obeys d' = Df(x) d. The derivative of a sum is a sum and that of a product
//! two products, so the equations of any number of columns are appended to a program, operation by
//! operation. The step follows the trajectory and the columns, each held to the tolerance by its own size: a
//! fast oscillation that the trajectory has lost is alive in its tangents. The drive keeps its phase, so a column
//! has as many components as there are declared states.

use std::sync::Arc;

use crate::builder::SystemBuilder;
use crate::program::{BuildError, Node, Operation, Program};
use crate::structure::Tangents;
use crate::system::System;

impl System {
    /// This system with `columns` columns of its tangent flow beside the state; they are read and set
    /// by [`Self::columns`] and [`Self::columns_mut`]. A switch multiplies them by its saltation matrix
    /// (Müller, Chaos, Solitons & Fractals 5 (1995) 1671).
    ///
    /// # Errors
    /// [`BuildError::TooLarge`] for more columns than a program has room for.
    pub fn with_tangents(&self, columns: usize) -> Result<Self, BuildError> {
        let base = &*self.program;
        let mut program = base.clone();
        program.coefficients = self.coefficients.to_vec();
        let (first, size) = (base.derivative.len(), base.declared);
        let none = std::iter::repeat_n(None, columns * size);
        program.derivative.extend(none);
        program.quadratures += columns * size;
        let mut b = SystemBuilder { program };
        for column in 0..columns {
            let at = first + column * size;
            let mut slopes = Slopes::new(&mut b, base, at);
            slopes.all();
            for state in 0..size {
                let rate = base.derivative[state].ok_or(BuildError::NoDerivative(state))?;
                let slope = slopes.node(rate);
                slopes.b.derivative(at + state, slope);
            }
        }
        let mut system = b.build(self.period)?;
        Arc::make_mut(&mut system.structure).tangents = Some(Tangents {
            base: Arc::clone(&self.structure),
            first,
            size,
        });
        Ok(system)
    }

    /// The tangent columns in a state, one after the other, each as long as the list of declared states;
    /// empty for a system without.
    pub fn columns<'a>(&self, x: &'a [f64]) -> &'a [f64] {
        let tangents = self.structure.tangents.as_ref();
        tangents.map_or(&[], |tangents| &x[tangents.first..])
    }

    /// The tangent columns, to be set before a run.
    pub fn columns_mut<'a>(&self, x: &'a mut [f64]) -> &'a mut [f64] {
        let tangents = self.structure.tangents.as_ref();
        tangents.map_or(&mut [], |tangents| &mut x[tangents.first..])
    }

    /// The system without tangents.
    pub(crate) fn base(&self) -> Self {
        let mut base = self.clone();
        if let Some(tangents) = &self.structure.tangents {
            base.structure = Arc::clone(&tangents.base);
        }
        base
    }
}

/// The derivative of a node along a column: a sum of scaled nodes, empty where it vanishes.
type Slope = Vec<(f64, Node)>;

/// One column on its way through the program.
struct Slopes<'a> {
    b: &'a mut SystemBuilder,
    program: &'a Program,
    states: Vec<Slope>,
    ops: Vec<Slope>,
}

impl<'a> Slopes<'a> {
    /// A column whose states begin at `first`.
    fn new(b: &'a mut SystemBuilder, program: &'a Program, first: usize) -> Self {
        let mut states = vec![Slope::new(); program.derivative.len()];
        for (i, slope) in states[..program.declared].iter_mut().enumerate() {
            slope.push((1.0, Node::State(first + i)));
        }
        Self {
            b,
            program,
            states,
            ops: Vec::with_capacity(program.nodes),
        }
    }

    fn of(&self, node: Node) -> Slope {
        match node {
            Node::State(i) => self.states[i].clone(),
            Node::Op(i) => self.ops[i].clone(),
        }
    }

    fn of_all(&self, nodes: &[Node]) -> Vec<Slope> {
        nodes.iter().map(|&node| self.of(node)).collect()
    }

    /// The slope of a node as a node.
    fn node(&mut self, node: Node) -> Node {
        match self.of(node)[..] {
            [(1.0, node)] => node,
            ref terms => self.b.linear(0.0, terms),
        }
    }

    /// Differentiates the whole program.
    fn all(&mut self) {
        let mut reserved = None;
        for op in &self.program.operations {
            let slopes = match op {
                Operation::Linear { constant, terms } => vec![self.sum(*constant, terms)],
                Operation::Matrix { weights, nodes } => {
                    let rows = self.b.program.matrix(*weights, nodes.len());
                    let slopes = self.of_all(nodes);
                    self.times(&rows, &slopes)
                }
                Operation::Squares(nodes) => {
                    let slopes = self.of_all(nodes);
                    self.squares(nodes, &slopes)
                }
                Operation::Products(pairs) => {
                    let there = pairs.iter().map(|&(a, b)| (a, self.of(b)));
                    let back = pairs.iter().map(|&(a, b)| (b, self.of(a)));
                    let both = there.chain(back).collect::<Vec<_>>();
                    halves(self.products(&both))
                }
                Operation::Cubic { y, added, .. } => self.cubic(op, y, added),
                Operation::Quotient {
                    dividend, divisor, ..
                } => {
                    vec![self.quotient(*dividend, *divisor)]
                }
                Operation::Power { base, exponent, .. } => vec![self.power(*base, *exponent)],
                Operation::Function {
                    of, slope, minus, ..
                } => {
                    let sign = if *minus { -1.0 } else { 1.0 };
                    let along = self.of(*of);
                    vec![self.times_node(*slope, along, sign)]
                }
                Operation::Adiabatic { count, .. } => {
                    reserved = Some((op, self.b.program.operations.len()));
                    let nodes = self.b.append_adiabatic(*count);
                    nodes.into_iter().map(|node| vec![(1.0, node)]).collect()
                }
            };
            self.ops.extend(slopes);
        }
        if let Some((op, place)) = reserved {
            self.define_adiabatic(op, place);
        }
    }

    /// Differentiates a sum, whose coefficients may depend on modes.
    fn sum(&mut self, constant: usize, terms: &[Node]) -> Slope {
        let terms: Vec<(usize, f64, Node)> = terms
            .iter()
            .zip(constant + 1..)
            .flat_map(|(&term, place)| self.of(term).into_iter().map(move |(c, n)| (place, c, n)))
            .collect();
        if terms.is_empty() {
            return Slope::new();
        }
        let weights = terms
            .iter()
            .map(|&(place, c, node)| (c * self.b.program.coefficients[place], node));
        let weights: Vec<_> = weights.collect();
        let first = self.b.program.coefficients.len() + 1;
        let out = self.b.linear(0.0, &weights);
        for (to, (place, factor, _)) in (first..).zip(&terms) {
            self.b.switch_likewise(*place, to, *factor);
        }
        vec![(1.0, out)]
    }

    /// Differentiates a matrix times nodes.
    fn times(&mut self, rows: &[Vec<f64>], slopes: &[Slope]) -> Vec<Slope> {
        let there: Vec<(usize, (f64, Node))> = slopes
            .iter()
            .enumerate()
            .filter_map(|(i, slope)| Some((i, self.one(slope)?)))
            .collect();
        if there.is_empty() {
            return vec![Slope::new(); rows.len()];
        }
        let nodes: Vec<Node> = there.iter().map(|&(_, (_, node))| node).collect();
        let row = |row: &Vec<f64>| there.iter().map(|&(i, (c, _))| c * row[i]).collect();
        let rows: Vec<Vec<f64>> = rows.iter().map(row).collect();
        let out = self.b.matrix(&nodes, &rows);
        out.into_iter().map(|node| vec![(1.0, node)]).collect()
    }

    /// Node times slope.
    fn products(&mut self, pairs: &[(Node, Slope)]) -> Vec<Slope> {
        let scaled: Vec<_> = pairs.iter().map(|(_, slope)| self.one(slope)).collect();
        let factors = pairs.iter().zip(&scaled);
        let factors: Vec<_> = factors
            .filter_map(|(&(x, _), scaled)| Some((x, scaled.as_ref()?.1)))
            .collect();
        let mut products = self.b.products(&factors).into_iter();
        let product = |scaled: Option<(f64, Node)>| Some((scaled?.0, products.next()?));
        scaled
            .into_iter()
            .map(product)
            .map(|term| term.into_iter().collect())
            .collect()
    }

    /// Node times slope times a number.
    fn times_node(&mut self, node: Node, slope: Slope, by: f64) -> Slope {
        let product = self.products(&[(node, slope)]).remove(0);
        product
            .into_iter()
            .map(|(c, node)| (by * c, node))
            .collect()
    }

    /// q = a/b: dq = (da - q db)/b.
    fn quotient(&mut self, a: Node, b: Node) -> Slope {
        let q = Node::Op(self.ops.len());
        let mut slope = self.of(a);
        let db = self.of(b);
        slope.extend(self.times_node(q, db, -1.0));
        match self.one(&slope) {
            Some((c, node)) => vec![(c, self.b.quotient(node, b))],
            None => Slope::new(),
        }
    }

    /// p = u^a: dp = a u^(a - 1) du.
    fn power(&mut self, base: Node, exponent: usize) -> Slope {
        let along = self.of(base);
        if along.is_empty() {
            return along;
        }
        let exponent = self.b.program.coefficients[exponent];
        let slope = self.b.power(base, exponent - 1.0);
        self.times_node(slope, along, exponent)
    }

    fn squares(&mut self, y: &[Node], slopes: &[Slope]) -> Vec<Slope> {
        let pairs: Vec<_> = y.iter().copied().zip(slopes.iter().cloned()).collect();
        let twice = |half: Slope| half.iter().map(|&(c, node)| (2.0 * c, node)).collect();
        self.products(&pairs).into_iter().map(twice).collect()
    }

    /// q = y^2, t = A q + added, p = y t: dq = 2 y dy, dt = A dq + d(added), dp = y dt + t dy.
    fn cubic(&mut self, op: &Operation, y: &[Node], added: &[Node]) -> Vec<Slope> {
        let a = self.b.program.cubic_matrix(op);
        let first = self.ops.len();
        let q: Vec<Node> = (first..first + y.len()).map(Node::Op).collect();
        // t itself is no node of the program
        let mut t: Vec<Slope> = self
            .b
            .matrix(&q, &a)
            .into_iter()
            .map(|t| vec![(1.0, t)])
            .collect();
        t.iter_mut()
            .zip(added)
            .for_each(|(t, &more)| t.push((1.0, more)));
        let t: Vec<Node> = t.iter().filter_map(|t| Some(self.one(t)?.1)).collect();
        let dy = self.of_all(y);
        let dq = self.squares(y, &dy);
        let mut dt = self.times(&a, &dq);
        for (dt, &more) in dt.iter_mut().zip(added) {
            dt.extend(self.of(more));
        }
        let pairs = y.iter().copied().zip(dt).chain(t.into_iter().zip(dy));
        let pairs: Vec<_> = pairs.collect();
        let dp = halves(self.products(&pairs));
        let hidden = vec![Slope::new(); y.len()];
        [dq, dp, hidden].concat()
    }

    /// The slope as one node with a factor; `None` where it vanishes.
    fn one(&mut self, slope: &Slope) -> Option<(f64, Node)> {
        match slope[..] {
            [] => None,
            [term] => Some(term),
            ref terms => Some((1.0, self.b.linear(0.0, terms))),
        }
    }

    /// The sources of adiabatic nodes, which come later in the program than these.
    fn define_adiabatic(&mut self, op: &Operation, place: usize) {
        let Operation::Adiabatic { sources, .. } = op else {
            return;
        };
        let slopes = self.of_all(sources);
        let slopes: Vec<Node> = slopes.iter().map(|s| self.b.linear(0.0, s)).collect();
        let mut op = op.clone();
        if let Operation::Adiabatic { sources, .. } = &mut op {
            *sources = slopes;
        }
        self.b.program.operations[place] = op;
    }
}

/// Adds the second half of a list to the first.
fn halves(mut slopes: Vec<Slope>) -> Vec<Slope> {
    let back = slopes.split_off(slopes.len() / 2);
    slopes.iter_mut().zip(back).for_each(|(a, b)| a.extend(b));
    slopes
}
