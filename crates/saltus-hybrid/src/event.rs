//! Rules of events, shared by all steppers: they tell which switch comes next.
//!
//! A step is half open, (t0, t1]. At its start each guard in force is on its right side, zero, or beyond.
//! It is zero if rounding cannot tell it from zero ([`Jets`]), and then inactive until it leaves zero,
//! and the sign of its first nonzero derivative is the side it leaves to. A guard that falls from zero, or lies
//! beyond, fires at once: no switch is missed because a root sits at the start of a step. One that is
//! beyond and does not go further is held instead if firing would lead to no mode that lasts. It is
//! armed again when it is back on its right side, and fires if it turns away before.

use crate::evaluator::Evaluator;
use crate::jets::{Jets, Side};
use crate::polynomial::{BernsteinTable, MAX_DEGREE, first_descent};
use crate::program::Mode;
use crate::structure::{Structure, Watch};
use crate::system::System;

/// A coefficient is worth a look at its terms if it is below this part of the largest in the step.
const SUSPICIOUS: f64 = 1e-9;

/// A guard counts as having left zero when it exceeds this part of its own Taylor terms.
const LEFT_ZERO: f64 = 1e-12;

/// Modes and guards of one trajectory, as a stepper watches them.
#[derive(Clone, Debug)]
pub(crate) struct Guarded {
    /// Mode of each unit.
    pub(crate) modes: Vec<Mode>,
    /// Multiplicity of each guard's zero at the present point; 0 if it is not zero.
    zero: Vec<u8>,
    /// Transitions whose guard is beyond zero and held: unit and place in its mode.
    held: Vec<(usize, usize)>,
}

/// The next switch within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Firing {
    /// Fraction of the step, in [0, 1]; 0 means at once.
    pub(crate) theta: f64,
    pub(crate) unit: usize,
    /// Index among the transitions of the unit's mode.
    pub(crate) watch: usize,
    pub(crate) cause: Cause,
}

/// Cause of a switch: it decides when neighbours of the trajectory switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cause {
    /// Its guard falls through zero.
    Crossing,
    /// Its guard falls from a zero of higher multiplicity, or was beyond already: it fires with the switch that
    /// brought it there.
    AtOnce,
    /// Its guard, held beyond zero, turned away.
    Turning,
}

/// Events of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coming {
    /// The switch that ends it.
    pub(crate) firing: Option<Firing>,
    /// Fraction of the step after which to look again; that of the switch if there is one.
    pub(crate) until: f64,
    pub(crate) touches: Touches,
}

/// Tangencies met on the way: how many, the guard and the place of the last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Touches {
    pub(crate) count: u32,
    pub(crate) unit: usize,
    pub(crate) theta: f64,
}

/// A point on the way, as the rules see it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spot {
    pub(crate) x: Vec<f64>,
    /// Largest size of each state on the way.
    pub(crate) sizes: Vec<f64>,
}

/// Evaluates guards and resets at points, for one trajectory.
pub(crate) struct Judge {
    pub(crate) evaluator: Evaluator,
    base: System,
    /// Made when it is first needed: most trajectories never ask.
    jets: Option<Box<Jets>>,
    /// Error of the solution, relative to the terms of a guard.
    close: f64,
}

impl Judge {
    /// A judge for a system, its tangents aside, and a solution of this relative error.
    pub(crate) fn new(system: &System, close: f64) -> Self {
        let base = system.base();
        Self {
            evaluator: Evaluator::new(&base),
            base,
            jets: None,
            close,
        }
    }

    fn sides(&mut self, guarded: &Guarded, spot: &Spot) -> Vec<Side> {
        let jets = self
            .jets
            .get_or_insert_with(|| Box::new(Jets::new(&self.base)));
        jets.sides(
            &guarded.modes,
            &spot.x,
            &spot.sizes,
            &guarded.zero,
            self.close,
        )
    }

