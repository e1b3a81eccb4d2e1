//! The tangent flow: against finite differences, closed forms and Liouville's formula.

#![allow(clippy::unwrap_used)]

use saltus_hybrid::{
    Leg, Method, Options, Point, Status, System, SystemBuilder, Transition, record, testing,
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
    let leg = Leg {
        system: system.clone(),
        start,
        periods,
    };
    let run = record(&leg, &options(method)).unwrap();
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
                assert!((a - b).abs() < 1e-7, "{a} {b}"); // tolerance 1e-9, some growth of errors
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
