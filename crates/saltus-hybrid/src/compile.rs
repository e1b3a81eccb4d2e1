//! From a builder's parts to the flat program that the series code runs.

use crate::adiabatic::Adiabatic;
use crate::flatten::{Flattener, Kind, Slots};
use crate::system::{BuildError, Node, RawOp, Transition};
use crate::tangent::Tangents;

/// What a step of the program computes. Nodes are flat indices: states first, then operations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    /// Some groups of [`Structure::groups`], one after the other.
    Linear { groups: (usize, usize) },
    /// Rows of a matrix times the same nodes (in [`Structure::terms`]). The weights are in the stream,
    /// by fours of rows and the rest; within these, node by node.
    Matrix {
        out: Place,
        rows: usize,
        weights: usize,
        nodes: (usize, usize),
    },
    /// Squares of neighbours from this slot on.
    Squares {
        out: usize,
        count: usize,
        factor: usize,
    },
    /// Products of neighbours from one slot on with those from another on.
    Products {
        out: usize,
        count: usize,
        factors: [usize; 2],
    },
    /// Nodes that were computed in all orders beforehand, from these slots on.
    Recall {
        out: usize,
        slot: usize,
        count: usize,
    },
    /// Squares q of neighbours y, t = A q + added, and products y t: see `Structure::cubics`.
    Cubic(usize),
}

/// A [`Op::Cubic`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cubic {
    /// First of the `count` nodes for the squares; those for the products follow.
    pub(crate) out: usize,
    pub(crate) count: usize,
    /// First slots of y and t.
    pub(crate) y: usize,
    pub(crate) t: usize,
    /// First of `count` nodes to add to A q, if there are any.
    pub(crate) added: Option<usize>,
    /// A is zero outside its first `heads` rows and columns, but for `extra`.
    pub(crate) heads: usize,
    /// Begin in the stream: the first rows, then the other rows up to column `heads`; both by fours.
    pub(crate) weights: usize,
    /// (row, column, place in the stream).
    pub(crate) extra: Vec<(usize, usize, usize)>,
}

/// Where the results of an operation go, one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// To nodes, for the order in hand only (and from there to the slots in [`Step::keeps`]).
    Now(usize),
    /// To slots at once: nothing but products reads them.
    Kept(usize),
}

/// Sums c + sum of coefficient times node with equally many terms, which do not depend on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Group {
    /// Where the first goes; the others follow.
    pub(crate) out: Place,
    /// How many, at most [`GROUP`].
    pub(crate) width: usize,
    pub(crate) terms: usize,
    /// Begin in the stream: `width` constants, then for each term `width` coefficients.
    pub(crate) weights: usize,
    /// Begin in [`Structure::terms`]: for each term `width` nodes.
    pub(crate) nodes: usize,
}

/// Most sums in a group.
pub(crate) const GROUP: usize = 4;

/// One step of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) op: Op,
    /// Which of its nodes to keep, a range of [`Structure::keeps`].
    pub(crate) keeps: (usize, usize),
}

/// A transition with everything resolved to indices.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Watch {
    /// Place in [`Structure::guards`].
    pub(crate) guard: usize,
    pub(crate) sign: f64,
    pub(crate) to: usize,
    pub(crate) resets: Vec<(usize, usize)>,
    /// Guards that are zero after it by construction.
    pub(crate) vanishing: Vec<(usize, u8)>,
    /// Guards that it may move, by a reset or by the change of mode.
    pub(crate) moved: Vec<usize>,
}

impl Watch {
    /// Slot of the guard's coefficients.
    pub(crate) fn guard_slot(&self, structure: &Structure) -> usize {
        structure.guard_slots[self.guard]
    }
}

