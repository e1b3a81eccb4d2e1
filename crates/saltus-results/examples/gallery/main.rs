//! Every kind of figure with synthetic data, written as SVG and PNG into the folder named on the
//! command line. `cargo run --release --example gallery -p saltus-results -- FOLDER`
#![allow(clippy::print_stdout)]

mod dynamics;

use saltus_results::{
    Axis, Class, ClassMap, Cloud, Colour, ColourScale, Curves, Dataset, Fact, Figure, FigureBlock,
    Grid, History, Image, MarkdownTable, Page, Panel, Portrait, ResultFolder, Table, ValueMap,
    Variable, Verdict, csv,
};
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let target = std::env::args().nth(1).ok_or("name a folder")?;
    let mut folder = ResultFolder::stage(Path::new(&target))?;
    let mut page = Page::new("Gallery of figures")
        .section("Figures")
        .paragraph("Synthetic data, drawn to check that nothing overlaps, nothing is cut & everything can be read.");
    for (name, figure) in figures().into_iter().chain(dynamics::figures()) {
        let start = Instant::now();
        let svg = figure.svg();
        let middle = Instant::now();
        let png = figure.png(2.0)?;
        let times = (
            (middle - start).as_secs_f64(),
            middle.elapsed().as_secs_f64(),
        );
        println!(
            "{name:<12} svg {:>8} B {:>6.3} s   png {:>8} B {:>6.3} s",
            svg.len(),
            times.0,
            png.len(),
            times.1
        );
        let (svg_file, png_file) = (format!("{name}.svg"), format!("{name}.png"));
        page = page.subsection(name).figure(&FigureBlock {
            caption: "A caption in our words, long enough to need a second line on a narrow screen, with a \
                      statement of what is drawn and where the numbers come from.",
            alternative: name,
            image: if name == "cloud" || svg.len() > 1_000_000 { Image::Png(&png) } else { Image::Svg(&svg) },
            files: &[("SVG", &svg_file), ("PNG", &png_file)],
        });
        folder.write(&svg_file, &svg)?;
        folder.write(&png_file, &png)?;
    }
    let errors = error_table();
    folder.write("errors.csv", csv(&errors, &errors.tables()[0], Vec::new())?)?;
    folder.write_dataset("map.nc", dataset())?;
    let facts = facts();
    let markdown = facts
        .iter()
        .fold(MarkdownTable::new(&["Fact", "Verdict"]), |table, fact| {
            table.row(&[&fact.name, fact.verdict.words()])
        });
    folder.write("facts.md", markdown.to_string())?;
    let page = page
        .section("Facts")
        .facts(&facts)
        .section("Tables, code and folded parts")
        .table(
            &["Mode", "Frequency (Hz)", "Verdict"],
            [
                ["(1, 1)", "2.297", "reproduced"],
                ["(2, 1)", "−4.1", "not reproduced"],
            ],
        )
        .code("cargo run --release -- reproduce --out results\n# <wait> a minute")
        .details("Settings", |page| {
            page.list(["mass 75 kg", "damping ratio 0.3"])
        })
        .files([
            ("The errors as CSV", "errors.csv"),
            ("A map as NetCDF-4", "map.nc"),
            ("The facts as Markdown", "facts.md"),
        ]);
    folder.write("index.html", page.render())?;
    println!("{}", folder.commit()?.display());
    Ok(())
}

fn facts() -> Vec<Fact> {
    let fact = |name: &str, claim: &str, value: &str, verdict, reading: &str| Fact {
        name: name.into(),
        claim: claim.into(),
        value: value.into(),
        verdict,
        reading: reading.into(),
    };
    vec![
        fact(
            "F1",
            "The empty plate rings at 2.3 Hz.",
            "2.297 Hz",
            Verdict::Reproduced,
            "None.",
        ),
        fact(
            "F2",
            "Chaos below a damping ratio of 0.1.",
            "0.087",
            Verdict::Departure,
            "ω_h as the frequency of the body alone.",
        ),
        fact(
            "F3",
            "No flight above resonance.",
            "3 % of the time",
            Verdict::NotReproduced,
            "Either reading.",
        ),
    ]
}

