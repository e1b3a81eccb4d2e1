//! Taylor series on eight asynchronous lanes.
//!
//! Each lane of the vector register is a trajectory with its own parameters, time, step, modes and
//! end; a lane that ends takes the next task. The series of all lanes are computed together; what
//! differs between lanes (step length, switches, samples) is a few scalar operations each. A single
//! trajectory is a run with seven idle lanes: the same code, hence the same bits.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use fearless_simd::{Level, Simd, SimdBase, dispatch};

use crate::arith::{Arith, LANES, Pack, Wide};
use crate::compile::Structure;
use crate::event::Firing;
use crate::lane::{Lane, Next};
use crate::polynomial::BernsteinTable;
use crate::run::{IntegrateError, Leg, Options, Status, Step, Task, check_stop};
use crate::series::{Series, expand};

/// Runs all tasks, at the best instruction set of this machine.
pub(crate) fn run<T: Task>(
    options: &Options,
    tolerance: f64,
    order: usize,
    tasks: &mut dyn Iterator<Item = T>,
    stop: &AtomicBool,
    done: &mut dyn FnMut(T),
) -> Result<(), IntegrateError> {
    let mut ensemble = Ensemble::new(tolerance, order);
    for slot in 0..LANES {
        ensemble.refill(slot, tasks, done)?;
    }
    let level = Level::new();
    while ensemble.busy() {
        check_stop(stop)?;
        dispatch!(level, simd => ensemble.expand(Wide(simd)));
        for slot in 0..LANES {
            ensemble.plan(slot);
        }
        dispatch!(level, simd => ensemble.advance(Wide(simd)));
        for slot in 0..LANES {
            if let Some(status) = ensemble.book(slot, options) {
                ensemble.retire(slot, status, tasks, done)?;
            }
        }
    }
    Ok(())
}

/// What a lane does in the coming step.
#[derive(Clone, Copy, Default)]
struct Plan {
    length: f64,
    firing: Option<Firing>,
    period_ends: bool,
    failed: bool,
}

struct Ensemble<T> {
    order: usize,
    tolerance: f64,
    table: BernsteinTable,
    structure: Option<Arc<Structure>>,
    lanes: [Option<Lane<T>>; LANES],
    plans: [Plan; LANES],
    coefficients: Vec<Pack>,
    series: Series<Pack>,
    /// Largest last, last-but-one and first coefficient of each lane.
    tail: [Pack; 3],
    /// Smallest and largest Bernstein coefficient of each guard over the step.
    bounds: Vec<[Pack; 2]>,
    lengths: Pack,
    x: Vec<f64>,
    dense: Vec<f64>,
}

impl<T: Task> Ensemble<T> {
    fn new(tolerance: f64, order: usize) -> Self {
        Self {
            order,
            tolerance,
            table: BernsteinTable::new(order),
            structure: None,
            lanes: std::array::from_fn(|_| None),
            plans: [Plan::default(); LANES],
            coefficients: Vec::new(),
            series: Series::default(),
            tail: [Pack::default(); 3],
            bounds: Vec::new(),
            lengths: Pack::default(),
            x: Vec::new(),
            dense: Vec::new(),
        }
    }

    fn busy(&self) -> bool {
        self.lanes.iter().any(Option::is_some)
    }

    /// Gives an idle lane its next task, skipping those with nothing to do.
    fn refill(
        &mut self,
        slot: usize,
        tasks: &mut dyn Iterator<Item = T>,
        done: &mut dyn FnMut(T),
    ) -> Result<(), IntegrateError> {
        for mut task in tasks {
            let first = task.begin();
            if let Some(task) = self.occupy(slot, task, first)? {
                done(task);
            } else {
                return Ok(());
            }
        }
        self.clear(slot);
        Ok(())
    }

    /// Runs `leg` on the lane, or gives the task back if there is none left to run.
    fn occupy(
        &mut self,
        slot: usize,
        mut task: T,
        mut leg: Option<Leg>,
    ) -> Result<Option<T>, IntegrateError> {
        while let Some(next) = leg {
            let structure = Arc::clone(
                self.structure
                    .get_or_insert_with(|| Arc::clone(&next.system.structure)),
            );
            if !Arc::ptr_eq(&structure, &next.system.structure)
                && *structure != *next.system.structure
            {
                return Err(IntegrateError::Structure);
            }
            let lane = Lane::new(task, &next)?;
            if lane.is_over() {
                (task, leg) = lane.finish(Status::Completed);
                continue;
            }
            self.coefficients
                .resize(next.system.coefficients.len(), Pack::default());
            if self.series.is_empty() {
                self.series = Series::new(&structure, self.order);
            }
            self.bounds
                .resize(structure.guards.len(), [Pack::default(); 2]);
            self.x.resize(structure.states, 0.0);
            for (state, &value) in next.start.x.iter().enumerate() {
                self.series.value(state).0[slot] = value;
            }
            self.lanes[slot] = Some(lane);
            self.load_coefficients(slot);
            return Ok(None);
        }
        Ok(Some(task))
    }