    /// Carries out the resets of a transition.
    pub(crate) fn reset(&mut self, modes: &[Mode], watch: &Watch, x: &mut [f64]) {
        if !watch.resets.is_empty() {
            let nodes = self.evaluator.nodes(modes, x);
            for &(state, node) in &watch.resets {
                x[state] = nodes[node];
            }
        }
    }

    /// Whether firing leads, with the switches that follow at once, to modes that last.
    fn settles(&mut self, guarded: &Guarded, spot: &Spot, first: Firing) -> bool {
        let structure = std::sync::Arc::clone(&self.base.structure);
        let modes: usize = structure.units.iter().map(Vec::len).sum();
        let (mut ghost, mut spot) = (guarded.clone(), spot.clone());
        let mut moved = Vec::new();
        let mut next = Some(first);
        for _ in 0..=2 * modes {
            let Some(firing) = next else { return true };
            let watch = ghost.watch(&structure, &firing);
            self.reset(&ghost.modes, watch, &mut spot.x);
            ghost.fire(&structure, &firing);
            moved.push(firing.unit);
            let sides = self.sides(&ghost, &spot);
            next = ghost.watches(&structure).find_map(|(unit, index, watch)| {
                let side = sides[watch.guard].seen(watch.sign);
                let other = side.may_be_held() && !moved.contains(&unit);
                (side.ends() && !other).then(|| Firing::at_once(unit, index, side))
            });
        }
        false
    }
}

/// Behaviour of a guard just after a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Course {
    /// It is on its right side, or leaves a zero of this multiplicity to it.
    Right(u8),
    /// It stays zero.
    Never,
    Held,
    Fires(Firing),
}

impl Firing {
    fn at_once(unit: usize, watch: usize, side: Side) -> Self {
        Self {
            theta: 0.0,
            unit,
            watch,
            cause: if side.zeros == 1 {
                Cause::Crossing
            } else {
                Cause::AtOnce
            },
        }
    }
}

impl Guarded {
    pub(crate) fn new(structure: &Structure, modes: &[Mode]) -> Self {
        Self {
            modes: modes.to_vec(),
            zero: vec![0; structure.guards.len()],
            held: Vec::new(),
        }
    }

    /// Whether the polynomial of a guard does not tell its side at the start of this step.
    pub(crate) fn is_zero(&self, guard: usize) -> bool {
        self.zero[guard] > 0
    }

    /// Whether a look is due at every step.
    pub(crate) fn is_wary(&self) -> bool {
        !self.held.is_empty() || self.zero.iter().any(|&zero| zero > 0)
    }

