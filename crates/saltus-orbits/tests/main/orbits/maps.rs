//! Maps with known answers.

use saltus_orbits::{Crossing, Image, MapPoint, MapRequest, Matrix, NoImage, ParametricMap, Touch};
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Image and rows of the derivative, from parameters and state.
type Formula<const N: usize> = fn(&[f64], [f64; N]) -> ([f64; N], [[f64; N]; N]);

/// A map given by a formula for its image and the rows of its derivative.
pub(crate) struct Smooth<const N: usize> {
    pub(crate) map: Formula<N>,
    /// Parameter 0 ends here.
    pub(crate) until: f64,
    /// Calls so far.
    pub(crate) calls: AtomicUsize,
    /// Images are off by up to this, in a way that changes with every bit of the start.
    pub(crate) noise: f64,
    /// Answers `Interrupted` after so many calls.
    pub(crate) patience: usize,
}

impl<const N: usize> Smooth<N> {
    pub(crate) fn new(map: Formula<N>) -> Self {
        Self {
            map,
            until: f64::INFINITY,
            calls: AtomicUsize::new(0),
            noise: 0.0,
            patience: usize::MAX,
        }
    }
}

impl<const N: usize> ParametricMap for Smooth<N> {
    fn dimension(&self) -> usize {
        N
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let stop = self.calls.fetch_add(1, Ordering::Relaxed) >= self.patience;
        let image = |shot: &MapRequest<'_>| {
            if stop {
                return Err(NoImage::Interrupted);
            }
            if shot.parameters.first().is_some_and(|p| *p > self.until) {
                return Err(NoImage::NoMap(format!("no map above {}", self.until)));
            }
            let (mut x, rows) = (self.map)(shot.parameters, shot.start.x[..].try_into().unwrap());
            for (x, start) in x.iter_mut().zip(&shot.start.x) {
                let bits = (start + shot.parameters.first().unwrap_or(&0.0)).to_bits();
                let scrambled = bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
                *x += self.noise * (scrambled as f64 / 2.0_f64.powi(31) - 1.0);
            }
            Ok(Image {
                place: at(&x),
                derivative: Some(Matrix::from_fn(N, N, |row, col| rows[row][col])),
                crossings: Vec::new(),
                touches: Vec::new(),
            })
        };
        shots.iter().map(image).collect()
    }
}

pub(crate) fn at(x: &[f64]) -> MapPoint {
    MapPoint {
        modes: Vec::new(),
        x: x.to_vec(),
    }
}

/// x -> r x (1 - x).
pub(crate) fn logistic() -> Smooth<1> {
    Smooth::new(|p, [x]| ([p[0] * x * (1.0 - x)], [[p[0] * (1.0 - 2.0 * x)]]))
}

/// (x, y) -> (a - x^2 + b y, x), parameters a and b.
pub(crate) fn henon() -> Smooth<2> {
    Smooth::new(|p, [x, y]| ([p[0] - x * x + p[1] * y, x], [[-2.0 * x, p[1]], [1.0, 0.0]]))
}

/// (x, y) -> (r x (1 - y), x).
pub(crate) fn delayed_logistic() -> Smooth<2> {
    Smooth::new(|p, [x, y]| {
        (
            [p[0] * x * (1.0 - y), x],
            [[p[0] * (1.0 - y), -p[0] * x], [1.0, 0.0]],
        )
    })
}

/// (x, y) -> (p x - q y - x^3, x): at 0 the multipliers have the sum p and the product q.
pub(crate) fn trace_and_determinant() -> Smooth<2> {
    Smooth::new(|p, [x, y]| {
        let slope = p[0] - 3.0 * x * x;
        (
            [p[0] * x - p[1] * y - x * x * x, x],
            [[slope, -p[1]], [1.0, 0.0]],
        )
    })
}

/// x -> (1 + a) x - x^3: a pitchfork at a = 0, x^2 = a beyond.
pub(crate) fn pitchfork() -> Smooth<1> {
    Smooth::new(|p, [x]| ([(1.0 + p[0]) * x - x * x * x], [[1.0 + p[0] - 3.0 * x * x]]))
}

/// x -> x + (1 - x^2 - p^2)/10 with the closed curve x^2 + p^2 = 1 of fixed points.
pub(crate) fn circle() -> Smooth<1> {
    Smooth::new(|p, [x]| ([x + 0.1 * (1.0 - x * x - p[0] * p[0])], [[1.0 - 0.2 * x]]))
}

/// A ball that bounces on a table at height gamma sin t, from one impact to the next: phase t and speed w after
/// the impact, parameters gamma (acceleration of the table over gravity) and e. It flies for tau with
/// gamma sin t + w tau - tau^2/2 = gamma sin(t + tau), and w' = (1 + e) gamma cos(t + tau) - e (w - tau). The
/// phase is taken less 2 pi, so one impact per period is a fixed point.
pub(crate) fn bouncing_ball() -> Smooth<2> {
    Smooth::new(|p, [t, w]| {
        let (gamma, e) = (p[0], p[1]);
        let mut tau = 2.0 * w;
        let closing = |tau: f64| w - tau - gamma * (t + tau).cos();
        for _ in 0..30 {
            let gap = gamma * t.sin() + w * tau - tau * tau / 2.0 - gamma * (t + tau).sin();
            tau -= gap / closing(tau);
        }
        let (sin, cos) = (t + tau).sin_cos();
        let by_t = 1.0 - (gamma * t.cos() - w + tau + closing(tau)) / closing(tau);
        let by_w = -tau / closing(tau);
        let kick = e - (1.0 + e) * gamma * sin;
        (
            [t + tau - TAU, (1.0 + e) * gamma * cos - e * (w - tau)],
            [[by_t, by_w], [kick * by_t - e, kick * by_w - e]],
        )
    })
}