/// The program without its numbers: shared by all members of an ensemble.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Structure {
    pub(crate) states: usize,
    pub(crate) nodes: usize,
    /// Cells in an order: nodes of which all orders are kept, some of them twice.
    pub(crate) slots: usize,
    /// States that take part in error control: all but the quadratures, which come last.
    pub(crate) controlled: usize,
    /// The whole program, and the part of it that the guards need.
    pub(crate) program: Vec<Step>,
    pub(crate) guard_program: Vec<Step>,
    pub(crate) groups: Vec<Group>,
    /// Coefficients in the order in which the programs read them.
    pub(crate) stream: Vec<u32>,
    /// Nodes of the terms of all sums.
    pub(crate) terms: Vec<u16>,
    pub(crate) cubics: Vec<Cubic>,
    /// What follows the rest adiabatically, if anything does; several with tangents.
    pub(crate) adiabatic: Vec<Adiabatic>,
    /// (node, slot) of what each step keeps.
    pub(crate) keeps: Vec<(u32, u32)>,
    /// (node, slot) of the nodes that are in a slot only.
    pub(crate) kept_only: Vec<(u32, u32)>,
    /// Flat node index of each state's derivative.
    pub(crate) derivative: Vec<usize>,
    /// The same, with the state's slot.
    pub(crate) rates: Vec<Rate>,
    /// A slot of each state.
    pub(crate) state_slots: Vec<usize>,
    /// (state, slot) of the states that have a second slot.
    pub(crate) state_copies: Vec<(usize, usize)>,
    /// Flat node indices of all guards.
    pub(crate) guards: Vec<usize>,
    /// Their slots.
    pub(crate) guard_slots: Vec<usize>,
    /// Transitions of each mode of each unit.
    pub(crate) units: Vec<Vec<Vec<Watch>>>,
    /// (place in the stream, unit, offset of its table in `System::tables`).
    pub(crate) switched: Vec<(usize, usize, usize)>,
    /// States that hold cos and sin of the drive, if it is driven.
    pub(crate) drive: Option<(usize, usize)>,
    /// Columns of the tangent flow, if it has any.
    pub(crate) tangents: Option<Tangents>,
}

/// How a state moves on: the node that is its rate, and its slot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rate {
    pub(crate) node: u16,
    pub(crate) slot: u16,
}

/// Nodes that an index can name.
pub(crate) const MAX_NODES: usize = 1 << 16;

/// What the builder collected.
pub(crate) struct Parts<'a> {
    pub(crate) states: usize,
    pub(crate) ops: &'a [RawOp],
    pub(crate) derivative: &'a [Option<Node>],
    pub(crate) units: &'a [Vec<Vec<Transition>>],
    /// Coefficients that depend on modes, each with its unit and the value for each mode.
    pub(crate) switched: &'a [(usize, usize, Vec<f64>)],
}

impl Structure {
    /// The program of these parts.
    pub(crate) fn new(parts: &Parts<'_>) -> Result<Self, BuildError> {
        let mut flat = Flattener::new(parts.states);
        for op in parts.ops {
            flat.push(op)?;
        }
        if flat.nodes > MAX_NODES {
            return Err(BuildError::TooLarge(flat.nodes));
        }
        let mut out = Self {
            states: parts.states,
            nodes: flat.nodes,
            controlled: parts.states,
            ..Self::default()
        };
        for (i, node) in parts.derivative.iter().enumerate() {
            let node = node.ok_or(BuildError::NoDerivative(i))?;
            out.derivative.push(flat.index(node)?);
        }
        for modes in parts.units {
            let mut resolved = Vec::new();
            for transitions in modes {
                let watches: Result<Vec<_>, _> = transitions
                    .iter()
                    .map(|t| out.resolve(&flat, t, modes.len()))
                    .collect();
                resolved.push(watches?);
            }
            out.units.push(resolved);
        }
        out.say_what_moves(&flat, parts.switched);
        let slots = Slots::new(&flat, &out.guards, &out.derivative);
        out.slots = slots.count;
        out.guard_slots = out.guards.iter().map(|&g| slots.first(g)).collect();
        out.state_slots = (0..out.states).map(|s| slots.first(s)).collect();
        let rate = |(&node, &slot): (&usize, &usize)| Rate {
            node: node as u16,
            slot: slot as u16,
        };
        let rates = out.derivative.iter().zip(&out.state_slots).map(rate);
        out.rates = rates.collect();
        let copies = |s: usize| slots.of[s][1..].iter().map(move |&slot| (s, slot as usize));
        out.state_copies = (0..out.states).flat_map(copies).collect();
        let needed = flat.needed_by(&out.guards);
        out.program = out.assemble(&flat, &slots, |_| true);
        out.guard_program = out.assemble(&flat, &slots, |op| needed[op]);
        out.kept_only = (0..out.nodes)
            .filter(|&node| slots.is_kept_only(node))
            .map(|node| (node as u32, slots.of[node][0]))
            .collect();
        Ok(out)
    }

