//! Which switch comes next: the rules of zeros, shared by all steppers.
//!
//! A step is half open, (t0, t1]. A guard that is zero at t0 is inactive until it leaves zero; which
//! way it leaves is read from its first nonzero derivative. A guard already on the wrong side fires
//! at once, so that nobody falls for ever because a root sat at the start of a step.

use crate::compile::{Structure, Watch};
use crate::polynomial::{BernsteinTable, MAX_DEGREE, first_descent};
use crate::system::Mode;

/// A guard counts as having left zero when it exceeds this part of its own Taylor terms; below zero
/// by less, it counts as zero.
const LEFT_ZERO: f64 = 1e-12;

/// What a stepper must know of one trajectory to watch its guards.
#[derive(Clone, Debug)]
pub(crate) struct Guarded {
    /// Mode of each unit.
    pub(crate) modes: Vec<Mode>,
    /// Multiplicity of each guard's zero at the present point; 0 if it is not zero.
    zero: Vec<u8>,
}

/// The next switch within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Firing {
    /// Fraction of the step, in [0, 1]; 0 means at once.
    pub(crate) theta: f64,
    pub(crate) unit: usize,
    /// Index among the transitions of the unit's mode.
    pub(crate) watch: usize,
    /// Whether the guard is zero there; not if it was on the wrong side already.
    pub(crate) on_zero: bool,
}

/// Tangencies met on the way: how many, the guard and the place of the last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Touches {
    pub(crate) count: u32,
    pub(crate) unit: usize,
    pub(crate) theta: f64,
}

impl Guarded {
    pub(crate) fn new(structure: &Structure, modes: &[Mode]) -> Self {
        Self {
            modes: modes.to_vec(),
            zero: vec![0; structure.guards.len()],
        }
    }

    /// Whether a guard must be treated as zero at the start of this step.
    pub(crate) fn is_zero(&self, guard: usize) -> bool {
        self.zero[guard] > 0
    }

    /// Whether any must.
    pub(crate) fn any_zero(&self) -> bool {
        self.zero.iter().any(|&zero| zero > 0)
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

    /// The earliest switch in this step. `poly(guard, out)` writes the guard's power coefficients in
    /// the step fraction and says whether it could change sign at all.
    pub(crate) fn next(
        &self,
        structure: &Structure,
        table: &BernsteinTable,
        degree: usize,
        mut poly: impl FnMut(&Watch, &mut [f64]) -> bool,
    ) -> (Option<Firing>, Touches) {
        let mut best: Option<Firing> = None;
        let mut touches = Touches::default();
        let mut buffer = [0.0; MAX_DEGREE + 1];
        let power = &mut buffer[..=degree];
        for (unit, index, watch) in self.watches(structure) {
            if !poly(watch, power) {
                continue;
            }
            power.iter_mut().for_each(|a| *a *= watch.sign);
            let multiplicity = self.zero[watch.guard].max(u8::from(just_below_zero(power)));
            let on_zero = power[0] == 0.0 || multiplicity > 0;
            let theta = match leaves_zero(power, multiplicity) {
                Start::Wrong => Some(0.0),
                Start::Never => None,
                Start::Right => {
                    let descent = first_descent(power, table);
                    if descent.touches > 0 {
                        touches = Touches {
                            count: descent.touches,
                            unit,
                            theta: descent.touch_at,
                        };
                    }
                    descent.at
                }
            };
            if let Some(theta) = theta.filter(|&t| best.is_none_or(|b| t < b.theta)) {
                best = Some(Firing {
                    theta,
                    unit,
                    watch: index,
                    on_zero: on_zero || theta > 0.0,
                });
            }
        }
        // A touch beyond the switch will be met again in the next step.
        touches.count *= u32::from(best.is_none_or(|b| touches.theta < b.theta));
        (best, touches)
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

    /// Carries out a switch of the modes, and remembers which guards are zero now.
    pub(crate) fn fire(&mut self, structure: &Structure, firing: &Firing) {
        let unit = firing.unit;
        let watch = &structure.units[unit][self.modes[unit]][firing.watch];
        for &(guard, multiplicity) in &watch.vanishing {
            let own = guard == watch.guard;
            self.zero[guard] = match (firing.on_zero, own) {
                (true, _) => multiplicity,
                (false, true) => 0,
                (false, false) => multiplicity.min(1),
            };
        }
        self.modes[unit] = watch.to;
    }
}

enum Start {
    Right,
    Wrong,
    Never,
}

/// Whether a zero lies behind at the end of the step: the guard exceeds its rounding, and the residue
/// of the coefficients known to vanish. After a step of some rounding units it does not.
fn has_left_zero(power: &[f64], multiplicity: u8) -> bool {
    let (residue, rest) = power.split_at(usize::from(multiplicity).min(power.len()));
    let residue: f64 = residue.iter().map(|a| a.abs()).sum();
    let size = rest.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    rest.iter().sum::<f64>().abs() > (LEFT_ZERO * size).max(2.0 * residue)
}

/// Whether a guard is on the wrong side by no more than rounding: it reached zero at the end of the
/// last step, together with another one or with the sampling instant.
fn just_below_zero(power: &[f64]) -> bool {
    let size = power.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    power[0] < 0.0 && -power[0] <= LEFT_ZERO * size
}

/// Which side a guard is on just after the start; coefficients known to vanish are made zero, and
/// the polynomial is divided by the power of x they leave, which moves none of its other roots.
fn leaves_zero(power: &mut [f64], multiplicity: u8) -> Start {
    let known = usize::from(multiplicity).min(power.len());
    power[..known].fill(0.0);
    let Some(first) = power.iter().position(|&a| a != 0.0) else {
        return Start::Never;
    };
    if power[first] < 0.0 {
        return Start::Wrong;
    }
    power.rotate_left(first);
    Start::Right
}
