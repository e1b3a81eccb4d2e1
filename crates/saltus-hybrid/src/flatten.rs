//! The operations of a program with flat indices, and the slots in which their results are kept.

use std::slice;

use crate::function::Function;
use crate::program::{BuildError, Node, Operation};
use crate::structure::Place;

/// Slots of the nodes that keep all their orders: factors of products side by side, as the products
/// are listed, then states and guards that are no factors.
pub(crate) struct Slots {
    pub(crate) count: usize,
    /// Slots of each node.
    pub(crate) of: Vec<Vec<u32>>,
    /// Factor lists that have neighbouring slots.
    blocks: Vec<(Vec<u16>, usize)>,
    /// Whether a sum, a derivative, or anything but a product reads the node.
    is_read: Vec<bool>,
}

impl Slots {
    pub(crate) fn new(flat: &Flattener, guards: &[usize], derivative: &[usize]) -> Self {
        let mut slots = Self {
            count: 0,
            of: vec![Vec::new(); flat.nodes],
            blocks: Vec::new(),
            is_read: vec![false; flat.nodes],
        };
        for op in &flat.ops {
            match &op.kind {
                Kind::Linear { terms: nodes, .. } | Kind::Matrix { nodes, .. } => {
                    nodes
                        .iter()
                        .for_each(|&node| slots.is_read[node as usize] = true);
                }
                Kind::Squares(factors) => slots.add(factors),
                Kind::Products(first, second) => {
                    slots.add(first);
                    slots.add(second);
                }
                Kind::Cubic(cubic) => {
                    slots.add(&cubic.y);
                    slots.add(&cubic.t);
                }
                Kind::Adiabatic(all) => {
                    slots.add(&all.x);
                    slots.add(&all.sources);
                }
                Kind::Quotient {
                    dividend, divisor, ..
                } => {
                    slots.is_read[*dividend as usize] = true;
                    slots.add(&[*divisor]);
                    slots.add(&[op.out as u16]);
                }
                Kind::Power { base, .. } => {
                    slots.add(&[*base]);
                    slots.add(&[op.out as u16]);
                }
                Kind::Function { of, slope, .. } => {
                    slots.add(&[*of]);
                    slots.add(&[*slope]);
                }
            }
        }
        for &node in derivative {
            slots.is_read[node] = true;
        }
        for node in (0..flat.states).chain(guards.iter().copied()) {
            slots.is_read[node] = true;
            if slots.of[node].is_empty() {
                slots.add(&[node as u16]);
            }
        }
        slots
    }

    /// Neighbouring slots for these nodes, unless they have such.
    fn add(&mut self, nodes: &[u16]) {
        if self.blocks.iter().any(|(known, _)| known == nodes) {
            return;
        }
        self.blocks.push((nodes.to_vec(), self.count));
        for &node in nodes {
            self.of[node as usize].push(self.count as u32);
            self.count += 1;
        }
    }

    /// The first slot of a list that was added.
    pub(crate) fn block(&self, nodes: &[u16]) -> usize {
        let known = self.blocks.iter().find(|(known, _)| known == nodes);
        known.map_or(usize::MAX, |(_, slot)| *slot)
    }

    /// A slot of a node that has one.
    pub(crate) fn first(&self, node: usize) -> usize {
        self.of[node][0] as usize
    }

    pub(crate) fn is_kept_only(&self, node: usize) -> bool {
        !self.is_read[node] && self.of[node].len() == 1
    }

    /// Place of the results of an operation.
    pub(crate) fn place(&self, op: &FlatOp) -> Place {
        let may = matches!(op.kind, Kind::Linear { .. } | Kind::Matrix { .. });
        let nodes = op.out..op.out + op.count;
        let neighbours = |(i, node): (usize, usize)| {
            self.is_kept_only(node) && self.first(node) == self.first(op.out) + i
        };
        if may && nodes.enumerate().all(neighbours) {
            Place::Kept(self.first(op.out))
        } else {
            Place::Now(op.out)
        }
    }
}

