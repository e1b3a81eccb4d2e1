//! Modes in which a function is not needed: it is not asked there, since it may not be defined.
//!
//! The force of a contact, `where(x > 0, x^1.5, 0)`, is a power times a coefficient that is 0 in flight, and x is
//! negative there. An operation belongs to a unit if all that need it do so through coefficients of that unit; it is
//! idle in the modes in which all of these are 0.

use crate::program::{Gate, Node, Operation, Program};

impl Program {
    /// Lets the coefficient `active` of each quotient, power and function be 0 in the modes in which it is idle.
    pub(crate) fn note_idle_modes(&mut self) {
        let mut open: Vec<(usize, usize)> = Vec::new();
        let mut node = 0;
        for op in &self.operations {
            if let Some(active) = op.active()
                && self.gates.iter().all(|gate| gate.coefficient != active)
            {
                open.push((node, active));
            }
            node += op.nodes();
        }
        for unit in 0..self.units.len() {
            if open.is_empty() {
                return;
            }
            let modes = self.units[unit].len();
            let beside = self.needed(unit, None);
            let own: Vec<_> = open.extract_if(.., |(node, _)| !beside[*node]).collect();
            let by_mode: Vec<_> = (0..modes)
                .map(|mode| self.needed(unit, Some(mode)))
                .collect();
            self.gates
                .extend(own.into_iter().map(|(node, coefficient)| {
                    Gate {
                        coefficient,
                        unit,
                        by_mode: by_mode
                            .iter()
                            .map(|needed| f64::from(u8::from(needed[node])))
                            .collect(),
                    }
                }));
        }
    }

    /// Operations' nodes that something needs while `unit` is in `mode`; without a mode, that something needs beside
    /// this unit: no coefficient of it counts, and none of its guards.
    fn needed(&self, unit: usize, mode: Option<usize>) -> Vec<bool> {
        let mut needed = vec![false; self.nodes];
        let mut need = |node: Node| {
            if let Node::Op(i) = node
                && let Some(needed) = needed.get_mut(i)
            {
                *needed = true;
            }
        };
        self.derivative
            .iter()
            .flatten()
            .for_each(|&rate| need(rate));
        for (number, modes) in self.units.iter().enumerate() {
            for (i, transitions) in modes.iter().enumerate() {
                if number == unit && mode != Some(i) {
                    continue;
                }
                for leave in transitions {
                    need(leave.guard);
                    leave.resets.iter().for_each(|&(_, value)| need(value));
                    leave.vanishing.iter().for_each(|&(guard, _)| need(guard));
                }
            }
        }
        let counts = |coefficient: usize| {
            let mut gates = self.gates.iter();
            let gate = gates.find(|gate| gate.coefficient == coefficient && gate.unit == unit);
            gate.is_none_or(|gate| mode.is_some_and(|mode| gate.by_mode[mode] != 0.0))
        };
        // Slopes may come after their functions.
        loop {
            let before = needed.clone();
            let mut first = self.nodes;
            for op in self.operations.iter().rev() {
                first -= op.nodes();
                if needed[first..first + op.nodes()].contains(&true) {
                    for node in op.inputs(counts) {
                        if let Node::Op(i) = node {
                            needed[i] = true;
                        }
                    }
                }
            }
            if needed == before {
                return needed;
            }
        }
    }
}

impl Operation {
    /// The coefficient that is 0 where the operation is idle, if it has one.
    fn active(&self) -> Option<usize> {
        match self {
            Self::Quotient { active, .. }
            | Self::Power { active, .. }
            | Self::Function { active, .. } => Some(*active),
            _ => None,
        }
    }

    /// Nodes that it reads, but for the terms of a sum whose coefficients do not count.
    fn inputs(&self, counts: impl Fn(usize) -> bool) -> Vec<Node> {
        match self {
            Self::Linear { constant, terms } => {
                let terms = terms.iter().zip(constant + 1..);
                let terms = terms.filter(|&(_, coefficient)| counts(coefficient));
                terms.map(|(&node, _)| node).collect()
            }
            Self::Matrix { nodes, .. } | Self::Squares(nodes) => nodes.clone(),
            Self::Products(pairs) => pairs.iter().flat_map(|&(a, b)| [a, b]).collect(),
            Self::Adiabatic { sources, .. } => sources.clone(),
            Self::Cubic { y, added, .. } => [y.as_slice(), added].concat(),
            Self::Quotient {
                dividend, divisor, ..
            } => vec![*dividend, *divisor],
            Self::Power { base, .. } => vec![*base],
            Self::Function { of, slope, .. } => vec![*of, *slope],
        }
    }
}
