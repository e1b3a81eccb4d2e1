//! Figures of nonlinear dynamics over maps with known answers: the eye can check what it sees.

use saltus_results::{
    Axis, Bifurcation, BifurcationSet, Branches, Class, ClassMap, Cloud, Colour, Curves, Figure,
    Grid, Panel, Shares,
};

pub(crate) fn figures() -> Vec<(&'static str, Figure)> {
    let three: [Panel; 3] = [
        logistic("Whole range", (2.8, 4.0)).into(),
        logistic("Window of period 3", (3.815, 3.865)).into(),
        resonance().into(),
    ];
    let planes: [Panel; 2] = [
        curves(BifurcationSet::over(henon_map())).into(),
        curves(BifurcationSet::new(
            "Curves alone",
            parameter_a(),
            parameter_b(),
        ))
        .into(),
    ];
    let attractors: [Panel; 3] = [attractors().into(), fractions().into(), intervals().into()];
    vec![
        (
            "branches",
            Figure::new(logistic("Logistic map", (2.8, 4.0))),
        ),
        (
            "branches-grid",
            Figure::grid(3, three).title("Three panels: clipped curves, crowded labels"),
        ),
        ("exponents", Figure::new(exponents())),
        ("convergence", Figure::new(convergence())),
        (
            "bifurcation-set",
            Figure::grid(2, planes)
                .title("Hénon map: curves known in closed form over a map by iteration"),
        ),
        (
            "attractors",
            Figure::grid(1, attractors).title("Twelve attractors and their basins"),
        ),
    ]
}

fn even(low: f64, high: f64, count: usize) -> Vec<f64> {
    let last = (count - 1) as f64;
    let at = |i| low + (high - low) * i as f64 / last;
    (0..count).map(at).collect()
}

/// A cycle of the logistic map followed along a path of rates by Newton's method, each start
/// extrapolated from two points before.
struct Followed {
    rates: Vec<f64>,
    stable: Vec<bool>,
    curves: Vec<Vec<f64>>,
}

fn follow(period: usize, start: f64, rates: Vec<f64>) -> Followed {
    let mut curves = vec![Vec::new(); period];
    let mut stable = Vec::new();
    let (mut before, mut at) = (start, start);
    for &r in &rates {
        let mut x = 2.0 * at - before;
        let cycle = |mut x: f64| {
            let start = x;
            let mut slope = 1.0;
            for _ in 0..period {
                slope *= r * (1.0 - 2.0 * x);
                x = r * x * (1.0 - x);
            }
            (x - start, slope)
        };
        for _ in 0..40 {
            let (gap, slope) = cycle(x);
            x -= gap / (slope - 1.0);
        }
        (before, at) = (at, x);
        stable.push(cycle(x).1.abs() <= 1.0);
        for curve in &mut curves {
            curve.push(x);
            x = r * x * (1.0 - x);
        }
    }
    Followed {
        rates,
        stable,
        curves,
    }
}

/// A point of the stable cycle at rate `r`.
fn settled(r: f64) -> f64 {
    (0..5000).fold(0.4, |x, _| r * x * (1.0 - x))
}

/// Cycles of period 1, 2, 3 and 4. Doublings at 3, 1 + √6, 3.544090 and 3.841499, the fold at 1 + √8.
fn logistic(title: &str, (low, high): (f64, f64)) -> Branches {
    let fold = 1.0 + 8.0_f64.sqrt();
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for r in even(low, high, 500) {
        let mut x = 0.4;
        for step in 0..500 {
            x = r * x * (1.0 - x);
            if step >= 300 {
                xs.push(r);
                ys.push(x);
            }
        }
    }
    // Squares of equal steps go round the fold: stable on one side of zero, unstable on the other.
    let round = |from: f64| -> Vec<f64> {
        let side = even(from, -0.41, 275);
        side.iter().map(|s| fold + s * s).collect()
    };
    let start = |r: f64, period: usize, end: f64| follow(period, settled(r), even(r, end, 600));
    let cycles = [
        ("Period 1", start(2.8, 1, 4.0)),
        ("Period 2", start(3.05, 2, 3.0002)),
        ("Period 2", start(3.05, 2, 4.0)),
        ("Period 4", start(3.46, 4, 3.4496)),
        ("Period 4", start(3.46, 4, 4.0)),
        ("Period 3", follow(3, settled(fold + 0.01), round(0.1))),
        ("Period 3", start(fold + 0.01, 3, 4.0)),
    ];
    let points = |r: f64, period: usize| {
        let mut x = settled(r);
        let step = |_| {
            x = r * x * (1.0 - x);
            x
        };
        (0..period).map(step).collect::<Vec<f64>>()
    };
    let doubling = Bifurcation::PeriodDoubling;
    let diagram = Branches::new(
        title,
        Axis::new("Growth rate r (-)").range(low, high),
        Axis::new("Population x (-)"),
    )
    .cloud("Brute force", xs, ys)
    .special(doubling, "PD1", 3.0, [2.0 / 3.0])
    .special(doubling, "PD2", 1.0 + 6.0_f64.sqrt(), points(3.4494, 2))
    .special(doubling, "PD4", 3.544_090, points(3.544, 4))
    .special(Bifurcation::Fold, "SN3", fold, points(fold + 1e-6, 3))
    .special(doubling, "PD3", 3.841_499, points(3.8414, 3));
    cycles.into_iter().fold(diagram, |diagram, (label, cycle)| {
        diagram.branch(label, cycle.rates, &cycle.stable, cycle.curves)
    })
}

