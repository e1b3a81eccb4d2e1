//! diffsol's explicit Runge-Kutta method tsit45 with its root finder.

use std::cell::Cell;
use std::f64::consts::TAU;

use diffsol::{
    NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason,
    VectorCommon,
};

use crate::Samples;
use crate::problem::Field;

/// Stroboscopic samples: the first after `first` periods, then after each of `more`.
pub fn run<const P: usize, const S: usize>(
    field: &Field<P, S>,
    tolerance: f64,
    first: u32,
    more: u32,
) -> Samples {
    let (start, on_floor) = field.start();
    let floor = Cell::new(on_floor);
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance])
        .h0(0.01)
        .rhs(|x: &[f64], _p: &[f64], t: f64, dx: &mut [f64]| {
            let (sin, cos) = t.sin_cos();
            field.rates(floor.get(), x, cos, sin, dx);
        })
        .init(
            |_p: &[f64], _t: f64, x: &mut [f64]| x.copy_from_slice(&start),
            S,
        )
        .root(
            |x: &[f64], _p: &[f64], t: f64, guard: &mut [f64]| {
                let (sin, cos) = t.sin_cos();
                guard[0] = field.force(x, cos, sin);
            },
            1,
        )
        .build()
        .expect("a valid problem");
    let mut solver = problem.tsit45().expect("a solver");
    let mut samples = Samples::default();
    for period in first..=first + more {
        until(&mut solver, f64::from(period) * TAU, field, &floor);
        samples.keep(
            field.z(solver.state().y.inner().as_slice()),
            solver.state().y.inner().as_slice(),
        );
    }
    samples
}

fn until<'a, const P: usize, const S: usize, E, M>(
    solver: &mut M,
    end: f64,
    field: &Field<P, S>,
    floor: &Cell<bool>,
) where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
    M: OdeSolverMethod<'a, E>,
{
    solver.set_stop_time(end).expect("a later time");
    loop {
        match solver.step().expect("a step") {
            OdeSolverStopReason::InternalTimestep => {}
            OdeSolverStopReason::TstopReached => return,
            OdeSolverStopReason::RootFound(t, _) => {
                solver.state_mut_back(t).expect("a time within the step");
                let (sin, cos) = t.sin_cos();
                // F' is continuous across the switch; its sign says which phase follows.
                floor.set(field.force_rate(solver.state().dy.inner().as_slice(), cos, sin) > 0.0);
            }
        }
    }
}
