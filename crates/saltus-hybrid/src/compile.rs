//! From a builder's parts to the flat program that the series code runs.

use crate::system::{BuildError, Node, RawOp, Transition};

/// One step of the program. Nodes are flat indices: states first, then operations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Op {
    /// out = c + sum of coefficient times node; the constant's coefficient is followed by those of
    /// the terms.
    Linear {
        out: usize,
        constant: usize,
        terms: (usize, usize),
    },
    /// out, out + 1, ... = rows of a matrix times the same nodes; `weights` are coefficients by rows.
    Matrix {
        out: usize,
        weights: (usize, usize),
        nodes: (usize, usize),
    },
    /// out = sum of products.
    Dot { out: usize, pairs: (usize, usize) },
    /// out, out + 1, ... = one product each.
    Products { out: usize, pairs: (usize, usize) },
    /// Keeps the node's coefficients in reverse as well: it is the second factor of a product.
    Mirror { mirror: usize, node: usize },
}

/// A transition with everything resolved to indices.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Watch {
    /// Place in [`Structure::guards`].
    pub(crate) guard: usize,
    pub(crate) sign: f64,
    pub(crate) to: usize,
    pub(crate) resets: Vec<(usize, usize)>,
    pub(crate) vanishing: Vec<(usize, u8)>,
}

/// The program without its numbers: shared by all members of an ensemble.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Structure {
    pub(crate) states: usize,
    pub(crate) nodes: usize,
    /// States that take part in error control: all but the quadratures, which come last.
    pub(crate) controlled: usize,
    pub(crate) ops: Vec<Op>,
    /// Nodes of the terms of all linear operations.
    pub(crate) terms: Vec<usize>,
    /// (node, mirror) of all products.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// Nodes that are second factors.
    pub(crate) mirrors: Vec<usize>,
    /// Flat node index of each state's derivative.
    pub(crate) derivative: Vec<usize>,
    /// Flat node indices of all guards.
    pub(crate) guards: Vec<usize>,
    /// The program's steps that the guards need, in order.
    pub(crate) guard_ops: Vec<usize>,
    /// Transitions of each mode of each unit.
    pub(crate) units: Vec<Vec<Vec<Watch>>>,
    /// (coefficient, unit, offset of its table in `Values::tables`).
    pub(crate) switched: Vec<(usize, usize, usize)>,
    /// States that hold cos and sin of the drive, if it is driven.
    pub(crate) drive: Option<(usize, usize)>,
}

impl Watch {
    /// Flat node index of the guard.
    pub(crate) fn guard_node(&self, structure: &Structure) -> usize {
        structure.guards[self.guard]
    }
}

impl Structure {
    /// A program of `states` states and these operations.
    pub(crate) fn new(states: usize, raw: &[RawOp]) -> Result<Self, BuildError> {
        let mut out = Self {
            states,
            nodes: states,
            controlled: states,
            ..Self::default()
        };
        for op in raw {
            match op {
                RawOp::Linear { constant, terms } => {
                    let start = out.terms.len();
                    for &node in terms {
                        let node = out.flat(node)?;
                        out.terms.push(node);
                    }
                    let terms = (start, out.terms.len());
                    out.ops.push(Op::Linear {
                        out: out.nodes,
                        constant: *constant,
                        terms,
                    });
                    out.nodes += 1;
                }
                RawOp::Matrix { weights, nodes } => {
                    let start = out.terms.len();
                    for &node in nodes {
                        let node = out.flat(node)?;
                        out.terms.push(node);
                    }
                    let rows = op.nodes();
                    let nodes = (start, out.terms.len());
                    out.ops.push(Op::Matrix {
                        out: out.nodes,
                        weights: *weights,
                        nodes,
                    });
                    out.nodes += rows;
                }
                RawOp::Dot(list) => {
                    let pairs = out.multiply(list)?;
                    out.ops.push(Op::Dot {
                        out: out.nodes,
                        pairs,
                    });
                    out.nodes += 1;
                }
                RawOp::Products(list) => {
                    let pairs = out.multiply(list)?;
                    out.ops.push(Op::Products {
                        out: out.nodes,
                        pairs,
                    });
                    out.nodes += list.len();
                }
            }
        }
        Ok(out)
    }

    /// Flat index of a node defined so far.
    fn flat(&self, node: Node) -> Result<usize, BuildError> {
        let index = match node {
            Node::State(i) if i < self.states => i,
            Node::Op(i) => self.states + i,
            Node::State(_) => usize::MAX,
        };
        let known = index < self.nodes;
        known
            .then_some(index)
            .ok_or_else(|| BuildError::Undefined(format!("{node:?}")))
    }