    /// An idle lane computes with zeros, which disturb nobody.
    fn clear(&mut self, slot: usize) {
        self.coefficients.iter_mut().for_each(|c| c.0[slot] = 0.0);
        self.series.cells().for_each(|c| c.0[slot] = 0.0);
        self.lengths.0[slot] = 0.0;
    }

    fn load_coefficients(&mut self, slot: usize) {
        if let Some(lane) = &self.lanes[slot] {
            let values = lane.system.coefficients_in(&lane.guarded.modes);
            for (pack, value) in self.coefficients.iter_mut().zip(values) {
                pack.0[slot] = value;
            }
        }
    }

    /// Series of all lanes, their tails, and the step they allow.
    #[inline(always)]
    fn expand<S: Simd>(&mut self, arith: Wide<S>) {
        let Some(structure) = self.structure.clone() else {
            return;
        };
        expand(arith, &structure, &self.coefficients, &mut self.series);
        let mut tail = [arith.splat(0.0); 3];
        for state in 0..structure.controlled {
            for (k, tail) in [self.order, self.order - 1, 0].into_iter().zip(&mut tail) {
                let term = arith.load(&self.series.of(state)[k]);
                // The maximum may drop a NaN; adding 0 x keeps it.
                *tail = tail.max(term.abs()) + term * arith.splat(0.0);
            }
        }
        self.tail = tail.map(|t| arith.store(t));
        for slot in 0..LANES {
            self.choose_length(slot);
        }
        self.bound_guards(arith, &structure);
    }

    /// Length of the step: the last two terms of the series stay below the tolerance (relative to the
    /// largest state once that exceeds 1), and it ends
    /// on the period's end at the latest.
    #[inline(always)]
    fn choose_length(&mut self, slot: usize) {
        let Some(lane) = &self.lanes[slot] else {
            return;
        };
        let [last, before, size] = self.tail.map(|t| t.0[slot]);
        let plan = &mut self.plans[slot];
        *plan = Plan::default();
        if !(last + before + size).is_finite() {
            plan.failed = true;
            self.lengths.0[slot] = 0.0;
            return;
        }
        let p = self.order as f64;
        let tolerance = self.tolerance * size.max(1.0);
        let allowed = root(tolerance / last.max(f64::MIN_POSITIVE), p)
            .min(root(tolerance / before.max(f64::MIN_POSITIVE), p - 1.0));
        let left = lane.system.period - lane.time;
        plan.period_ends = allowed >= left;
        plan.length = if plan.period_ends { left } else { allowed };
        self.lengths.0[slot] = plan.length;
    }

    /// Range of each guard over the step by its Bernstein coefficients: a lane whose guards keep
    /// their sign needs no root search.
    #[inline(always)]
    fn bound_guards<S: Simd>(&mut self, arith: Wide<S>, structure: &Structure) {
        let length = arith.load(&self.lengths);
        for (bounds, &node) in self.bounds.iter_mut().zip(&structure.guards) {
            let power = self.series.of(node);
            let mut scaled = [arith.splat(0.0); crate::polynomial::MAX_DEGREE + 1];
            let mut scale = arith.splat(1.0);
            for (scaled, a) in scaled.iter_mut().zip(power) {
                *scaled = arith.mul(arith.load(a), scale);
                scale = arith.mul(scale, length);
            }
            let (mut low, mut high) = (scaled[0], scaled[0]);
            for j in 1..=self.order {
                let mut b = scaled[0];
                for (&w, &a) in self.table.row(j)[1..].iter().zip(&scaled[1..]) {
                    b = arith.mul_add(arith.splat(w), a, b);
                }
                (low, high) = (low.min(b), high.max(b));
            }
            *bounds = [arith.store(low), arith.store(high)];
        }
    }