fn figures() -> Vec<(&'static str, Figure)> {
    let cloud = Figure::new(
        logistic("Logistic map", 0.0, 300)
            .flag(3.8284, "period 3")
            .flag(3.57, "onset of chaos"),
    );
    let portraits = (0..4).map(|i| portrait(f64::from(i)).into());
    let clouds: [Panel; 3] = [
        logistic("Ω = 0.9 ω_h", 0.0, 600).into(),
        logistic("Ω = 1.0 ω_h", 0.2, 600).into(),
        logistic("Ω = 1.1 ω_h", 0.1, 600).into(),
    ];
    vec![
        ("cloud", cloud),
        (
            "cloud-grid",
            Figure::grid(1, clouds).title("Three panels with three sweeps of 200 000 points each"),
        ),
        ("portrait", Figure::new(portrait(2.0))),
        (
            "portraits",
            Figure::grid(2, portraits).title("Van der Pol oscillator at four strengths of damping"),
        ),
        ("chaos", Figure::new(henon())),
        ("history", Figure::new(history())),
        ("curves", Figure::new(errors())),
        ("backbone", Figure::new(backbone())),
        ("map-coarse", Figure::new(circle(9, 7).0.shares())),
        (
            "map-fine",
            Figure::new(circle(1000, 1000).0.shares()).plot_size(640.0, 560.0),
        ),
        (
            "map-values",
            Figure::new(markus(1000)).plot_size(640.0, 560.0),
        ),
        ("map-classes", Figure::new(all_classes())),
        (
            "maps",
            Figure::grid(2, maps()).title("One study, four layers: 60 x 40 cells"),
        ),
        (
            "empty",
            Figure::grid(3, edge_cases()).title("Edge cases: no data, constant data, tiny data"),
        ),
    ]
}

/// Three sweeps over the logistic map; the second sees a window the first does not.
fn logistic(title: &str, shift: f64, steps: u32) -> Cloud {
    let mut cloud = Cloud::new(
        title,
        Axis::new("Growth rate r (-)"),
        Axis::new("Population x (-)"),
    );
    for (label, start, kind) in [
        ("Up-sweep", 0.3, 0),
        ("Down-sweep", 0.6, 1),
        ("Several starts", 0.9, 2),
    ] {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        for i in 0..500 {
            let r = 2.9 + 1.1 * f64::from(i) / 499.0 - shift;
            let mut x: f64 = start;
            for step in 0..steps {
                x = r * x * (1.0 - x);
                if step >= 200 {
                    xs.push(r);
                    ys.push(shown(x, r, kind));
                }
            }
        }
        cloud = cloud.series(label, xs, ys);
    }
    cloud
}

/// Between two rates the sweeps part, as they do where attractors coexist.
fn shown(x: f64, r: f64, kind: u8) -> f64 {
    match kind {
        1 if (3.05..3.25).contains(&r) => 0.45,
        2 if (3.2..3.3).contains(&r) && x > 0.7 => 0.2,
        _ => x,
    }
}

fn portrait(strength: f64) -> Portrait {
    let (mut x, mut v) = (0.1, 0.0);
    let (mut xs, mut vs, mut flight) = (Vec::new(), Vec::new(), Vec::new());
    let (mut px, mut pv) = (Vec::new(), Vec::new());
    let step = 0.002;
    for i in 0..60_000 {
        let a = strength * (1.0 - x * x) * v - x;
        x += step * v;
        v += step * a;
        if i > 40_000 {
            xs.push(x);
            vs.push(v);
            flight.push(x > 1.0);
            if i % 1500 == 0 {
                px.push(x);
                pv.push(v);
            }
        }
    }
    Portrait::new(
        format!("Strength {strength}"),
        Axis::new("Displacement z/η (-)"),
        Axis::new("Velocity ż/(η ω_h) (-)"),
    )
    .marked_path(("Contact", "Flight"), xs, vs, &flight)
    .points("Stroboscopic points", px, pv)
}

fn henon() -> Portrait {
    let (mut x, mut y) = (0.1, 0.1);
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for i in 0..9000 {
        (x, y) = (1.0 - 1.4 * x * x + y, 0.3 * x);
        if i > 100 {
            xs.push(x);
            ys.push(y);
        }
    }
    Portrait::new(
        "Hénon attractor: a chaotic section",
        Axis::new("x (-)"),
        Axis::new("y (-)"),
    )
    .path("First 60 iterates, joined", &xs[..60], &ys[..60])
    .points("Section points", xs, ys)
}

