//! The tangent flow: against finite differences, closed forms and Liouville's formula.

#![allow(clippy::unwrap_used)]

use saltus_hybrid::{
    Method, Options, Point, Segment, Status, System, SystemBuilder, Transition, record, testing,
};

fn options(method: Method) -> Options {
    Options {
        method,
        ..Options::default()
    }
}

const TAYLOR: Method = Method::Taylor {
    tolerance: 1e-14,
    order: 22,
};

fn run(system: &System, start: Point, periods: u64, method: Method) -> Point {
    let segment = Segment {
        system: system.clone(),
        start,
        periods,
    };
    let run = record(&segment, &options(method)).unwrap();
    assert_eq!(run.end.status, Status::Completed);
    run.end.point
}

/// All columns of d(end)/d(start), column by column, and the end.
fn tangent(
    system: &System,
    start: &Point,
    size: usize,
    periods: u64,
    method: Method,
) -> (Vec<f64>, Point) {
    let wide = system.with_tangents(size).unwrap();
    let mut from = wide.point(&start.modes, &start.x);
    let columns = wide.columns_mut(&mut from.x);
    (0..size).for_each(|i| columns[i * size + i] = 1.0);
    let end = run(&wide, from, periods, method);
    (wide.columns(&end.x).to_vec(), end)
}

/// The largest difference of the tangent flow from central differences of the flow, over its largest entry.
fn against_differences(
    system: &System,
    modes: &[usize],
    x: &[f64],
    periods: u64,
    method: Method,
    step: f64,
) -> f64 {
    let start = system.point(modes, x);
    let (columns, _) = tangent(system, &start, x.len(), periods, method);
    let largest = columns.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    let mut worst: f64 = 0.0;
    for (i, column) in columns.chunks(x.len()).enumerate() {
        let moved = |by: f64| {
            let mut x = x.to_vec();
            x[i] += by;
            run(system, system.point(modes, &x), periods, method).x
        };
        let (ahead, behind) = (moved(step), moved(-step));
        for (j, exact) in column.iter().enumerate() {
            let difference = (ahead[j] - behind[j]) / (2.0 * step);
            worst = worst.max((difference - exact).abs() / largest);
        }
    }
    worst
}

fn determinant(columns: &[f64], n: usize) -> f64 {
    let mut a: Vec<Vec<f64>> = columns.chunks(n).map(<[f64]>::to_vec).collect();
    let mut det = 1.0;
    for i in 0..n {
        let pivot = (i..n)
            .max_by(|&p, &q| a[p][i].abs().total_cmp(&a[q][i].abs()))
            .unwrap();
        if pivot != i {
            a.swap(i, pivot);
            det = -det;
        }
        det *= a[i][i];
        let (done, rest) = a.split_at_mut(i + 1);
        let row = &done[i];
        for other in rest {
            let factor = other[i] / row[i];
            other
                .iter_mut()
                .zip(row)
                .for_each(|(x, y)| *x -= factor * y);
        }
    }
    det
}

/// Lorenz 63 with sigma 10, rho 28, beta 8/3.
fn lorenz(interval: f64) -> System {
    let mut b = SystemBuilder::new(3);
    let [x, y, z] = [0, 1, 2].map(|i| b.state(i));
    let products = b.products(&[(x, z), (x, y)]);
    let dx = b.linear(0.0, &[(-10.0, x), (10.0, y)]);
    let dy = b.linear(0.0, &[(28.0, x), (-1.0, y), (-1.0, products[0])]);
    let dz = b.linear(0.0, &[(-8.0 / 3.0, z), (1.0, products[1])]);
    [dx, dy, dz]
        .into_iter()
        .enumerate()
        .for_each(|(i, d)| b.derivative(i, d));
    b.build(interval).unwrap()
}