    /// Looks for a switch in the lane's step and shortens the step to it.
    fn plan(&mut self, slot: usize) {
        let (Some(lane), Some(structure)) = (&mut self.lanes[slot], &self.structure) else {
            return;
        };
        let plan = &mut self.plans[slot];
        if plan.failed {
            return;
        }
        let (series, bounds, length) = (&self.series, &self.bounds, plan.length);
        let guarded = &lane.guarded;
        let (firing, touches) = guarded.next(structure, &self.table, self.order, |watch, power| {
            let [low, high] = &bounds[watch.guard];
            let safe = if watch.sign > 0.0 {
                low.0[slot] > 0.0
            } else {
                high.0[slot] < 0.0
            };
            if safe && !guarded.is_zero(watch.guard) {
                return false;
            }
            let node = structure.guards[watch.guard];
            let mut scale = 1.0;
            for (out, a) in power.iter_mut().zip(series.of(node)) {
                *out = a.0[slot] * scale;
                scale *= length;
            }
            true
        });
        lane.touched(touches, length);
        if let Some(firing) = firing {
            plan.firing = Some(firing);
            plan.length = firing.theta * length;
            plan.period_ends &= firing.theta == 1.0;
            self.lengths.0[slot] = plan.length;
        }
        if lane.wants_steps && plan.length > 0.0 {
            self.dense.clear();
            for state in 0..structure.states {
                self.dense
                    .extend(series.of(state).iter().map(|a| a.0[slot]));
            }
            let step = Step {
                period: lane.period,
                time: lane.time,
                length: plan.length,
                modes: &lane.guarded.modes,
                degree: self.order,
                power: &self.dense,
            };
            lane.task.step(&step);
        }
        if plan.length > 0.0 {
            let h = plan.length;
            lane.guarded.advanced(self.order, |guard, power| {
                let mut scale = 1.0;
                for (out, a) in power.iter_mut().zip(series.of(structure.guards[guard])) {
                    *out = a.0[slot] * scale;
                    scale *= h;
                }
            });
        }
    }

    /// States at the end of each lane's step, by Horner's scheme, in place of the order-0 terms.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, arith: Wide<S>) {
        let Some(structure) = &self.structure else {
            return;
        };
        let h = arith.load(&self.lengths);
        for state in 0..structure.states {
            let power = self.series.of_mut(state);
            let mut sum = arith.load(&power[self.order]);
            for a in power[..self.order].iter().rev() {
                sum = arith.mul_add(sum, h, arith.load(a));
            }
            power[0] = arith.store(sum);
        }
    }

    /// Books the step; `Some` if the leg is over.
    fn book(&mut self, slot: usize, options: &Options) -> Option<Status> {
        let lane = self.lanes[slot].as_mut()?;
        let plan = self.plans[slot];
        for (state, x) in self.x.iter_mut().enumerate() {
            *x = self.series.of(state)[0].0[slot];
        }
        if plan.failed {
            let finite = |state: &usize| {
                let power = self.series.of(*state);
                power.iter().all(|a| a.0[slot].is_finite())
            };
            let bad = (0..self.x.len()).find(|state| !finite(state)).unwrap_or(0);
            return Some(lane.not_finite(bad));
        }
        // Most steps neither switch nor end a period and leave the state as it is.
        let changes = plan.firing.is_some() || plan.period_ends;
        let next = lane.accept(
            options,
            plan.length,
            plan.firing,
            plan.period_ends,
            &mut self.x,
        );
        if changes {
            for (state, &x) in self.x.iter().enumerate() {
                self.series.value(state).0[slot] = x;
            }
        }
        if plan.firing.is_some() {
            self.load_coefficients(slot);
        }
        match next {
            Next::Go => None,
            Next::Over(status) => Some(status),
        }
    }

    /// Ends the lane's leg; the task's next leg or the next task takes its place.
    fn retire(
        &mut self,
        slot: usize,
        status: Status,
        tasks: &mut dyn Iterator<Item = T>,
        done: &mut dyn FnMut(T),
    ) -> Result<(), IntegrateError> {
        if let Some(lane) = self.lanes[slot].take() {
            self.clear(slot);
            let (task, next) = lane.finish(status);
            if let Some(task) = self.occupy(slot, task, next)? {
                done(task);
                self.refill(slot, tasks, done)?;
            }
        }
        Ok(())
    }
}

/// x^(1/p) to a few per cent, from the exponent's bits: enough to choose a step, and a hundred times
/// cheaper than `powf`.
#[inline(always)]
fn root(x: f64, p: f64) -> f64 {
    const ONE: f64 = 4_607_182_418_800_017_408.0; // bits of 1.0
    let bits = (x.to_bits() as f64 - ONE) / p + ONE;
    f64::from_bits(bits as u64)
}