    /// Tells each transition the guards it may move. `switched` are coefficients that depend on modes, with their
    /// unit.
    fn say_what_moves(&mut self, flat: &Flattener, switched: &[(usize, usize, Vec<f64>)]) {
        for (guard, &node) in self.guards.iter().enumerate() {
            let made_of = flat.made_of(node);
            for (unit, modes) in self.units.iter_mut().enumerate() {
                let moves = |watch: &Watch| match &made_of {
                    None => true,
                    Some((states, sums)) => {
                        watch.resets.iter().any(|(to, _)| states.contains(to))
                            || sums.iter().any(|sum| {
                                let mut own = switched.iter().filter(|(_, by, _)| *by == unit);
                                own.any(|(at, ..)| sum.contains(at))
                            })
                    }
                };
                for watch in modes.iter_mut().flatten() {
                    if moves(watch) {
                        watch.moved.push(guard);
                    }
                }
            }
        }
    }

    /// Order of the series that values are computed with: 0 unless derivatives are needed for them.
    pub(crate) fn order_of_values(&self) -> usize {
        self.adiabatic
            .first()
            .map_or(0, |x| 2 * x.corrections() + 1)
    }

    fn guard(&mut self, flat: &Flattener, node: Node) -> Result<usize, BuildError> {
        let node = flat.index(node)?;
        Ok(self
            .guards
            .iter()
            .position(|&g| g == node)
            .unwrap_or_else(|| {
                self.guards.push(node);
                self.guards.len() - 1
            }))
    }

    fn resolve(
        &mut self,
        flat: &Flattener,
        t: &Transition,
        modes: usize,
    ) -> Result<Watch, BuildError> {
        if t.to >= modes {
            return Err(BuildError::Undefined(format!("mode {}", t.to)));
        }
        let guard = self.guard(flat, t.guard)?;
        let mut vanishing = Vec::new();
        for &(node, multiplicity) in &t.vanishing {
            vanishing.push((self.guard(flat, node)?, multiplicity));
        }
        let mut resets = Vec::new();
        for &(state, value) in &t.resets {
            resets.push((flat.index(Node::State(state))?, flat.index(value)?));
        }
        Ok(Watch {
            guard,
            sign: t.sign,
            to: t.to,
            moved: Vec::new(),
            resets,
            vanishing,
        })
    }

