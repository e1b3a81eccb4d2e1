//! Starts of people and plate, spread evenly over a box of states.

use saltus_hybrid::Point;

use saltus_study::{Range, spread};

use crate::model::Model;

/// A box of states. The plate rests, deflected or not, and each body has the contact state that the law gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Starts {
    /// Number of starts. Start k is the same for any count.
    pub count: usize,
    /// z/eta of every body.
    pub z: Range,
    /// z'/(eta omega_h) of every body.
    pub v: Range,
    /// Largest |r_j/h| of every transverse amplitude; 0 for a plate at rest. Positions and velocities of the
    /// bodies do not depend on it.
    pub plate: f64,
}

impl Starts {
    /// Start `number` for this model. A box that is not finite gives states that are not, whose runs end at once.
    pub fn point(&self, model: &Model, number: usize) -> Point {
        let bodies = model.setup().jumpers.len();
        let mut coordinates = (0..).map(|dimension| spread(number, dimension));
        let mut all = |count: usize, [from, to]: Range| -> Vec<f64> {
            let places = coordinates.by_ref().take(count);
            places.map(|part| from + (to - from) * part).collect()
        };
        let (z, v) = (all(bodies, self.z), all(bodies, self.v));
        let w = all(model.layout.transverse, [-self.plate, self.plate]);
        model.start_deflected(&z, &v, &w)
    }
}

impl saltus_study::Starts<Model> for Starts {
    fn count(&self) -> usize {
        self.count
    }

    fn point(&self, model: &Model, number: usize) -> Point {
        self.point(model, number)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::model::{Contact, Setup};

    #[test]
    fn starts_lie_in_the_box_and_bodies_do_not_depend_on_the_plate() {
        let model = Setup::dias_del_prado(0.3, 0.9).model().unwrap();
        let rest = Starts {
            count: 32,
            z: [-2.0, 6.0],
            v: [-4.0, 4.0],
            plate: 0.0,
        };
        let bent = Starts { plate: 0.5, ..rest };
        let mut in_flight = 0;
        for k in 0..rest.count {
            let [rest, bent] = [rest, bent].map(|starts| {
                let point = starts.point(&model, k);
                model.section(&point.modes, &point.x)
            });
            assert_eq!((&rest.z, &rest.v), (&bent.z, &bent.v));
            assert!((-2.0..6.0).contains(&rest.z[0]) && (-4.0..4.0).contains(&rest.v[0]));
            assert!(rest.w.iter().all(|&w| w == 0.0));
            assert!(bent.w.iter().all(|w| (-0.5..0.5).contains(w)));
            assert!(bent.w.windows(2).all(|pair| pair[0] != pair[1]));
            in_flight += usize::from(rest.phase[0] == Contact::Flight);
        }
        assert!((1..32).contains(&in_flight), "{in_flight}");
    }

    #[test]
    fn a_bent_plate_lifts_who_stands_on_it() {
        // DP's plate, its first mode up by h/2: a body just above the base is on the floor again
        let model = Setup::dias_del_prado(0.3, 0.9).model().unwrap();
        let (flat, bent) = (
            model.start_deflected(&[1.0], &[0.0], &[0.0]),
            model.start_deflected(&[1.0], &[0.0], &[5.0]),
        );
        assert_eq!(Contact::of(flat.modes[0]), Contact::Flight);
        assert_eq!(Contact::of(bent.modes[0]), Contact::Stance);
    }
}