/// A bent resonance with a special point of each kind, some too close for all labels.
fn resonance() -> Branches {
    // Duffing's oscillator: w² = 1 + a² − 2ζ² ± sqrt(F²/a² − 4ζ²(1 + a²)) about, in the first order.
    let (force, damping) = (0.12_f64, 0.06_f64);
    let peak = 0.5 * force / damping;
    let amplitudes = even(0.16, peak, 200);
    let side = |a: &f64, sign: f64| {
        let root = ((0.5 * force / a).powi(2) - damping * damping)
            .max(0.0)
            .sqrt();
        1.0 + 0.375 * a * a + sign * root
    };
    let mut amplitude = amplitudes.clone();
    amplitude.extend(amplitudes.iter().rev());
    let up = amplitudes.iter().map(|a| side(a, -1.0));
    let down = amplitudes.iter().rev().map(|a| side(a, 1.0));
    let frequency: Vec<f64> = up.chain(down).collect();
    let turns: Vec<usize> = (1..399)
        .filter(|&i| (frequency[i] - frequency[i - 1]) * (frequency[i + 1] - frequency[i]) < 0.0)
        .collect();
    let stable: Vec<bool> = (0..400)
        .map(|i| turns.len() < 2 || i <= turns[0] || i >= turns[1])
        .collect();
    let at = |i: usize| (frequency[i], [amplitude[i]]);
    let mut diagram = Branches::new(
        "All symbols",
        Axis::new("Frequency Ω (rad/s)"),
        Axis::new("Amplitude (m)"),
    );
    for (number, &turn) in turns.iter().enumerate() {
        let (x, y) = at(turn);
        diagram = diagram.special(Bifurcation::Fold, format!("SN{}", number + 1), x, y);
    }
    let others = [
        (Bifurcation::NeimarkSacker, "NS", 120),
        (Bifurcation::Grazing, "G1", 60),
        (Bifurcation::Grazing, "G2", 64),
        (Bifurcation::Grazing, "G3", 68),
        (Bifurcation::Grazing, "G4", 72),
        (Bifurcation::BranchPoint, "BP", 20),
        (Bifurcation::SwitchOrder, "O", 390),
        (Bifurcation::PeriodDoubling, "PD", 150),
    ];
    for (kind, label, index) in others {
        let (x, y) = at(index);
        diagram = diagram.special(kind, label, x, y);
    }
    diagram.branch("Period 1", frequency.clone(), &stable, [amplitude])
}

/// Stretching along two directions for each step of the delayed logistic map x' = a x (1 − y), y' = x,
/// from Gram and Schmidt's method.
fn stretching(a: f64, steps: usize) -> Vec<[f64; 2]> {
    let (mut x, mut y) = (0.5, 0.4);
    let (mut u, mut v) = ([1.0, 0.0], [0.0, 1.0]);
    let mut logs = Vec::with_capacity(steps);
    for step in 0..steps + 2000 {
        let push = |t: [f64; 2]| [a * (1.0 - y) * t[0] - a * x * t[1], t[0]];
        (u, v) = (push(u), push(v));
        (x, y) = (a * x * (1.0 - y), x);
        let first = u[0].hypot(u[1]);
        u = u.map(|c| c / first);
        let along = u[0] * v[0] + u[1] * v[1];
        v = [v[0] - along * u[0], v[1] - along * u[1]];
        let second = v[0].hypot(v[1]);
        v = v.map(|c| c / second);
        if step >= 2000 {
            logs.push([first.ln(), second.ln()]);
        }
    }
    logs
}

