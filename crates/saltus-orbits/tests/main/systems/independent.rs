//! Textbook methods that share nothing with the code under test.

use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};

/// x(t1) from x(t0) by the classical Runge-Kutta method.
pub(crate) fn rk4<const N: usize>(
    field: impl Fn(f64, &[f64; N]) -> [f64; N],
    mut x: [f64; N],
    t0: f64,
    t1: f64,
    steps: usize,
) -> [f64; N] {
    let h = (t1 - t0) / steps as f64;
    let moved = |x: &[f64; N], by: f64, k: &[f64; N]| std::array::from_fn(|i| x[i] + by * k[i]);
    for step in 0..steps {
        let t = t0 + step as f64 * h;
        let a = field(t, &x);
        let b = field(t + h / 2.0, &moved(&x, h / 2.0, &a));
        let c = field(t + h / 2.0, &moved(&x, h / 2.0, &b));
        let d = field(t + h, &moved(&x, h, &c));
        x = std::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
    }
    x
}

/// A zero of f near `x`: Newton's method, with central differences.
pub(crate) fn newton<const N: usize>(
    f: impl Fn(&[f64; N]) -> [f64; N],
    mut x: [f64; N],
) -> [f64; N] {
    for _ in 0..20 {
        let value = f(&x);
        let column = |j: usize| {
            let h = 1e-5 * x[j].abs().max(1.0);
            let shifted = |by: f64| {
                let mut there = x;
                there[j] += by;
                f(&there)
            };
            let (up, down) = (shifted(h), shifted(-h));
            std::array::from_fn::<_, N, _>(|i| (up[i] - down[i]) / (2.0 * h))
        };
        let columns: [[f64; N]; N] = std::array::from_fn(column);
        let jacobian = Mat::from_fn(N, N, |i, j| columns[j][i]);
        let step = PartialPivLu::new(jacobian.as_ref()).solve(Mat::from_fn(N, 1, |i, _| value[i]));
        x = std::array::from_fn(|i| x[i] - step[(i, 0)]);
        if (0..N).all(|i| step[(i, 0)].abs() <= 1e-13 * x[i].abs().max(1.0)) {
            break;
        }
    }
    x
}

/// A zero of f between `a` and `b`, where it has opposite signs.
pub(crate) fn bisected(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a) > 0.0;
    assert_ne!(sign, f(b) > 0.0, "no sign change from {a} to {b}");
    for _ in 0..60 {
        let middle = f64::midpoint(a, b);
        *(if (f(middle) > 0.0) == sign {
            &mut a
        } else {
            &mut b
        }) = middle;
    }
    f64::midpoint(a, b)
}

/// The 2 x 2 matrix exponential of x'' + 2 zeta x' + k x = 0 over a time t, by rows, for k > zeta^2.
pub(crate) fn swing(zeta: f64, k: f64, t: f64) -> [[f64; 2]; 2] {
    let w = (k - zeta * zeta).sqrt();
    let ((s, c), decay) = ((w * t).sin_cos(), (-zeta * t).exp());
    [
        [decay * (c + zeta / w * s), decay * s / w],
        [-decay * k * s / w, decay * (c - zeta / w * s)],
    ]
}

pub(crate) fn product(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// det(M - mu I).
pub(crate) fn characteristic(m: [[f64; 2]; 2], mu: f64) -> f64 {
    (m[0][0] - mu) * (m[1][1] - mu) - m[0][1] * m[1][0]
}

/// Displacement and speed of the steady solution of x'' + 2 zeta x' + k x = cos(omega t).
pub(crate) fn steady(zeta: f64, k: f64, omega: f64, t: f64) -> [f64; 2] {
    let (stiff, lag) = (k - omega * omega, 2.0 * zeta * omega);
    let (s, c) = (omega * t).sin_cos();
    let size = stiff * stiff + lag * lag;
    [
        (stiff * c + lag * s) / size,
        omega * (lag * c - stiff * s) / size,
    ]
}