fn history() -> History {
    let time: Vec<f64> = (0..6000).map(|i| f64::from(i) * 0.001).collect();
    let force: Vec<f64> = time
        .iter()
        .map(|t| (2100.0 * (std::f64::consts::TAU * 1.8 * t).sin() + 500.0).max(0.0))
        .collect();
    let floor: Vec<f64> = time
        .iter()
        .map(|t| 300.0 * (std::f64::consts::TAU * 3.6 * t).cos() + 700.0)
        .collect();
    let flights: Vec<(f64, f64)> = (0..11)
        .map(|k| ((f64::from(k) + 0.53) / 1.8, (f64::from(k) + 0.97) / 1.8))
        .collect();
    History::new(
        "Reaction between feet and floor",
        Axis::new("Time t (s)"),
        Axis::new("Force (N)"),
    )
    .shade("Flight", &flights)
    .curve("Person 1", &time[..], force)
    .curve("Person 2", &time[..], floor)
    .level("Body weight, 735 N", 735.0)
}

fn errors() -> Curves {
    let steps: Vec<f64> = (0..10).map(|i| 0.5_f64.powi(i)).collect();
    let order =
        |p: i32, c: f64| -> Vec<f64> { steps.iter().map(|h| (c * h.powi(p)).max(2e-15)).collect() };
    Curves::new(
        "Error against step: the order is the slope",
        Axis::new("Step h (s)").logarithmic(),
        Axis::new("Largest error (m)").logarithmic(),
    )
    .dotted_line("Runge-Kutta, order 4", &steps[..], order(4, 0.02))
    .dotted_line("Dormand-Prince, order 5", &steps[..], order(5, 0.004))
    .line("h⁴ for comparison", &steps[..], order(4, 0.2))
    .level("Rounding of one metre", 2.2e-16 * 10.0)
}

fn backbone() -> Curves {
    let amplitude: Vec<f64> = (0..200).map(|i| f64::from(i) * 1e-5).collect();
    let frequency: Vec<f64> = amplitude
        .iter()
        .map(|a| 2.297 * (1.0 + 3e5 * a * a).sqrt())
        .collect();
    let exact: Vec<f64> = amplitude
        .iter()
        .map(|a| 2.297 * (1.0 + 2.9e5 * a * a).sqrt())
        .collect();
    Curves::new(
        "Backbone of the first mode",
        Axis::new("Frequency (Hz)"),
        Axis::new("Amplitude (m)"),
    )
    .line("Harmonic balance", frequency, &amplitude[..])
    .line("Exact quadrature", exact, &amplitude[..])
    .flag(2.297, "linear 2.297 Hz")
    .flag(2.31, "a close neighbour")
}

/// Cells of growing width on a logarithmic axis, and values so small that a power of ten helps.
fn uneven(size: f64) -> ValueMap {
    let x = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    let y = [0.0, 1.0, 2.0, 4.0, 8.0];
    let axes = (Axis::new("Mass (kg)").logarithmic(), Axis::new("Value (-)"));
    let values: Vec<f64> = (0..35).map(|i| size * f64::from(i % 11)).collect();
    let grid = Grid::new(axes.0, x, axes.1, y);
    ValueMap::new("Uneven cells", grid, values, Axis::new("Height (m)"))
}

/// A map behind a window that cuts it at one side and reaches beyond it at the other.
fn cropped() -> ClassMap {
    let side = even(0.0, 10.0, 11);
    let axes = (
        Axis::new("x (-)").range(3.3, 12.0),
        Axis::new("y (-)").range(-2.0, 8.2),
    );
    let cells: Vec<u8> = (0..121).map(|i| (i % 13) as u8).collect();
    ClassMap::new(
        "A window",
        Grid::new(axes.0, &side[..], axes.1, &side[..]),
        cells,
        classes(),
    )
}

/// A map of one cell, which has no value.
fn nothing() -> ValueMap {
    let grid = Grid::new(Axis::new("x (-)"), [1.0], Axis::new("y (-)"), [0.0]);
    ValueMap::new(
        "One cell without a value",
        grid,
        [f64::NAN],
        Axis::new("Value (-)"),
    )
}