/// An operation with flat indices.
pub(crate) struct FlatOp {
    pub(crate) out: usize,
    pub(crate) count: usize,
    pub(crate) kind: Kind,
}

pub(crate) enum Kind {
    Linear {
        constant: usize,
        terms: Vec<u16>,
    },
    Matrix {
        weights: (usize, usize),
        nodes: Vec<u16>,
    },
    Squares(Vec<u16>),
    Products(Vec<u16>, Vec<u16>),
    Adiabatic(Followers),
    Cubic(Gradient),
    Quotient {
        dividend: u16,
        divisor: u16,
        active: usize,
    },
    Power {
        base: u16,
        exponent: usize,
        active: usize,
    },
    Function {
        function: Function,
        minus: bool,
        of: u16,
        slope: u16,
        active: usize,
    },
}

/// Nodes that follow others adiabatically.
pub(crate) struct Followers {
    pub(crate) x: Vec<u16>,
    pub(crate) sources: Vec<u16>,
    pub(crate) damping: usize,
    pub(crate) responses: Vec<usize>,
}

/// The gradient of a quartic form in squares.
pub(crate) struct Gradient {
    pub(crate) y: Vec<u16>,
    /// Nodes that stand for t; they live in their slots only.
    pub(crate) t: Vec<u16>,
    pub(crate) added: Vec<u16>,
    pub(crate) heads: usize,
    pub(crate) weights: usize,
    pub(crate) extra: Vec<(usize, usize, usize)>,
}

impl Kind {
    /// Nodes at the end of its output that are never in hand.
    pub(crate) fn hidden(&self) -> usize {
        match self {
            Self::Cubic(cubic) => cubic.t.len(),
            _ => 0,
        }
    }
}

/// Numbers nodes in the order of the program.
pub(crate) struct Flattener {
    states: usize,
    pub(crate) nodes: usize,
    pub(crate) ops: Vec<FlatOp>,
}

impl Flattener {
    pub(crate) fn new(states: usize) -> Self {
        Self {
            states,
            nodes: states,
            ops: Vec::new(),
        }
    }

    /// Flat index of a node defined so far.
    pub(crate) fn index(&self, node: Node) -> Result<usize, BuildError> {
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

    /// Flat index of a node that may come later.
    fn ahead(&self, node: Node) -> u16 {
        match node {
            Node::State(i) => i as u16,
            Node::Op(i) => (self.states + i) as u16,
        }
    }

    fn indices<'a>(
        &self,
        nodes: impl IntoIterator<Item = &'a Node>,
    ) -> Result<Vec<u16>, BuildError> {
        nodes
            .into_iter()
            .map(|&node| self.index(node).map(|i| i as u16))
            .collect()
    }

    pub(crate) fn push(&mut self, op: &Operation) -> Result<(), BuildError> {
        let kind = match op {
            Operation::Linear { constant, terms } => Kind::Linear {
                constant: *constant,
                terms: self.indices(terms)?,
            },
            Operation::Matrix { weights, nodes } => Kind::Matrix {
                weights: *weights,
                nodes: self.indices(nodes)?,
            },
            Operation::Squares(list) => Kind::Squares(self.indices(list)?),
            Operation::Products(list) => Kind::Products(
                self.indices(list.iter().map(|(a, _)| a))?,
                self.indices(list.iter().map(|(_, b)| b))?,
            ),
            Operation::Adiabatic {
                count,
                sources,
                damping,
                responses,
            } => Kind::Adiabatic(Followers {
                x: (self.nodes..self.nodes + count).map(|i| i as u16).collect(),
                // They come later in the program: their derivatives are those of the last round.
                sources: sources.iter().map(|&node| self.ahead(node)).collect(),
                damping: *damping,
                responses: responses.clone(),
            }),
            Operation::Cubic {
                y,
                added,
                heads,
                weights,
                extra,
            } => {
                let first = self.nodes + 2 * y.len();
                Kind::Cubic(Gradient {
                    y: self.indices(y)?,
                    t: (first..first + y.len()).map(|i| i as u16).collect(),
                    added: self.indices(added)?,
                    heads: *heads,
                    weights: *weights,
                    extra: extra.clone(),
                })
            }
            Operation::Quotient {
                dividend,
                divisor,
                active,
            } => Kind::Quotient {
                dividend: self.index(*dividend)? as u16,
                divisor: self.index(*divisor)? as u16,
                active: *active,
            },
            Operation::Power {
                base,
                exponent,
                active,
            } => Kind::Power {
                base: self.index(*base)? as u16,
                exponent: *exponent,
                active: *active,
            },
            Operation::Function {
                function,
                of,
                slope,
                minus,
                active,
            } => Kind::Function {
                function: *function,
                minus: *minus,
                of: self.index(*of)? as u16,
                // Orders below that of the result are enough of it.
                slope: self.ahead(*slope),
                active: *active,
            },
        };
        let (out, count) = (self.nodes, op.nodes());
        self.nodes += count;
        if count > 0 {
            self.ops.push(FlatOp { out, count, kind });
        }
        Ok(())
    }