/// x'' + 0.1 x' + x + x^3 + its coupling to y likewise, by the operations for quartic energies, with a wall.
fn quartic(wall: f64) -> System {
    let mut b = SystemBuilder::new(4);
    let (x, y) = (b.state(0), b.state(1));
    let (vx, vy) = (b.state(2), b.state(3));
    let (cos, _) = b.drive(1.3);
    let frame = b.matrix(&[x, y], &[vec![1.0, 0.0], vec![0.0, 1.0], vec![1.0, 1.0]]);
    let speeds = b.squares(&[vx, vy]);
    let added = b.matrix(&speeds, &[vec![0.1, 0.0], vec![0.0, 0.2], vec![0.03, 0.02]]);
    let a = vec![
        vec![1.0, 0.4, 0.1],
        vec![0.4, 0.7, 0.0],
        vec![0.1, 0.0, 0.3],
    ];
    let (squares, products) = b.cubic(&frame, &a, 1, &added);
    let ax = b.linear(
        0.0,
        &[
            (-1.0, x),
            (-0.1, vx),
            (-1.0, products[0]),
            (-1.0, products[2]),
            (0.8, cos),
            (0.05, squares[1]),
        ],
    );
    let unit = b.reserve_unit();
    let push = b.gated_linear(unit, &[0.0, 3.0], &[(1.0, y), (0.2, vy)]);
    let ay = b.linear(
        0.3,
        &[
            (-2.0, y),
            (-0.1, vy),
            (-1.0, products[1]),
            (-1.0, products[2]),
            (-1.0, push),
        ],
    );
    b.derivative(0, vx);
    b.derivative(1, vy);
    b.derivative(2, ax);
    b.derivative(3, ay);
    let over = b.linear(-wall, &[(1.0, y)]);
    let rebound = b.linear(0.0, &[(0.7, vy), (0.1, x)]);
    b.define_unit(
        unit,
        vec![
            vec![Transition::rising(over, 1).reset(3, rebound)],
            vec![Transition::falling(over, 0)],
        ],
    );
    b.build(0.0).unwrap()
}

#[test]
fn saltation_matches_finite_differences() {
    // a bounce reverses the speed, a spring's stiffness jumps, a field and a state jump together
    let ball = testing::bouncing_ball(1.0, 0.8, 4.0);
    assert!(against_differences(&ball, &[0], &[1.0, 0.2], 1, TAYLOR, 1e-5) < 1e-8);
    let spring = testing::bilinear_oscillator(4.0, 7.0);
    assert!(against_differences(&spring, &[0], &[-1.0, 0.3], 1, TAYLOR, 1e-5) < 1e-8);
    let walls = quartic(0.2);
    for periods in 1..=3 {
        let worst =
            against_differences(&walls, &[0], &[0.3, -0.4, 0.2, 0.6], periods, TAYLOR, 1e-6);
        assert!(worst < 1e-7, "{periods}: {worst}");
    }
    assert!(against_differences(&lorenz(1.0), &[], &[1.0, 2.0, 20.0], 1, TAYLOR, 1e-5) < 1e-8);
}

#[test]
fn rk4_carries_the_tangent_flow_to_its_order() {
    let walls = quartic(0.2);
    let start = walls.point(&[0], &[0.3, -0.4, 0.2, 0.6]);
    let (exact, _) = tangent(&walls, &start, 4, 2, TAYLOR);
    let error = |steps_per_period| {
        let (columns, _) = tangent(&walls, &start, 4, 2, Method::Rk4 { steps_per_period });
        columns
            .iter()
            .zip(&exact)
            .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    };
    let ratio = error(400) / error(800);
    assert!((11.0..23.0).contains(&ratio), "{ratio}");
}

#[test]
fn a_bounce_of_a_ball_has_its_closed_form() {
    // From height h at rest: t = sqrt(2h/g) of fall, then up with e sqrt(2gh). The state at T is linear
    // in nothing, but its derivative with respect to h is exact in closed form.
    let (g, e, h, period): (f64, f64, f64, f64) = (1.0, 0.8, 1.0, 2.0);
    let ball = testing::bouncing_ball(g, e, period);
    let (columns, end) = tangent(&ball, &ball.point(&[0], &[h, 0.0]), 2, 1, TAYLOR);
    let fall = (2.0 * h / g).sqrt();
    let left = period - fall;
    // z = e g fall left - g left^2/2, v = e g fall - g left, dfall/dh = 1/(g fall)
    let rate = 1.0 / (g * fall);
    let dz = rate * (e * g * left - e * g * fall + g * left);
    let dv = rate * (e * g + g);
    assert!(
        (columns[0] - dz).abs() < 1e-12 && (columns[1] - dv).abs() < 1e-12,
        "{columns:?}"
    );
    assert!((end.x[0] - (e * g * fall * left - g * left * left / 2.0)).abs() < 1e-12);
    // A bounce multiplies areas by e^2: e for the speed, e for the later departure.
    assert!((determinant(&columns, 2) - e * e).abs() < 1e-12);
}