/// Mean and standard error from the means of 20 blocks.
fn estimate(logs: &[[f64; 2]], which: usize) -> (f64, f64) {
    let size = (logs.len() / 20).max(1);
    let blocks: Vec<f64> = logs
        .chunks_exact(size)
        .map(|block| block.iter().map(|log| log[which]).sum::<f64>() / size as f64)
        .collect();
    let count = blocks.len() as f64;
    let mean = blocks.iter().sum::<f64>() / count;
    let square = blocks.iter().map(|b| (b - mean).powi(2)).sum::<f64>();
    (mean, (square / (count * (count - 1.0).max(1.0))).sqrt())
}

const NAMES: [&str; 2] = ["Largest exponent λ₁", "Second exponent λ₂"];

fn spectrum(title: &str, x: Axis, x_values: &[f64], rows: &[[(f64, f64); 2]]) -> Curves {
    let axes = (x, Axis::new("Lyapunov exponent (1/step)"));
    let plot = Curves::new(title, axes.0, axes.1).level("Zero", 0.0);
    NAMES.iter().enumerate().fold(plot, |plot, (which, name)| {
        let bound = |sign: f64| -> Vec<f64> {
            let at = |row: &[(f64, f64); 2]| row[which].0 + sign * row[which].1;
            rows.iter().map(at).collect()
        };
        plot.line(*name, x_values, bound(0.0))
            .band("± one standard error", bound(-1.0), bound(1.0))
    })
}

/// Exponents over the parameter: a torus is born at a = 2.
fn exponents() -> Curves {
    let rates = even(1.9, 2.27, 260);
    let rows: Vec<_> = rates
        .iter()
        .map(|&a| {
            let logs = stretching(a, 2000);
            [0, 1].map(|which| estimate(&logs, which))
        })
        .collect();
    let half = 0.5 * (rates[1] - rates[0]);
    let intervals = |wanted: fn(f64) -> bool| -> Vec<(f64, f64)> {
        let chosen = rates.iter().zip(&rows).filter(|(_, row)| wanted(row[0].0));
        chosen
            .map(|(a, _)| (a - half - 1e-9, a + half + 1e-9))
            .collect()
    };
    let axis = Axis::new("Growth rate a (-)").range(1.9, 2.27);
    spectrum("Exponents of the delayed logistic map", axis, &rates, &rows)
        .shade("Periodic", &intervals(|e| e < -4e-3))
        .shade("Quasi-periodic", &intervals(|e| e.abs() <= 4e-3))
        .shade("Chaotic", &intervals(|e| e > 4e-3))
}

/// Running means of the exponents in chaos.
fn convergence() -> Curves {
    let logs = stretching(2.27, 100_000);
    let counts: Vec<usize> = (0..60)
        .map(|i| (40.0 * 2500.0_f64.powf(f64::from(i) / 59.0)) as usize)
        .collect();
    let rows: Vec<_> = counts
        .iter()
        .map(|&count| [0, 1].map(|which| estimate(&logs[..count], which)))
        .collect();
    let counts: Vec<f64> = counts.iter().map(|&count| count as f64).collect();
    let axis = Axis::new("Iterates n (-)").logarithmic();
    spectrum("Running means at a = 2.27", axis, &counts, &rows)
}

fn parameter_a() -> Axis {
    Axis::new("Parameter a (-)").range(-0.6, 1.6)
}

fn parameter_b() -> Axis {
    Axis::new("Parameter b (-)").range(-1.1, 0.6)
}

/// Period of the motion of the Hénon map that starts near its fixed point.
fn henon_map() -> ClassMap {
    let (columns, rows) = (220, 170);
    let (x, y) = (even(-0.595, 1.595, columns), even(-1.095, 0.595, rows));
    let mut cells = Vec::new();
    for &b in &y {
        for &a in &x {
            cells.push(henon_class(a, b));
        }
    }
    let classes = [
        Class::new("Period 1", Colour::of_period(1)),
        Class::new("Period 2", Colour::of_period(2)),
        Class::new("Period 4", Colour::of_period(4)),
        Class::new("Other", Colour::IRREGULAR),
        Class::new("No attractor", Colour::MISSING),
    ];
    let grid = Grid::new(parameter_a(), x, parameter_b(), y);
    ClassMap::new("Over a map of periods", grid, cells, classes)
}

