//! The flat program that the series code runs: data alone.
//!
//! Nodes are flat indices, states first and then operations. Nodes that are needed in all orders of a series have
//! slots; [`Structure::stream`] lists coefficients in the order in which they are read. Numbers stand elsewhere, so
//! that all members of an ensemble share one structure.

use std::sync::Arc;

use crate::function::Function;

/// Nodes that an index can name.
pub(crate) const MAX_NODES: usize = 1 << 16;

/// Most sums in a group.
pub(crate) const GROUP: usize = 4;

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
    /// Nodes that follow the rest adiabatically, if any do; several lists with tangents.
    pub(crate) adiabatic: Vec<Adiabatic>,
    /// (node, slot) of the nodes that steps keep.
    pub(crate) keeps: Vec<(u32, u32)>,
    /// (node, slot) of the nodes that are in a slot only.
    pub(crate) kept_only: Vec<(u32, u32)>,
    /// Flat node index of each state's derivative.
    pub(crate) derivative: Vec<usize>,
    /// The same, with the slot of each state.
    pub(crate) rates: Vec<Rate>,
    /// A slot of each state.
    pub(crate) state_slots: Vec<usize>,
    /// (state, slot) of the states that have a second slot.
    pub(crate) state_copies: Vec<(usize, usize)>,
    /// Flat node indices of all guards.
    pub(crate) guards: Vec<usize>,
    /// Their slots.
    pub(crate) guard_slots: Vec<usize>,
    /// Slots of those that are no polynomials of the states: their series say how far they go.
    pub(crate) curved_guards: Vec<usize>,
    /// Transitions of each mode of each unit.
    pub(crate) units: Vec<Vec<Vec<Watch>>>,
    /// (place in the stream, unit, offset of its table in `System::tables`).
    pub(crate) switched: Vec<(usize, usize, usize)>,
    /// States that hold cos and sin of the drive, if it is driven.
    pub(crate) drive: Option<(usize, usize)>,
    /// Columns of the tangent flow, if it has any.
    pub(crate) tangents: Option<Tangents>,
}

impl Structure {
    /// States without tangent columns, which are the last.
    pub(crate) fn base_states(&self) -> usize {
        let tangents = self.tangents.as_ref();
        tangents.map_or(self.states, |tangents| tangents.first)
    }

    /// Order of the series that values are computed with: 0 unless derivatives are needed for them.
    pub(crate) fn order_of_values(&self) -> usize {
        self.adiabatic
            .first()
            .map_or(0, |x| 2 * x.corrections() + 1)
    }
}

/// One step of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) op: Op,
    /// The nodes to keep, a range of [`Structure::keeps`].
    pub(crate) keeps: (usize, usize),
}

/// The work of a step.
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
    /// A node over a slot; the result has a slot, `own`. `active` is a place in the stream: see
    /// [`Operation`](crate::program::Operation).
    Quotient {
        out: usize,
        own: usize,
        dividend: usize,
        divisor: usize,
        active: usize,
    },
    /// A slot to a power, a place in the stream.
    Power {
        out: usize,
        own: usize,
        base: usize,
        exponent: usize,
        active: usize,
    },
    /// A function of a slot, whose slope is in another.
    Function {
        function: Function,
        minus: bool,
        out: usize,
        of: usize,
        slope: usize,
        active: usize,
    },
    /// Squares q of neighbours y, t = A q + added, and products y t: see `Structure::cubics`.
    Cubic(usize),
}

/// Place of the results of an operation, which lie side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// Nodes, for the order in hand only (and from there the slots in [`Step::keeps`]).
    Now(usize),
    /// Slots at once: nothing but products reads them.
    Kept(usize),
}

/// Sums c + sum of coefficient times node with equally many terms, which do not depend on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Group {
    /// Place of the first; the others follow.
    pub(crate) out: Place,
    /// Number of sums, at most [`GROUP`].
    pub(crate) width: usize,
    pub(crate) terms: usize,
    /// Begin in the stream: `width` constants, then for each term `width` coefficients.
    pub(crate) weights: usize,
    /// Begin in [`Structure::terms`]: for each term `width` nodes.
    pub(crate) nodes: usize,
}

/// An [`Op::Cubic`].
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

/// Nodes x_a = sum over n >= 1 of (R_n (D^2 + damping D)^n q)_a.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Adiabatic {
    /// First slot of x.
    pub(crate) out: usize,
    pub(crate) count: usize,
    /// First slot of q.
    pub(crate) source: usize,
    pub(crate) sources: usize,
    /// Place of the damping in the stream.
    pub(crate) damping: usize,
    /// Places of R_1, R_2, ... in the stream, rows by fours.
    pub(crate) responses: Vec<usize>,
}

impl Adiabatic {
    /// Terms of the series, and rounds after the first.
    pub(crate) fn corrections(&self) -> usize {
        self.responses.len()
    }

    /// Cells that its rounds work in, for a series of this order.
    pub(crate) fn scratch(&self, order: usize) -> usize {
        2 * (order + 1) * self.sources
    }
}

/// The node that is the rate of a state, and the slot of that state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rate {
    pub(crate) node: u16,
    pub(crate) slot: u16,
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

/// Tangent columns of a program: its last states, column by column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tangents {
    /// The program without them; its coefficients are the first ones of the program with them.
    pub(crate) base: Arc<Structure>,
    /// First state of the first column.
    pub(crate) first: usize,
    /// Length of a column.
    pub(crate) size: usize,
}