    /// The transitions now in force, with their unit and place.
    pub(crate) fn watches<'a>(
        &'a self,
        structure: &'a Structure,
    ) -> impl Iterator<Item = (usize, usize, &'a Watch)> {
        structure
            .units
            .iter()
            .zip(&self.modes)
            .enumerate()
            .flat_map(|(unit, (modes, &mode))| {
                modes[mode]
                    .iter()
                    .enumerate()
                    .map(move |(i, watch)| (unit, i, watch))
            })
    }

    /// The transition that fires.
    pub(crate) fn watch<'a>(&self, structure: &'a Structure, firing: &Firing) -> &'a Watch {
        &structure.units[firing.unit][self.modes[firing.unit]][firing.watch]
    }

    /// The earliest switch in this step. `poly(guard, out)` writes the guard's power coefficients in
    /// the step fraction and returns whether it could change sign at all; `spot` is the step's start.
    pub(crate) fn next(
        &mut self,
        structure: &Structure,
        table: &BernsteinTable,
        degree: usize,
        judge: &mut Judge,
        mut poly: impl FnMut(&Self, &Watch, &mut [f64]) -> bool,
        spot: impl Fn() -> Spot,
    ) -> Coming {
        let mut out = Coming {
            firing: None,
            until: 1.0,
            touches: Touches::default(),
        };
        let mut buffer = [0.0; MAX_DEGREE + 1];
        let power = &mut buffer[..=degree];
        let mut seen: Option<(Spot, Vec<Side>)> = None;
        for unit in 0..structure.units.len() {
            for (index, watch) in structure.units[unit][self.modes[unit]].iter().enumerate() {
                if !poly(self, watch, power) {
                    continue;
                }
                power.iter_mut().for_each(|a| *a *= watch.sign);
                let course = match self.plain_course(watch.guard, power) {
                    Some(zeros) => self.armed(unit, index, zeros),
                    None => {
                        let (spot, sides) = seen.get_or_insert_with(|| {
                            let spot = spot();
                            let sides = judge.sides(self, &spot);
                            (spot, sides)
                        });
                        let side = sides[watch.guard].seen(watch.sign);
                        self.course(unit, index, watch, side, spot, judge)
                    }
                };
                match course {
                    Course::Never => {}
                    Course::Fires(firing) => out.take(firing),
                    Course::Held => out.follow_held(unit, index, power, table),
                    Course::Right(zeros) => out.follow(unit, index, zeros.into(), power, table),
                }
            }
        }
        // A touch beyond the end will be met again in the next step.
        out.touches.count *= u32::from(out.touches.theta < out.until || out.until == 1.0);
        out
    }

    /// The switch that is due at this very point, if there is one.
    pub(crate) fn due(
        &mut self,
        structure: &Structure,
        judge: &mut Judge,
        spot: &Spot,
    ) -> Option<Firing> {
        let sides = judge.sides(self, spot);
        for unit in 0..structure.units.len() {
            for (index, watch) in structure.units[unit][self.modes[unit]].iter().enumerate() {
                let side = sides[watch.guard].seen(watch.sign);
                if let Course::Fires(firing) = self.course(unit, index, watch, side, spot, judge) {
                    return Some(firing);
                }
            }
        }
        None
    }

    /// Multiplicity of the zero that a guard leaves to its right side, if its polynomial leaves no doubt.
    fn plain_course(&self, guard: usize, power: &[f64]) -> Option<u8> {
        let size = power.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
        let zeros = self.zero[guard];
        let first = power.get(usize::from(zeros))?;
        (*first > SUSPICIOUS * size).then_some(zeros)
    }

    /// A guard on its right side is not held any more.
    fn armed(&mut self, unit: usize, index: usize, zeros: u8) -> Course {
        self.held.retain(|&held| held != (unit, index));
        Course::Right(zeros)
    }

    /// Behaviour of a guard by the side it is on.
    fn course(
        &mut self,
        unit: usize,
        index: usize,
        watch: &Watch,
        side: Side,
        spot: &Spot,
        judge: &mut Judge,
    ) -> Course {
        if !side.ends() {
            self.zero[watch.guard] = side.zeros;
            return match side.sign {
                0.0 => Course::Never,
                _ => self.armed(unit, index, side.zeros),
            };
        }
        let firing = Firing::at_once(unit, index, side);
        if !side.may_be_held() {
            return Course::Fires(firing);
        }
        if !self.held.contains(&(unit, index)) {
            if !side.close && judge.settles(self, spot, firing) {
                return Course::Fires(firing);
            }
            self.held.push((unit, index));
        }
        Course::Held
    }

    /// Guards that were zero at the step's start are watched again once they have left zero:
    /// `poly(guard, out)` writes the guard's power coefficients in the fraction of the step made.
    pub(crate) fn advanced(&mut self, degree: usize, mut poly: impl FnMut(usize, &mut [f64])) {
        for (guard, zero) in self.zero.iter_mut().enumerate() {
            if *zero > 0 {
                let mut buffer = [0.0; MAX_DEGREE + 1];
                let power = &mut buffer[..=degree];
                poly(guard, power);
                if has_left_zero(power, *zero) {
                    *zero = 0;
                }
            }
        }
    }

    /// Carries out a switch of the modes, and remembers which guards are zero now: those that are by construction,
    /// and its own and others that were, if neither a reset nor the change of mode moves them. Their derivatives
    /// may be others.
    pub(crate) fn fire(&mut self, structure: &Structure, firing: &Firing) {
        let unit = firing.unit;
        let watch = self.watch(structure, firing);
        let crosses = firing.cause == Cause::Crossing;
        if crosses {
            self.zero[watch.guard] = 1;
        }
        self.zero.iter_mut().for_each(|zero| *zero = (*zero).min(1));
        for &guard in &watch.moved {
            self.zero[guard] = 0;
        }
        for &(guard, multiplicity) in watch.vanishing.iter().filter(|_| crosses) {
            self.zero[guard] = multiplicity;
        }
        self.held.retain(|&(held, _)| held != unit);
        self.modes[unit] = watch.to;
    }
}