    /// Turns the wanted operations into steps; neighbouring sums become one.
    fn assemble(
        &mut self,
        flat: &Flattener,
        slots: &Slots,
        wanted: impl Fn(usize) -> bool,
    ) -> Vec<Step> {
        let mut program: Vec<Step> = Vec::new();
        let mut pending: Option<Sums> = None;
        let wanted = flat.ops.iter().enumerate().filter(|(i, _)| wanted(*i));
        for op in wanted.map(|(_, op)| op) {
            let kept = self.keeps.len();
            let place = slots.place(op);
            if let (Place::Now(_), false) = (place, matches!(op.kind, Kind::Adiabatic { .. })) {
                let count = op.count - op.kind.hidden();
                let of = |node: usize| slots.of[node].iter().map(move |&slot| (node as u32, slot));
                self.keeps.extend((op.out..op.out + count).flat_map(of));
            }
            let keeps = (kept, self.keeps.len());
            let (out, count) = (op.out, op.count);
            let op = match &op.kind {
                Kind::Linear { constant, terms } => {
                    if let Some(sums) = pending.as_mut().filter(|sums| sums.accepts(place, terms)) {
                        sums.push(*constant, terms);
                        extend_keeps(&mut program, self.keeps.len());
                        continue;
                    }
                    self.finish(pending.replace(Sums::new(place, *constant, terms)));
                    // The group is numbered now and written when it is complete.
                    let group = self.groups.len();
                    if let Some(Step {
                        op: Op::Linear { groups },
                        keeps,
                    }) = program.last_mut()
                    {
                        (groups.1, keeps.1) = (group + 1, self.keeps.len());
                        continue;
                    }
                    Op::Linear {
                        groups: (group, group + 1),
                    }
                }
                Kind::Matrix { weights, nodes } => {
                    self.finish(pending.take());
                    let start = self.terms.len();
                    self.terms.extend(nodes);
                    Op::Matrix {
                        out: place,
                        rows: count,
                        weights: self.stream(weights.0..weights.1),
                        nodes: (start, self.terms.len()),
                    }
                }
                Kind::Squares(factors) => {
                    self.finish(pending.take());
                    Op::Squares {
                        out,
                        count,
                        factor: slots.block(factors),
                    }
                }
                Kind::Products(first, second) => {
                    self.finish(pending.take());
                    Op::Products {
                        out,
                        count,
                        factors: [slots.block(first), slots.block(second)],
                    }
                }
                Kind::Adiabatic {
                    x,
                    sources,
                    damping,
                    responses,
                } => {
                    self.finish(pending.take());
                    let size = x.len() * sources.len();
                    let slot = slots.block(x);
                    if self.adiabatic.iter().all(|known| known.out != slot) {
                        let damping = self.stream(*damping..damping + 1);
                        let responses = responses
                            .iter()
                            .map(|&first| self.stream(first..first + size))
                            .collect();
                        self.adiabatic.push(Adiabatic {
                            out: slot,
                            count: x.len(),
                            source: slots.block(sources),
                            sources: sources.len(),
                            damping,
                            responses,
                        });
                    }
                    Op::Recall { out, slot, count }
                }
                Kind::Cubic {
                    y,
                    t,
                    added,
                    heads,
                    weights,
                    extra,
                } => {
                    self.finish(pending.take());
                    let size = heads * (2 * y.len() - heads);
                    let place = self.stream(*weights..weights + size);
                    let extra = extra.iter().map(|&(row, column, weight)| {
                        (row, column, self.stream(weight..weight + 1))
                    });
                    let extra = extra.collect();
                    self.cubics.push(Cubic {
                        out,
                        count: y.len(),
                        y: slots.block(y),
                        t: slots.block(t),
                        added: added.first().map(|&node| node as usize),
                        heads: *heads,
                        weights: place,
                        extra,
                    });
                    Op::Cubic(self.cubics.len() - 1)
                }
            };
            program.push(Step { op, keeps });
        }
        self.finish(pending);
        program
    }

    /// Appends coefficients to the stream; their place.
    fn stream(&mut self, coefficients: std::ops::Range<usize>) -> usize {
        let place = self.stream.len();
        self.stream.extend(coefficients.map(|c| c as u32));
        place
    }

    /// Writes a group down.
    fn finish(&mut self, sums: Option<Sums>) {
        let Some(Sums { out, rows }) = sums else {
            return;
        };
        let (weights, nodes) = (self.stream.len(), self.terms.len());
        let terms = rows[0].1.len();
        self.stream
            .extend(rows.iter().map(|(constant, _)| *constant as u32));
        for term in 0..terms {
            for (constant, nodes) in &rows {
                self.stream.push((constant + 1 + term) as u32);
                self.terms.push(nodes[term]);
            }
        }
        self.groups.push(Group {
            out,
            width: rows.len(),
            terms,
            weights,
            nodes,
        });
    }
}

/// A group that may still grow.
struct Sums {
    out: Place,
    /// Coefficient of the constant, and the nodes.
    rows: Vec<(usize, Vec<u16>)>,
}

impl Sums {
    fn new(out: Place, constant: usize, nodes: &[u16]) -> Self {
        Self {
            out,
            rows: vec![(constant, nodes.to_vec())],
        }
    }

    fn push(&mut self, constant: usize, nodes: &[u16]) {
        self.rows.push((constant, nodes.to_vec()));
    }

    /// Whether another sum may join: its result is the next, and it reads none of the others.
    fn accepts(&self, out: Place, nodes: &[u16]) -> bool {
        let width = self.rows.len();
        let next = match (self.out, out) {
            (Place::Now(first), Place::Now(node)) => {
                let mine = first..first + width;
                node == mine.end && !nodes.iter().any(|&node| mine.contains(&(node as usize)))
            }
            (Place::Kept(first), Place::Kept(slot)) => slot == first + width,
            _ => false,
        };
        next && width < GROUP && self.rows[0].1.len() == nodes.len()
    }
}

/// The last step keeps what has been added to the list.
fn extend_keeps(program: &mut [Step], end: usize) {
    if let Some(step) = program.last_mut() {
        step.keeps.1 = end;
    }
}
