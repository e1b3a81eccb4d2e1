//! Compiles the program of a builder to the flat one that the series code runs.

use crate::flatten::{FlatOp, Flattener, Followers, Gradient, Kind, Slots};
use crate::program::{BuildError, Gate, Node, Program, Transition};
use crate::structure::{
    Adiabatic, Cubic, GROUP, Group, MAX_NODES, Op, Place, Rate, Step, Structure, Watch,
};

impl Structure {
    /// The structure of a program, but for its gates.
    pub(crate) fn of(program: &Program) -> Result<Self, BuildError> {
        let states = program.derivative.len();
        let mut flat = Flattener::new(states);
        for op in &program.operations {
            flat.push(op)?;
        }
        if flat.nodes > MAX_NODES {
            return Err(BuildError::TooLarge(flat.nodes));
        }
        let drive = program.drive;
        let mut out = Self {
            states,
            nodes: flat.nodes,
            controlled: states - program.quadratures,
            drive: drive.map(|_| (program.declared, program.declared + 1)),
            ..Self::default()
        };
        for (i, node) in program.derivative.iter().enumerate() {
            let node = node.ok_or(BuildError::NoDerivative(i))?;
            out.derivative.push(flat.index(node)?);
        }
        for modes in &program.units {
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
        out.note_moves(&flat, &program.gates);
        let slots = Slots::new(&flat, &out.guards, &out.derivative);
        out.place_states(&slots);
        let curved = out.guards.iter().filter(|&&guard| flat.is_curved(guard));
        out.curved_guards = curved.map(|&guard| slots.first(guard)).collect();
        let needed = flat.needed_by(&out.guards);
        out.program = out.assemble(&flat, &slots, |_| true);
        out.guard_program = out.assemble(&flat, &slots, |op| needed[op]);
        out.kept_only = (0..out.nodes)
            .filter(|&node| slots.is_kept_only(node))
            .map(|node| (node as u32, slots.of[node][0]))
            .collect();
        Ok(out)
    }

    /// Notes where the stream has coefficients that depend on modes; gives the tables of their values.
    pub(crate) fn note_gates(&mut self, program: &Program) -> Result<Vec<f64>, BuildError> {
        let mut tables = Vec::new();
        for gate in &program.gates {
            let unit = gate.unit;
            if program.units[unit].len() != gate.by_mode.len() {
                let part = format!("a gate of unit {unit} in some mode");
                return Err(BuildError::Undefined(part));
            }
            if let Some(&value) = gate.by_mode.iter().find(|v| !v.is_finite()) {
                let index = gate.coefficient;
                return Err(BuildError::NotFinite { index, value });
            }
            for (place, &coefficient) in self.stream.iter().enumerate() {
                if coefficient as usize == gate.coefficient {
                    self.switched.push((place, unit, tables.len()));
                }
            }
            tables.extend(&gate.by_mode);
        }
        Ok(tables)
    }

    /// Notes the slots of states and guards.
    fn place_states(&mut self, slots: &Slots) {
        self.slots = slots.count;
        self.guard_slots = self.guards.iter().map(|&g| slots.first(g)).collect();
        self.state_slots = (0..self.states).map(|s| slots.first(s)).collect();
        let rate = |(&node, &slot): (&usize, &usize)| Rate {
            node: node as u16,
            slot: slot as u16,
        };
        let rates = self.derivative.iter().zip(&self.state_slots).map(rate);
        self.rates = rates.collect();
        let copies = |s: usize| slots.of[s][1..].iter().map(move |&slot| (s, slot as usize));
        self.state_copies = (0..self.states).flat_map(copies).collect();
    }

    /// Notes with each transition the guards that it may move.
    fn note_moves(&mut self, flat: &Flattener, gates: &[Gate]) {
        for (guard, &node) in self.guards.iter().enumerate() {
            let made_of = flat.made_of(node);
            for (unit, modes) in self.units.iter_mut().enumerate() {
                let moves = |watch: &Watch| match &made_of {
                    None => true,
                    Some((states, sums)) => {
                        watch.resets.iter().any(|(to, _)| states.contains(to))
                            || sums.iter().any(|sum| {
                                let mut own = gates.iter().filter(|gate| gate.unit == unit);
                                own.any(|gate| sum.contains(&gate.coefficient))
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
        let mut assembly = Assembly {
            structure: self,
            slots,
            program: Vec::new(),
            pending: None,
        };
        for (i, op) in flat.ops.iter().enumerate() {
            if wanted(i) {
                assembly.push(op);
            }
        }
        assembly.finish();
        assembly.program
    }

    /// Appends coefficients to the stream; their place.
    fn stream(&mut self, coefficients: std::ops::Range<usize>) -> usize {
        let place = self.stream.len();
        self.stream.extend(coefficients.map(|c| c as u32));
        place
    }

    /// Notes nodes that follow others adiabatically, once; the first of their slots.
    fn note_followers(&mut self, all: &Followers, slots: &Slots) -> usize {
        let out = slots.block(&all.x);
        if self.adiabatic.iter().all(|known| known.out != out) {
            let size = all.x.len() * all.sources.len();
            let damping = self.stream(all.damping..all.damping + 1);
            let responses = all.responses.iter();
            let responses = responses.map(|&first| self.stream(first..first + size));
            let responses = responses.collect();
            self.adiabatic.push(Adiabatic {
                out,
                count: all.x.len(),
                source: slots.block(&all.sources),
                sources: all.sources.len(),
                damping,
                responses,
            });
        }
        out
    }

    /// Adds a cubic to the list; its place there.
    fn add_cubic(&mut self, cubic: &Gradient, slots: &Slots, out: usize) -> usize {
        let count = cubic.y.len();
        let size = cubic.heads * (2 * count - cubic.heads);
        let weights = self.stream(cubic.weights..cubic.weights + size);
        let extra = cubic.extra.iter();
        let extra = extra.map(|&(row, column, at)| (row, column, self.stream(at..at + 1)));
        let extra = extra.collect();
        self.cubics.push(Cubic {
            out,
            count,
            y: slots.block(&cubic.y),
            t: slots.block(&cubic.t),
            added: cubic.added.first().map(|&node| node as usize),
            heads: cubic.heads,
            weights,
            extra,
        });
        self.cubics.len() - 1
    }
}

/// A program as it grows, operation by operation.
struct Assembly<'a> {
    structure: &'a mut Structure,
    slots: &'a Slots,
    program: Vec<Step>,
    /// The last group of sums, while others may join it. It is numbered, and written when it is complete.
    pending: Option<Sums>,
}

impl Assembly<'_> {
    fn push(&mut self, op: &FlatOp) {
        let kept = self.structure.keeps.len();
        let place = self.slots.place(op);
        if let (Place::Now(_), false) = (place, matches!(op.kind, Kind::Adiabatic(_))) {
            let nodes = op.out..op.out + op.count - op.kind.hidden();
            let slots = self.slots;
            let of = |node: usize| slots.of[node].iter().map(move |&slot| (node as u32, slot));
            self.structure.keeps.extend(nodes.flat_map(of));
        }
        let keeps = (kept, self.structure.keeps.len());
        if !matches!(op.kind, Kind::Linear { .. }) {
            self.finish();
        }
        let (structure, slots) = (&mut *self.structure, self.slots);
        let (out, count) = (op.out, op.count);
        let op = match &op.kind {
            Kind::Linear { constant, terms } => return self.sum(place, *constant, terms, keeps),
            Kind::Matrix { weights, nodes } => {
                let start = structure.terms.len();
                structure.terms.extend(nodes);
                Op::Matrix {
                    out: place,
                    rows: count,
                    weights: structure.stream(weights.0..weights.1),
                    nodes: (start, structure.terms.len()),
                }
            }
            Kind::Squares(factors) => Op::Squares {
                out,
                count,
                factor: slots.block(factors),
            },
            Kind::Products(first, second) => Op::Products {
                out,
                count,
                factors: [slots.block(first), slots.block(second)],
            },
            Kind::Adiabatic(all) => {
                let slot = structure.note_followers(all, slots);
                Op::Recall { out, slot, count }
            }
            Kind::Quotient {
                dividend,
                divisor,
                active,
            } => Op::Quotient {
                out,
                own: slots.block(&[out as u16]),
                dividend: *dividend as usize,
                divisor: slots.block(&[*divisor]),
                active: structure.stream(*active..active + 1),
            },
            Kind::Power {
                base,
                exponent,
                active,
            } => Op::Power {
                out,
                own: slots.block(&[out as u16]),
                base: slots.block(&[*base]),
                exponent: structure.stream(*exponent..exponent + 1),
                active: structure.stream(*active..active + 1),
            },
            Kind::Function {
                function,
                minus,
                of,
                slope,
                active,
            } => Op::Function {
                function: *function,
                minus: *minus,
                out,
                of: slots.block(&[*of]),
                slope: slots.block(&[*slope]),
                active: structure.stream(*active..active + 1),
            },
            Kind::Cubic(cubic) => Op::Cubic(structure.add_cubic(cubic, slots, out)),
        };
        self.program.push(Step { op, keeps });
    }

    /// Appends a sum: to the group at hand, to the step at hand, or as a step of its own.
    fn sum(&mut self, out: Place, constant: usize, terms: &[u16], keeps: (usize, usize)) {
        let pending = self.pending.as_mut();
        match pending.filter(|sums| sums.accepts(out, terms)) {
            Some(sums) => sums.push(constant, terms),
            None => {
                self.finish();
                self.pending = Some(Sums::new(out, constant, terms));
            }
        }
        let group = self.structure.groups.len();
        if let Some(Step {
            op: Op::Linear { groups },
            keeps: all,
        }) = self.program.last_mut()
        {
            (groups.1, all.1) = (group + 1, keeps.1);
        } else {
            let groups = (group, group + 1);
            let op = Op::Linear { groups };
            self.program.push(Step { op, keeps });
        }
    }

    /// Writes the group at hand down.
    fn finish(&mut self) {
        let Some(Sums { out, rows }) = self.pending.take() else {
            return;
        };
        let structure = &mut *self.structure;
        let (weights, nodes) = (structure.stream.len(), structure.terms.len());
        let terms = rows[0].1.len();
        let constants = rows.iter().map(|(constant, _)| *constant as u32);
        structure.stream.extend(constants);
        for term in 0..terms {
            for (constant, nodes) in &rows {
                structure.stream.push((constant + 1 + term) as u32);
                structure.terms.push(nodes[term]);
            }
        }
        structure.groups.push(Group {
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