impl Coming {
    fn take(&mut self, firing: Firing) {
        if firing.theta < self.until || self.firing.is_none() && firing.theta == self.until {
            self.until = firing.theta;
            self.firing = Some(firing);
        }
    }

    /// A guard that starts on its right side.
    fn follow(
        &mut self,
        unit: usize,
        watch: usize,
        zeros: usize,
        power: &mut [f64],
        table: &BernsteinTable,
    ) {
        let Some(power) = without_zeros(power, zeros) else {
            return;
        };
        let descent = first_descent(power, table);
        if descent.touches > 0 {
            self.touches = Touches {
                count: descent.touches,
                unit,
                theta: descent.touch_at,
            };
        }
        if let Some(theta) = descent.at {
            self.take(Firing {
                theta,
                unit,
                watch,
                cause: Cause::Crossing,
            });
        }
    }

    /// A guard that starts beyond zero, on its way back: it is looked at again at zero, unless it turns
    /// away before.
    fn follow_held(
        &mut self,
        unit: usize,
        watch: usize,
        power: &mut [f64],
        table: &BernsteinTable,
    ) {
        let mut rate = [0.0; MAX_DEGREE + 1];
        let rate = &mut rate[..power.len()];
        for (k, a) in power.iter().enumerate().skip(1) {
            rate[k - 1] = k as f64 * a;
        }
        let size = rate.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
        let zeros = rate.iter().take_while(|a| a.abs() <= LEFT_ZERO * size);
        let zeros = zeros.count();
        power.iter_mut().for_each(|a| *a = -*a);
        let back = first_descent(power, table).at.unwrap_or(1.0);
        let turn = without_zeros(rate, zeros).and_then(|rate| first_descent(rate, table).at);
        match turn.filter(|&turn| turn < back) {
            Some(theta) => self.take(Firing {
                theta,
                unit,
                watch,
                cause: Cause::Turning,
            }),
            None if back < self.until => {
                self.until = back;
                self.firing = None;
            }
            None => {}
        }
    }
}

/// Whether a zero lies behind at the end of the step: the guard exceeds its rounding, and the residue
/// of the coefficients known to vanish. After a step of some rounding units it does not.
fn has_left_zero(power: &[f64], multiplicity: u8) -> bool {
    let (residue, rest) = power.split_at(usize::from(multiplicity).min(power.len()));
    let residue: f64 = residue.iter().map(|a| a.abs()).sum();
    let size = rest.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    rest.iter().sum::<f64>().abs() > (LEFT_ZERO * size).max(2.0 * residue)
}

/// The polynomial divided by the power of x that its vanishing coefficients leave, which moves none of its
/// other roots; `None` if nothing is left.
fn without_zeros(power: &mut [f64], zeros: usize) -> Option<&mut [f64]> {
    let zeros = zeros.min(power.len());
    power[..zeros].fill(0.0);
    let first = power.iter().position(|&a| a != 0.0)?;
    power.rotate_left(first);
    Some(power)
}
