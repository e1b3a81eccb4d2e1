//! Every kind of integration fits a small stack, optimised or not: whoever depends on this crate may run it in
//! any thread, in any profile. The programs that are written out have their own test, in `saltus`.

#![allow(clippy::unwrap_used)]

use saltus_hybrid::{
    Instructions, Method, Options, Segment, Status, System, SystemBuilder, Transition, record,
};

/// Half of what the least of the usual threads have (1 MiB on Windows, 2 MiB in Rust).
const STACK: usize = 512 << 10;

/// An impact oscillator beside `more` swings coupled by every operation there is. Above 340 swings its nodes no
/// longer fit the small table of the interpreter.
fn swings(more: usize) -> System {
    let n = more + 1;
    let mut b = SystemBuilder::new(2 * n);
    let (cos, sin) = b.drive(1.3);
    let late = b.reserve_adiabatic(2);
    let x: Vec<_> = (0..n).map(|i| b.state(i)).collect();
    let speeds: Vec<_> = (n..2 * n).map(|i| b.state(i)).collect();
    let y = [x[0], x[n / 2], x[n - 1]];
    let friction = b.products(&[(y[0], speeds[0]), (y[1], speeds[0]), (y[2], speeds[0])]);
    let a = vec![
        vec![0.2, 0.1, 0.1],
        vec![0.1, 0.2, 0.0],
        vec![0.1, 0.0, 0.3],
    ];
    let (squares, cubes) = b.cubic(&y, &a, 1, &friction);
    b.define_adiabatic(
        &squares[..2],
        0.1,
        &[vec![vec![1e-3, 0.0], vec![0.0, 1e-3]]],
    );
    let more = b.squares(&speeds[..1]);
    let near = |i: usize| x[(i + 1) % n];
    let pulls: Vec<_> = (0..n)
        .map(|i| b.linear(0.0, &[(-1.0, x[i]), (0.1, near(i)), (-0.2, speeds[i])]))
        .collect();
    let beside = b.matrix(
        &[cos, sin, squares[0]],
        &[vec![0.5, 0.0, 0.1], vec![0.0, 0.3, 0.0]],
    );
    for i in 0..n {
        let all = [
            (1.0, pulls[i]),
            (1.0, beside[i % 2]),
            (-1.0, cubes[i % 3]),
            (0.01, late[i % 2]),
            (-0.01, more[0]),
        ];
        let rate = b.linear(0.0, &all);
        b.derivative(i, speeds[i]);
        b.derivative(n + i, rate);
    }
    let gap = b.linear(0.2, &[(1.0, x[0])]);
    let rebound = b.linear(0.0, &[(-0.7, speeds[0])]);
    b.unit(vec![vec![Transition::falling(gap, 0).reset(n, rebound)]]);
    b.build(0.0).unwrap()
}

fn runs_in_a_small_stack(system: System, periods: u64) {
    let mut start = system.point(&[0], &[0.3]);
    system.columns_mut(&mut start.x).fill(0.1);
    let segment = Segment {
        system,
        start,
        periods,
    };
    let run = move || {
        let taylor = Method::taylor(1e-10);
        let rk4 = Method::Rk4 {
            steps_per_period: 20,
        };
        for (method, instructions) in [
            (taylor, Instructions::Best),
            (taylor, Instructions::Avx2),
            (taylor, Instructions::Baseline),
            (rk4, Instructions::Best),
        ] {
            let options = Options {
                method,
                instructions,
                ..Options::default()
            };
            let end = record(&segment, &options).unwrap().end;
            assert_eq!(end.status, Status::Completed);
            assert!(end.switches > 0, "no switch was met");
        }
    };
    in_a_small_stack(run);
}

fn in_a_small_stack<O: Send + 'static>(work: impl FnOnce() -> O + Send + 'static) -> O {
    let thread = std::thread::Builder::new().stack_size(STACK);
    thread.spawn(work).unwrap().join().unwrap()
}

#[test]
fn a_small_program_runs_in_512_kib() {
    runs_in_a_small_stack(swings(2), 3);
}

#[test]
fn tangents_run_in_512_kib() {
    runs_in_a_small_stack(swings(2).with_tangents(6).unwrap(), 3);
}

#[test]
fn a_large_program_runs_in_512_kib() {
    runs_in_a_small_stack(swings(400), 1);
}

#[test]
fn a_system_is_made_in_512_kib() {
    let states = in_a_small_stack(|| swings(400).with_tangents(1).unwrap().state_len());
    assert_eq!(states, 2 * 802 + 2); // with the drive
}