    /// Appends products, mirroring second factors that have no mirror yet.
    fn multiply(&mut self, list: &[(Node, Node)]) -> Result<(usize, usize), BuildError> {
        let start = self.pairs.len();
        for &(a, b) in list {
            let (a, b) = (self.flat(a)?, self.flat(b)?);
            let mirror = self
                .mirrors
                .iter()
                .position(|&m| m == b)
                .unwrap_or_else(|| {
                    self.mirrors.push(b);
                    let mirror = self.mirrors.len() - 1;
                    self.ops.push(Op::Mirror { mirror, node: b });
                    mirror
                });
            self.pairs.push((a, mirror));
        }
        Ok((start, self.pairs.len()))
    }

    /// Sets the derivatives of all states.
    pub(crate) fn derive(&mut self, derivative: &[Option<Node>]) -> Result<(), BuildError> {
        for (i, node) in derivative.iter().enumerate() {
            let node = self.flat(node.ok_or(BuildError::NoDerivative(i))?)?;
            self.derivative.push(node);
        }
        Ok(())
    }

    /// Resolves the transitions of all units, and finds out what their guards need.
    pub(crate) fn watch(&mut self, units: &[Vec<Vec<Transition>>]) -> Result<(), BuildError> {
        for modes in units {
            let mut resolved = Vec::new();
            for transitions in modes {
                let watches: Result<Vec<_>, _> = transitions
                    .iter()
                    .map(|t| self.resolve(t, modes.len()))
                    .collect();
                resolved.push(watches?);
            }
            self.units.push(resolved);
        }
        self.guard_ops = self.needed_by_guards();
        Ok(())
    }

    fn guard(&mut self, node: Node) -> Result<usize, BuildError> {
        let node = self.flat(node)?;
        Ok(self
            .guards
            .iter()
            .position(|&g| g == node)
            .unwrap_or_else(|| {
                self.guards.push(node);
                self.guards.len() - 1
            }))
    }

    fn resolve(&mut self, t: &Transition, modes: usize) -> Result<Watch, BuildError> {
        if t.to >= modes {
            return Err(BuildError::Undefined(format!("mode {}", t.to)));
        }
        let guard = self.guard(t.guard)?;
        let mut vanishing = vec![(guard, 1)];
        for &(node, multiplicity) in &t.vanishing {
            vanishing.push((self.guard(node)?, multiplicity));
        }
        let mut resets = Vec::new();
        for &(state, value) in &t.resets {
            resets.push((self.flat(Node::State(state))?, self.flat(value)?));
        }
        Ok(Watch {
            guard,
            sign: t.sign,
            to: t.to,
            resets,
            vanishing,
        })
    }

    /// Steps that the guards depend on, in program order.
    fn needed_by_guards(&self) -> Vec<usize> {
        let mut nodes = vec![false; self.nodes];
        let mut mirrors = vec![false; self.mirrors.len()];
        self.guards.iter().for_each(|&g| nodes[g] = true);
        let mut needed = Vec::new();
        for (index, op) in self.ops.iter().enumerate().rev() {
            let (is_needed, terms, pairs) = match op {
                Op::Linear { out, terms, .. } => (nodes[*out], *terms, (0, 0)),
                Op::Matrix {
                    out,
                    weights,
                    nodes: columns,
                } => {
                    let rows = (weights.1 - weights.0) / (columns.1 - columns.0);
                    (nodes[*out..*out + rows].contains(&true), *columns, (0, 0))
                }
                Op::Dot { out, pairs } => (nodes[*out], (0, 0), *pairs),
                Op::Products { out, pairs } => (
                    nodes[*out..*out + pairs.1 - pairs.0].contains(&true),
                    (0, 0),
                    *pairs,
                ),
                Op::Mirror { mirror, node } => {
                    nodes[*node] |= mirrors[*mirror];
                    (mirrors[*mirror], (0, 0), (0, 0))
                }
            };
            if is_needed {
                needed.push(index);
                self.terms[terms.0..terms.1]
                    .iter()
                    .for_each(|&node| nodes[node] = true);
                for &(node, mirror) in &self.pairs[pairs.0..pairs.1] {
                    nodes[node] = true;
                    mirrors[mirror] = true;
                }
            }
        }
        needed.reverse();
        needed
    }
}