#[test]
fn the_determinant_is_liouvilles() {
    // tr Df = -(10 + 1 + 8/3) everywhere
    let (columns, _) = tangent(
        &lorenz(0.5),
        &lorenz(0.5).point(&[], &[3.0, -2.0, 15.0]),
        3,
        1,
        TAYLOR,
    );
    let expected = (-(11.0 + 8.0 / 3.0) * 0.5_f64).exp();
    assert!((determinant(&columns, 3) / expected - 1.0).abs() < 1e-10);
    // a continuous field leaves it alone at switches
    let (zeta, omega) = (0.05, 1.1);
    let system = testing::forced_oscillator(zeta, 1.0, omega, 0.3);
    let (columns, _) = tangent(&system, &system.point(&[0], &[0.1, 0.5]), 2, 3, TAYLOR);
    let expected = (-2.0 * zeta * 3.0 * std::f64::consts::TAU / omega).exp();
    assert!((determinant(&columns, 2) / expected - 1.0).abs() < 1e-12);
}

#[test]
fn the_trajectory_is_the_same_with_and_without_tangents() {
    for (system, modes, x) in [
        (quartic(0.2), vec![0], vec![0.3, -0.4, 0.2, 0.6]),
        (lorenz(1.0), vec![], vec![1.0, 2.0, 20.0]),
    ] {
        let plain = run(&system, system.point(&modes, &x), 5, Method::taylor(1e-9));
        for columns in [1, 3] {
            let wide = system.with_tangents(columns).unwrap();
            let mut start = wide.point(&modes, &x);
            wide.columns_mut(&mut start.x).fill(0.3);
            let end = run(&wide, start, 5, Method::taylor(1e-9));
            for (a, b) in end.x.iter().zip(&plain.x) {
                // tolerance 1e-9 of states up to 40, some growth of errors
                assert!((a - b).abs() < 1e-6, "{a} {b}");
            }
            assert_eq!(end.modes, plain.modes);
        }
    }
}