/// x -> left x + mu for x < wall, and with slope `right` beyond, parameters mu, left, right, wall. A visit
/// to x > wall is a switch there and back; from x < wall the guard wall - x is touched.
pub(crate) struct Border;

/// Nordmark's map: (x, y) -> (a x + y + rho, -g x) for x < 0, (-sqrt x + y + rho, -g t^2 x) for x > 0,
/// parameters rho, a, g, t (Nordmark 1991). x > 0 is an impact.
pub(crate) struct Nordmark;

impl ParametricMap for Border {
    fn dimension(&self) -> usize {
        1
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let image = |shot: &MapRequest<'_>| {
            let [mu, left, right, wall] = shot.parameters[..] else {
                return Err(NoImage::NoMap("four parameters".into()));
            };
            let over = shot.start.x[0] - wall;
            let slope = if over < 0.0 { left } else { right };
            let to = left * wall + slope * over + mu;
            visit(over, &[to], Matrix::from_fn(1, 1, |_, _| slope))
        };
        shots.iter().map(image).collect()
    }
}

impl ParametricMap for Nordmark {
    fn dimension(&self) -> usize {
        2
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let image = |shot: &MapRequest<'_>| {
            let [rho, a, g, t] = shot.parameters[..] else {
                return Err(NoImage::NoMap("four parameters".into()));
            };
            let (x, y) = (shot.start.x[0], shot.start.x[1]);
            let (u, du, gain) = if x <= 0.0 {
                (a * x, a, g)
            } else {
                (-x.sqrt(), -0.5 / x.sqrt(), g * t * t)
            };
            let rows = [[du, 1.0], [-gain, 0.0]];
            visit(
                x,
                &[u + y + rho, -gain * x],
                Matrix::from_fn(2, 2, |row, col| rows[row][col]),
            )
        };
        shots.iter().map(image).collect()
    }
}

/// An image with a switch there and back if x > 0, and a touch of -x otherwise.
fn visit(x: f64, to: &[f64], derivative: Matrix) -> Result<Image, NoImage> {
    let crossing = |from, to, at| Crossing {
        unit: 0,
        from,
        to,
        at,
    };
    let touch = Touch {
        unit: 0,
        mode: 0,
        guard: 0,
        value: -x,
        at: 0.5,
    };
    let there = x > 0.0;
    Ok(Image {
        place: MapPoint {
            modes: vec![0],
            x: to.to_vec(),
        },
        derivative: Some(derivative),
        crossings: if there {
            vec![crossing(0, 1, 0.4), crossing(1, 0, 0.6)]
        } else {
            Vec::new()
        },
        touches: if there { Vec::new() } else { vec![touch] },
    })
}

/// x -> a x + rho for x < 0, a x + jump + sqrt x + rho beyond, parameters rho, a, jump: x > 0 is a visit.
pub(crate) struct Root;

impl ParametricMap for Root {
    fn dimension(&self) -> usize {
        1
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let image = |shot: &MapRequest<'_>| {
            let [rho, a, jump] = shot.parameters[..] else {
                return Err(NoImage::NoMap("three parameters".into()));
            };
            let x = shot.start.x[0];
            let (root, slope) = match x {
                0.0.. => (jump + x.sqrt(), 0.5 / x.max(1e-300).sqrt()),
                _ => (0.0, 0.0),
            };
            visit(
                x,
                &[a * x + root + rho],
                Matrix::from_fn(1, 1, |_, _| a + slope),
            )
        };
        shots.iter().map(image).collect()
    }
}

/// x -> x/2 + p, parameter p. Unit 0 is in mode 1 from the phase 0.3 + p to 0.6 + p, unit 1 from 0.75 to
/// 0.85, whatever x. A start in another mode than the phase has leads elsewhere.
pub(crate) struct Clock;

impl ParametricMap for Clock {
    fn dimension(&self) -> usize {
        1
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        let image = |shot: &MapRequest<'_>| {
            let (x, p) = (shot.start.x[0], shot.parameters[0]);
            let phases = [(0, 0, 0.3 + p), (0, 1, 0.6 + p), (1, 0, 0.75), (1, 1, 0.85)];
            let mut crossings: Vec<Crossing> = phases
                .iter()
                .map(|&(unit, from, phase)| Crossing {
                    unit,
                    from,
                    to: 1 - from,
                    at: 1.0 - (1.0_f64 - phase).rem_euclid(1.0),
                })
                .collect();
            crossings.sort_by(|a, b| a.at.total_cmp(&b.at));
            let modes = vec![usize::from((0.4..0.7).contains(&p)), 0];
            let wrong = if shot.start.modes == modes { 0.0 } else { 0.1 };
            Ok(Image {
                place: MapPoint {
                    modes,
                    x: vec![0.5 * x + p + wrong],
                },
                derivative: Some(Matrix::from_fn(1, 1, |_, _| 0.5)),
                crossings,
                touches: Vec::new(),
            })
        };
        shots.iter().map(image).collect()
    }
}