fn henon_class(a: f64, b: f64) -> u8 {
    // The fixed point −1 + b ± sqrt(...) over 2a; a start beside it.
    let root = ((1.0 - b) * (1.0 - b) + 4.0 * a).max(0.0).sqrt();
    let fixed = 2.0 / ((1.0 - b) + root);
    let (mut x, mut y) = (fixed + 0.01, b * fixed);
    for _ in 0..3000 {
        (x, y) = (1.0 - a * x * x + y, b * x);
        if x.abs() > 100.0 {
            return 4;
        }
    }
    let start = x;
    for period in 1..=4 {
        (x, y) = (1.0 - a * x * x + y, b * x);
        if (x - start).abs() < 1e-4 {
            return [0, 1, 3, 2][period - 1];
        }
    }
    3
}

/// Folds and doublings of the fixed point and of the cycle of two; at b = −1 the map preserves areas.
fn curves(set: BifurcationSet) -> BifurcationSet {
    let b = even(-1.0, 1.0, 201);
    let over = |a: fn(f64) -> f64| b.iter().map(|&b| a(b)).collect::<Vec<f64>>();
    let doubling = Bifurcation::PeriodDoubling;
    set.curve(
        Bifurcation::Fold,
        "SN",
        over(|b| -0.25 * (1.0 - b).powi(2)),
        &b[..],
    )
    .curve(doubling, "PD1", over(|b| 0.75 * (1.0 - b).powi(2)), &b[..])
    .curve(
        doubling,
        "PD2",
        over(|b| (1.0 - b).powi(2) + 0.25 * (1.0 + b).powi(2)),
        &b[..],
    )
    .curve(Bifurcation::NeimarkSacker, "NS", [-1.0, 3.0], [-1.0; 2])
}

/// Attractor `index` at `p`: a logistic map of its own, shifted; none outside its interval.
fn attractor(index: u32, p: f64) -> Option<Vec<f64>> {
    let phase = f64::from(index) / 12.0;
    let lives = (0.9 * phase - 0.25..0.9 * phase + 0.55).contains(&p);
    let r = 2.7 + 1.25 * (p + 1.7 * phase).fract();
    let mut x = 0.4;
    let mut step = |_| {
        x = r * x * (1.0 - x);
        1.2 * x + 2.5 * (7.0 * phase).fract()
    };
    let points: Vec<f64> = (0..260).map(&mut step).collect();
    lives.then(|| points[200..].to_vec())
}

fn name(index: u32) -> String {
    format!("Attractor {}", index + 1)
}

/// The points of an attractor, those of a cycle once.
fn attractors() -> Cloud {
    let axes = (parameter(), Axis::new("Displacement (mm)"));
    let cloud = Cloud::new("Coexisting attractors", axes.0, axes.1).apart();
    (0..12).fold(cloud, |cloud, index| {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        for p in even(0.0, 1.0, 400) {
            let mut points = attractor(index, p).unwrap_or_default();
            points.sort_by(f64::total_cmp);
            points.dedup_by(|a, b| (*a - *b).abs() < 1e-4);
            xs.extend(points.iter().map(|_| p));
            ys.extend(points);
        }
        cloud.series(name(index), xs, ys)
    })
}

fn parameter() -> Axis {
    Axis::new("Frequency ratio Ω/ω_h (-)").range(0.0, 1.0)
}

/// Weight of a basin, zero where the attractor is not.
fn fraction(index: u32, p: f64) -> f64 {
    let weight =
        |k: u32| attractor(k, p).map_or(0.0, |_| 1.0 + (3.0 * p + f64::from(k)).sin().abs());
    weight(index) / (0..12).map(weight).sum::<f64>()
}

fn fractions() -> Shares {
    let p = even(0.0, 1.0, 400);
    let stack = Shares::new(
        "Shares of the basins",
        parameter(),
        &p[..],
        Axis::new("Share of starts (-)").range(0.0, 1.0),
    );
    (0..12).fold(stack, |stack, index| {
        let values: Vec<f64> = p.iter().map(|&p| fraction(index, p)).collect();
        stack.share(name(index), values)
    })
}

/// Three of the shares as estimated from 200 starts.
fn intervals() -> Curves {
    let p = even(0.0, 1.0, 30);
    let axes = (parameter(), Axis::new("Share of starts (-)"));
    let plot = Curves::new("Three of them with their intervals", axes.0, axes.1);
    [1, 6, 10].into_iter().fold(plot, |plot, index| {
        let share: Vec<f64> = p.iter().map(|&p| fraction(index, p)).collect();
        let bound = |sign: f64| -> Vec<f64> {
            let half = |s: f64| 1.96 * (s * (1.0 - s) / 200.0).sqrt();
            share.iter().map(|&s| s + sign * half(s)).collect()
        };
        plot.dotted_line(name(index), &p[..], &share[..])
            .colour(Colour::ATTRACTORS[index as usize])
            .bars("95 % confidence interval", bound(-1.0), bound(1.0))
    })
}
