//! A failing case made smaller, as long as it fails in the same way.

use crate::case::{Case, Poly};

/// The smallest case found that `fails` still; takes one simplification after the other.
pub(crate) fn shrink(mut case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    while let Some(simpler) = simpler(&case).into_iter().find(&fails) {
        case = simpler;
    }
    case
}

/// One thing less each: the largest first.
fn simpler(case: &Case) -> Vec<Case> {
    let mut out = Vec::new();
    let mut add = |change: &dyn Fn(&mut Case)| {
        let mut next = case.clone();
        change(&mut next);
        if next != *case {
            out.push(next);
        }
    };
    (1..case.periods).for_each(|periods| add(&|c| c.periods = periods));
    for unit in 0..case.units.len() {
        add(&|c| drop(c.units.remove(unit)));
    }
    let droppable = if case.rates.len() > 1 {
        case.rates.len()
    } else {
        0
    };
    (0..droppable).for_each(|state| add(&|c| c.drop_state(state)));
    for (unit, (start, modes)) in case.units.iter().enumerate() {
        for (at, mode) in modes.iter().enumerate() {
            add(&|c| c.units[unit].0 = at.min(*start));
            (0..mode.adds.len()).for_each(|i| add(&|c| drop(c.units[unit].1[at].adds.remove(i))));
            for (i, rule) in mode.rules.iter().enumerate() {
                add(&|c| drop(c.units[unit].1[at].rules.remove(i)));
                for reset in 0..rule.resets.len() {
                    add(&|c| drop(c.units[unit].1[at].rules[i].resets.remove(reset)));
                }
            }
        }
    }
    let terms: Vec<usize> = case.clone().polys().map(|poly| poly.0.len()).collect();
    for (at, terms) in terms.into_iter().enumerate() {
        for term in 0..terms {
            add(&|c| drop(poly(c, at).0.remove(term)));
        }
    }
    (0..case.start.len()).for_each(|state| add(&|c| c.start[state] = 0.0));
    add(&|c| c.omega = 1.0);
    for decimals in [1.0, 10.0] {
        add(&|c| {
            let round = |x: &mut f64| *x = (decimals * *x).round() / decimals;
            c.polys()
                .flat_map(|poly| &mut poly.0)
                .for_each(|(c, _)| round(c));
            c.start.iter_mut().for_each(round);
        });
    }
    out
}

fn poly(case: &mut Case, at: usize) -> &mut Poly {
    case.polys().nth(at).expect("as counted")
}

impl Case {
    /// Without a state, and every term in which it is.
    fn drop_state(&mut self, state: usize) {
        self.start.remove(state);
        self.rates.remove(state);
        for poly in self.polys() {
            poly.0.retain(|(_, factors)| !factors.contains(&state));
            let factors = poly.0.iter_mut().flat_map(|(_, factors)| factors);
            factors.filter(|i| **i > state).for_each(|i| *i -= 1);
        }
        let later = |to: &mut usize| *to -= usize::from(*to > state);
        for mode in self.units.iter_mut().flat_map(|(_, modes)| modes) {
            mode.adds.retain(|(to, _)| *to != state);
            mode.adds.iter_mut().for_each(|(to, _)| later(to));
            for rule in &mut mode.rules {
                rule.resets.retain(|(to, _)| *to != state);
                rule.resets.iter_mut().for_each(|(to, _)| later(to));
            }
        }
    }
}
