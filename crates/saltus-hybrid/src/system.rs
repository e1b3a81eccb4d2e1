//! A system that is ready to run: a program and its numbers.

use std::sync::Arc;

use crate::evaluator::Evaluator;
use crate::program::{Mode, Node, Program};
use crate::special::{self, Shape};
use crate::structure::Structure;

/// A system: a structure and its numbers. Cheap to clone.
#[derive(Clone, Debug)]
pub struct System {
    pub(crate) structure: Arc<Structure>,
    pub(crate) coefficients: Arc<[f64]>,
    pub(crate) tables: Arc<[f64]>,
    /// Scale of each state that takes part in error control.
    pub(crate) scales: Arc<[f64]>,
    pub(crate) period: f64,
    /// The program it was built from, without the coefficients.
    pub(crate) program: Arc<Program>,
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
        self.program.declared
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
    /// [`SystemBuilder::state`](crate::SystemBuilder::state), in order.
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
        let mut point = Point {
            modes: modes.to_vec(),
            x: state,
        };
        if !self.program.signs.is_empty() {
            self.set_signs(&mut point);
        }
        point
    }

    /// Gives the units that follow a sign the mode that their quantity has at a point, or just after it where that is
    /// zero. A quantity may depend on units before it.
    fn set_signs(&self, point: &mut Point) {
        let base = self.base();
        let mut evaluator = Evaluator::new(&base);
        let x = &point.x[..base.structure.states.min(point.x.len())];
        for &unit in &self.program.signs {
            let Some(watch) = base.structure.units[unit].iter().flatten().next() else {
                continue;
            };
            let guard = base.structure.guards[watch.guard];
            let nodes = evaluator.nodes(&point.modes, x);
            let value = nodes[guard];
            let rates = base.structure.derivative.iter();
            let flow: Vec<f64> = rates.map(|&rate| nodes[rate]).collect();
            let sign = match value {
                0.0 => evaluator.along(&flow)[guard],
                value => value,
            };
            point.modes[unit] = usize::from(sign > 0.0);
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

    /// Flat index of a node in the output of [`Evaluator::nodes`](crate::Evaluator::nodes).
    pub fn index(&self, node: Node) -> usize {
        match node {
            Node::State(i) => i,
            Node::Op(i) => self.structure.states + i,
        }
    }
}

/// Modes and state together; neither means anything alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Mode of each unit.
    pub modes: Vec<Mode>,
    /// State, drive and quadratures included.
    pub x: Vec<f64>,
}