fn even(low: f64, high: f64, count: usize) -> Vec<f64> {
    let last = (count - 1) as f64;
    (0..count)
        .map(|i| low + (high - low) * i as f64 / last)
        .collect()
}

fn classes() -> Vec<Class> {
    let periods = [1, 2, 3, 4, 5, 6, 8, 12, 16];
    let mut classes: Vec<Class> = periods
        .iter()
        .zip([1, 2, 4, 8, 16, 3, 6, 5].map(Colour::of_period))
        .map(|(period, colour)| Class::new(format!("Period {period}"), colour))
        .collect();
    classes.extend([
        Class::new("Other periodic", Colour::OTHER),
        Class::new("Not periodic", Colour::IRREGULAR),
        Class::new("Undecided", Colour::UNDECIDED),
        Class::new("Failed", Colour::FAILED),
    ]);
    classes
}

/// A grid in the ranges of a typical study.
fn study_grid(columns: usize, rows: usize) -> (Grid, Vec<f64>, Vec<f64>) {
    let (x, y) = (even(0.9, 1.1, columns), even(0.1, 0.5, rows));
    let axes = (
        Axis::new("Frequency ratio Ω/ω_h (-)"),
        Axis::new("Damping ratio ζ_h (-)"),
    );
    (Grid::new(axes.0, &x[..], axes.1, &y[..]), x, y)
}

/// Tongues of the circle map by the period of the rotation, and how far the points wander.
fn circle(columns: usize, rows: usize) -> (ClassMap, Vec<f64>) {
    let (grid, x, y) = study_grid(columns, rows);
    let (mut cells, mut spread) = (Vec::new(), Vec::new());
    for &y in &y {
        for &x in &x {
            let (turn, strength) = ((x - 0.9) * 5.0, 3.2 - (y - 0.1) * 8.0);
            let step = |p: f64| {
                p + turn - strength / std::f64::consts::TAU * (std::f64::consts::TAU * p).sin()
            };
            let start = (0..150).fold(0.1, |p, _| step(p));
            let mut p = start;
            let mut period = None;
            for n in 1..=40 {
                p = step(p);
                if ((p - start) - (p - start).round()).abs() < 1e-4 {
                    period = Some(n);
                    break;
                }
            }
            let known = [1, 2, 3, 4, 5, 6, 8, 12, 16];
            let class = period.map_or(10, |n| known.iter().position(|&k| k == n).unwrap_or(9));
            cells.push(class as u8);
            spread.push((p - start).abs().fract());
        }
    }
    (
        ClassMap::new("Tongues of the circle map", grid, cells, classes()),
        spread,
    )
}

/// Lyapunov exponent of the logistic map forced in turn by two rates (Markus & Hess 1989).
fn markus(count: usize) -> ValueMap {
    let (x, y) = (even(2.8, 4.05, count), even(2.8, 4.0, count));
    let mut values = Vec::new();
    for &b in &y {
        for &a in &x {
            let (mut p, mut sum) = (0.5_f64, 0.0);
            for n in 0..160 {
                let r = if n % 12 < 6 { a } else { b };
                p = r * p * (1.0 - p);
                if n > 40 {
                    sum += (r * (1.0 - 2.0 * p)).abs().max(1e-12).ln();
                }
            }
            values.push(if p.is_finite() && p >= 0.0 {
                sum / 119.0
            } else {
                f64::NAN
            });
        }
    }
    let axes = (Axis::new("Rate A (-)"), Axis::new("Rate B (-)"));
    let grid = Grid::new(axes.0, x, axes.1, y);
    let bar = Axis::new("Lyapunov exponent (1/step)").range(-1.5, 0.8);
    ValueMap::new("Exponents, where the population lives", grid, values, bar).missing("Extinct")
}

fn all_classes() -> ClassMap {
    let classes = classes();
    let count = classes.len();
    let cells: Vec<u8> = (0..count * count)
        .map(|i| {
            if (i / count).is_multiple_of(2) {
                i % count
            } else {
                (i * 5 + i / count) % count
            }
        })
        .map(|class| class as u8)
        .collect();
    let side = even(1.0, count as f64, count);
    let grid = Grid::new(
        Axis::new("Class"),
        &side[..],
        Axis::new("Neighbours"),
        &side[..],
    );
    ClassMap::new("All classes beside each other", grid, cells, classes)
}