    /// Whether these nodes depend on each operation.
    pub(crate) fn needed_by(&self, guards: &[usize]) -> Vec<bool> {
        self.cone(guards).0
    }

    /// Whether a node is no polynomial of the states.
    pub(crate) fn is_curved(&self, node: usize) -> bool {
        let (needed, _) = self.cone(&[node]);
        let mut ops = needed.into_iter().zip(&self.ops);
        ops.any(|(needed, op)| {
            let kind = &op.kind;
            let own = matches!(
                kind,
                Kind::Quotient { .. } | Kind::Power { .. } | Kind::Function { .. }
            );
            needed && own
        })
    }

    /// States that a node depends on, and the ranges of coefficients of its sums; `None` if it depends on derivatives.
    pub(crate) fn made_of(
        &self,
        node: usize,
    ) -> Option<(Vec<usize>, Vec<std::ops::RangeInclusive<usize>>)> {
        let (needed, nodes) = self.cone(&[node]);
        let mut coefficients = Vec::new();
        for (_, op) in needed.iter().zip(&self.ops).filter(|(needed, _)| **needed) {
            match &op.kind {
                Kind::Linear { constant, terms } => {
                    coefficients.push(*constant..=constant + terms.len());
                }
                // It depends on derivatives.
                Kind::Adiabatic(_) => return None,
                _ => {}
            }
        }
        let states = (0..self.states).filter(|&state| nodes[state]).collect();
        Some((states, coefficients))
    }

    /// Operations and nodes that these nodes depend on.
    fn cone(&self, of: &[usize]) -> (Vec<bool>, Vec<bool>) {
        let mut nodes = vec![false; self.nodes];
        of.iter().for_each(|&node| nodes[node] = true);
        let mut needed = vec![false; self.ops.len()];
        for (needed, op) in needed.iter_mut().zip(&self.ops).rev() {
            *needed = nodes[op.out..op.out + op.count].contains(&true);
            if *needed {
                let inputs: [&[u16]; 2] = match &op.kind {
                    Kind::Linear { terms, .. } => [terms, &[]],
                    Kind::Matrix { nodes, .. } => [nodes, &[]],
                    Kind::Squares(factors) => [factors, &[]],
                    Kind::Products(first, second) => [first, second],
                    Kind::Cubic(cubic) => [&cubic.y, &cubic.added],
                    Kind::Adiabatic(_) => [&[], &[]],
                    Kind::Quotient {
                        dividend, divisor, ..
                    } => [slice::from_ref(dividend), slice::from_ref(divisor)],
                    Kind::Power { base, .. } => [slice::from_ref(base), &[]],
                    Kind::Function { of, .. } => [slice::from_ref(of), &[]],
                };
                for &input in inputs.into_iter().flatten() {
                    nodes[input as usize] = true;
                }
            }
        }
        (needed, nodes)
    }
}