#[test]
fn columns_do_not_depend_on_their_neighbours() {
    let system = quartic(0.2);
    let start = system.point(&[0], &[0.3, -0.4, 0.2, 0.6]);
    let (all, _) = tangent(&system, &start, 4, 2, TAYLOR);
    for (i, column) in all.chunks(4).enumerate() {
        let single = system.with_tangents(1).unwrap();
        let mut from = single.point(&start.modes, &start.x[..4]);
        single.columns_mut(&mut from.x)[i] = 1.0;
        let end = run(&single, from, 2, TAYLOR);
        for (a, b) in single.columns(&end.x).iter().zip(column) {
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
    }
}

/// An oscillator of stiffness 1 under cos(omega t) with dry friction mu: right, left, and, if asked for, a stick
/// between them that may last no time.
fn dry_friction(mu: f64, omega: f64, sticks: bool) -> System {
    let mut b = SystemBuilder::new(2);
    let (x, v) = (b.state(0), b.state(1));
    let (cos, _) = b.drive(omega);
    let unit = b.reserve_unit();
    let one = b.linear(1.0, &[]);
    let pull = b.linear(0.0, &[(1.0, cos), (-1.0, x)]);
    let slides = if sticks {
        vec![1.0, 1.0, 0.0]
    } else {
        vec![1.0; 2]
    };
    let signs: Vec<f64> = [-mu, mu, 0.0][..slides.len()].to_vec();
    let dx = b.gate(unit, &slides, v);
    let pulled = b.gate(unit, &slides, pull);
    let friction = b.gate(unit, &signs, one);
    let dv = b.linear(0.0, &[(1.0, pulled), (1.0, friction)]);
    b.derivative(0, dx);
    b.derivative(1, dv);
    let (right, left) = (b.linear(-mu, &[(1.0, pull)]), b.linear(mu, &[(1.0, pull)]));
    let zero = b.linear(0.0, &[]);
    let stop = usize::from(sticks) * 2;
    let modes = vec![
        vec![Transition::falling(v, if sticks { stop } else { 1 }).reset(1, zero)],
        vec![Transition::rising(v, stop).reset(1, zero)],
        vec![Transition::rising(right, 0), Transition::falling(left, 1)],
    ];
    let modes = modes.into_iter().take(slides.len()).collect();
    b.define_unit(unit, modes);
    b.build(0.0).unwrap()
}

#[test]
fn a_switch_at_once_after_another_moves_in_time_with_it() {
    // At mu 0.1 the motion turns round without sticking: the two-mode form says what the chain must give. The
    // rate of the pull leads back or on where it fires, by the frequency.
    for omega in [0.7, 0.45, 1.3] {
        let [two, three] = [false, true].map(|sticks| {
            let system = dry_friction(0.1, omega, sticks);
            let start = system.point(&[0], &[-3.0, 2.0]);
            tangent(&system, &start, 2, 2, TAYLOR)
        });
        for (a, b) in two.0.iter().zip(&three.0) {
            assert!((a - b).abs() < 1e-11, "{omega}: {two:?} {three:?}");
        }
        assert!((two.1.x[0] - three.1.x[0]).abs() < 1e-12);
        let system = dry_friction(0.1, omega, true);
        let worst = against_differences(&system, &[0], &[-1.9, 0.4], 2, TAYLOR, 1e-6);
        assert!(worst < 1e-7, "{omega} {worst}");
    }
}

#[test]
fn sticking_forgets_how_it_was_reached() {
    // At mu 0.8 it sticks for a while: both columns lie along the set of rest afterwards.
    let system = dry_friction(0.8, 0.7, true);
    let worst = against_differences(&system, &[0], &[-1.9, 0.4], 2, TAYLOR, 1e-6);
    assert!(worst < 1e-7, "{worst}");
}

#[test]
fn a_guard_carried_across_zero_moves_in_time_with_what_carries_it() {
    // A carrier of rate 1 + x/10 falls from 1 to 0 and so switches the damping of x'' = -x - d x' + d.
    let mut b = SystemBuilder::new(3);
    let [c, x, v] = [0, 1, 2].map(|i| b.state(i));
    let rate = b.linear(1.0, &[(0.1, x)]);
    let zero = b.linear(0.0, &[]);
    let (top, above) = (b.linear(-1.0, &[(1.0, c)]), b.linear(-0.3, &[(1.0, c)]));
    b.unit(vec![vec![Transition::rising(top, 0).reset(0, zero)]]);
    let on = b.unit(vec![
        vec![Transition::rising(above, 1)],
        vec![Transition::falling(above, 0)],
    ]);
    let push = b.linear(1.0, &[(-0.3, v)]);
    let pushed = b.gate(on, &[1.0, 0.0], push);
    let dv = b.linear(0.0, &[(-1.0, x), (1.0, pushed)]);
    b.derivative(0, rate);
    b.derivative(1, v);
    b.derivative(2, dv);
    let system = b.build(2.7).unwrap();
    let worst = against_differences(&system, &[0, 0], &[0.1, 0.2, 0.3], 2, TAYLOR, 1e-6);
    assert!(worst < 1e-7, "{worst}");
}

#[test]
fn a_held_guard_that_turns_away_has_its_columns() {
    // Kelvin-Voigt contact entered from flight below the floor, where the speed changes sign.
    let mut b = SystemBuilder::new(2);
    let (y, v) = (b.state(0), b.state(1));
    let unit = b.reserve_unit();
    let force = b.linear(0.0, &[(-100.0, y), (-4.0, v)]);
    let gated = b.gate(unit, &[0.0, 1.0], force);
    let a = b.linear(-9.81, &[(1.0, gated), (-0.3, v)]);
    b.derivative(0, v);
    b.derivative(1, a);
    let flight = vec![Transition::falling(y, 1)];
    b.define_unit(unit, vec![flight, vec![Transition::falling(force, 0)]]);
    let system = b.build(0.1).unwrap();
    // differences of rates in the turn, and of trajectories here
    let worst = against_differences(&system, &[0], &[-0.001, 0.1], 1, TAYLOR, 1e-6);
    assert!(worst < 1e-6, "{worst}");
}