fn maps() -> Vec<Panel> {
    let (classes, spread) = circle(60, 40);
    let (grid, x, y) = study_grid(60, 40);
    let each = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        y.iter()
            .flat_map(|&y| x.iter().map(move |&x| f(x, y)))
            .collect()
    };
    let peak = |x: f64, y: f64| {
        if (x - 1.0).hypot(y - 0.2) < 0.02 {
            f64::NAN
        } else {
            9.81 / ((x - 1.0).hypot(0.2 * y) + 0.02)
        }
    };
    let contact = ValueMap::new(
        "Contact ratio",
        grid.clone(),
        spread,
        Axis::new("Contact ratio (-)").range(0.0, 1.0),
    );
    let acceleration = ValueMap::new(
        "Peak acceleration",
        grid.clone(),
        each(&peak),
        Axis::new("Peak acceleration (m/s²)").range(0.0, 200.0),
    )
    .scale(ColourScale::Cividis);
    let decades = Axis::new("Largest error after a whole minute of jumping on the spot, in words that need a second line (m)").logarithmic();
    let error = ValueMap::new(
        "Error",
        grid,
        each(&|x, y| (40.0 * (x - 1.0) - 30.0 * y).exp()),
        decades,
    );
    vec![
        classes.shares().into(),
        contact.into(),
        acceleration.into(),
        error.into(),
    ]
}

/// One row of numbers, as a table.
fn error_table() -> Dataset {
    Dataset::new("Errors by step")
        .coordinate(
            Variable::coordinate("step", vec![0.1])
                .long_name("Step")
                .units("s"),
        )
        .variable(
            Variable::new("error", &["step"], vec![1e-5])
                .long_name("Error")
                .units("m"),
        )
        .table(Table::new("errors", &["step"]).columns(&["step", "error"]))
}

fn dataset() -> Dataset {
    let (columns, rows) = (60, 40);
    let (_, spread) = circle(columns, rows);
    let label: Vec<u8> = spread.iter().map(|&s| u8::from(s > 0.5)).collect();
    Dataset::new("Tongues of the circle map")
        .attribute(
            "source",
            concat!("saltus-results ", env!("CARGO_PKG_VERSION")),
        )
        .coordinate(
            Variable::coordinate("damping_ratio", even(0.1, 0.5, rows))
                .units("1")
                .long_name("Damping ratio ζ_h"),
        )
        .coordinate(
            Variable::coordinate("frequency_ratio", even(0.9, 1.1, columns))
                .units("1")
                .long_name("Frequency ratio Ω/ω_h"),
        )
        .variable(
            Variable::new("spread", &["damping_ratio", "frequency_ratio"], spread)
                .units("1")
                .long_name("Spread"),
        )
        .variable(
            Variable::new("wide", &["damping_ratio", "frequency_ratio"], label)
                .long_name("Whether the points wander far")
                .flags([(0, "no"), (1, "yes")]),
        )
}

fn edge_cases() -> Vec<Panel> {
    let axes = || {
        (
            Axis::new("A long label of an axis that must be broken into lines (m/s²)"),
            Axis::new("Value (-)"),
        )
    };
    let bad = vec![f64::NAN, f64::INFINITY, 1.0];
    let (x, y) = axes();
    let none = Cloud::new(
        "Nothing, with a title so long that it needs more than one line",
        x,
        y,
    )
    .series("Empty", [], []);
    let (x, y) = axes();
    let constant = Cloud::new("Constant", x, y)
        .series("Constant", vec![1.0, 2.0, 3.0], vec![5.0; 3])
        .series("Bad", bad.clone(), bad);
    let (x, y) = axes();
    let tiny =
        Curves::new("Tiny & <escaped>", x, y).dots("Tiny", vec![1e-19, 2e-19], vec![-3e7, 4e7]);
    vec![
        none.into(),
        constant.into(),
        tiny.into(),
        uneven(1e-3).into(),
        cropped().into(),
        nothing().into(),
    ]
}
