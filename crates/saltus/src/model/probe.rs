//! Accelerations and forces along a trajectory, without allocating, for peaks and contact times.

use saltus_hybrid::{Evaluator, Mode};

use super::Model;
use super::leg::Contact;

/// Measures accelerations and forces at states of one model, for peaks.
#[derive(Clone, Debug)]
pub struct Probe {
    evaluator: Evaluator,
    /// Places of R_j'' and of the leg forces among the nodes.
    plate: Vec<usize>,
    legs: Vec<usize>,
    /// psi_j under each body, body by body.
    psi: Vec<f64>,
    /// Place of cos(Omega t) in the state, and A_b/h before it.
    cos: usize,
    base: f64,
    /// h Omega^2 (m/s^2), and g.
    acceleration: f64,
    gravity: f64,
    floor: Vec<f64>,
    reaction: Vec<f64>,
}

/// Readings of a [`Probe`] at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reading<'a> {
    /// Vertical acceleration of the floor under each body (m/s^2), base motion included:
    /// sum_j psi_j r_j'' - A_b Omega^2 cos(Omega t).
    pub(crate) floor: &'a [f64],
    /// Plate reaction force on each body in units of its weight (-); 0 in flight.
    pub(crate) reaction: &'a [f64],
}

impl Model {
    /// A probe for states of this model.
    pub(crate) fn probe(&self) -> Probe {
        let index = |node: &saltus_hybrid::Node| self.system.index(*node);
        let jumpers = &self.setup.jumpers;
        let psi = |jumper: &crate::physics::Jumper| self.setup.plate.mode_shape(jumper.x, jumper.y);
        Probe {
            evaluator: self.evaluator(),
            plate: self.plate_acceleration.iter().map(index).collect(),
            legs: self.leg_force.iter().map(index).collect(),
            psi: jumpers.iter().flat_map(psi).collect(),
            cos: self.layout.len(),
            base: self.setup.base.amplitude / self.scales.length,
            acceleration: self.scales.acceleration(),
            gravity: self.setup.gravity,
            floor: vec![0.0; jumpers.len()],
            reaction: vec![0.0; jumpers.len()],
        }
    }
}

impl Probe {
    /// Readings at state `x` in `modes`. Where a switch makes a force jump, `modes` say which
    /// side is meant.
    pub(crate) fn reading(&mut self, modes: &[Mode], x: &[f64]) -> Reading<'_> {
        let nodes = self.evaluator.nodes(modes, x);
        let base = self.base * x[self.cos];
        let shapes = self.psi.chunks_exact(self.plate.len());
        for (floor, psi) in self.floor.iter_mut().zip(shapes) {
            let plate = psi.iter().zip(&self.plate);
            let plate: f64 = plate.map(|(psi, &at)| psi * nodes[at]).sum();
            *floor = (plate - base) * self.acceleration;
        }
        for (i, reaction) in self.reaction.iter_mut().enumerate() {
            *reaction = match Contact::of(modes[i]) {
                Contact::Stance => nodes[self.legs[i]] * self.acceleration / self.gravity,
                Contact::Flight => 0.0,
            };
        }
        Reading {
            floor: &self.floor,
            reaction: &self.reaction,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::model::{ModelError, Setup};
    use crate::study::{Control, simulate};

    #[test]
    fn floor_acceleration_is_the_second_difference_of_the_floor() -> Result<(), ModelError> {
        let model = Setup::dias_del_prado(0.3, 1.0).model()?;
        let start = model.start(3.0, 2.0);
        let run = simulate(&model, &start, 1, 1, 4000, &Control::default()).expect("runs");
        let w = |i: usize| run.history.states[i].floor[0];
        let h = model.scales().period() / 4000.0;
        // one-sided, of second order; the body is still in the air, so nothing jumps
        let second = (2.0 * w(0) - 5.0 * w(1) + 4.0 * w(2) - w(3)) / (h * h);
        let mut probe = model.probe();
        let read = probe.reading(&start.modes, &start.x);
        assert!(
            (read.floor[0] / second - 1.0).abs() < 1e-3,
            "{read:?} {second}"
        );
        assert_eq!(read.reaction, [0.0]);
        Ok(())
    }

    #[test]
    fn reaction_is_that_of_an_observation() -> Result<(), ModelError> {
        let model = Setup::dias_del_prado(0.2, 0.9).model()?;
        let start = model.start(-1.5, 0.3);
        let seen = model.observe(&mut model.evaluator(), &start.modes, &start.x);
        let mut probe = model.probe();
        let read = probe.reading(&start.modes, &start.x);
        assert!(read.reaction[0] > 0.0);
        assert_eq!(read.reaction, seen.prf);
        Ok(())
    }
}
