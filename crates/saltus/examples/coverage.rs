//! Rate at which pixels of a map get a wrong name. Random pixels of the paper's plane, judged by the map with its
//! defaults and by a slow judge that shares none of its shortcuts; printed as a confusion table.
//!
//! `cargo run --release -p saltus --example coverage -- [PIXELS] [SEED]`
//!
//! The judge runs each initial condition for 20 000 periods. Where the section then comes back, Newton's method must find a
//! cycle there, with all Floquet multipliers inside the unit circle. Where it does not, four motions from the same
//! initial condition, 1e-9 eta apart, are run for 20 000 periods more, and the exponent of each is measured over as many.
//! Chaos must go on in all four; one that ends on a stable cycle shows that it was a transient. A torus has a weighted
//! Birkhoff average that is zero.
//!
//! A chaotic pixel says over how many periods it was seen so. Where the judge finds a cycle in the end, the four motions
//! are run for just as many periods: if one of them is on no cycle by then, such a transient outlasts what the map saw.

#![allow(clippy::print_stdout)]

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt;
use std::sync::Arc;

use saltus::hybrid::{Point, Segment, Status, record};
use saltus::model::{Model, PreparedPlate, Setup};
use saltus::orbits::{MotionKind, NewtonOptions, find_orbit};
use saltus::study::{
    Bodies, Control, Grid, Search, Settled, StudyError, lyapunov_of_states, map, place, settle,
    stroboscopic,
};

/// Periods of the judge's transient, and of each exponent.
const LONG: u64 = 20_000;

/// Samples in which the judge looks for returns; cycles up to half of them are seen.
const KEPT: u64 = 128;

/// A section that comes back nearer than this (eta) may be on a cycle, and a cycle this near is where it is.
const NEAR: f64 = 0.05;

/// Initial condition of the paper's studies: z/eta and z'/(eta omega_h).
const START: (f64, f64) = (3.0, 2.0);

/// Motions of one initial condition, and how far apart they start (eta).
const COPIES: usize = 4;
const APART: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Periodic(usize),
    Torus,
    Chaos,
    /// Chaos that was seen to last as long as the map says, and ends on a cycle of this period later.
    Passing(usize),
    Undecided,
}

impl Name {
    fn of(kind: Option<MotionKind>) -> Self {
        match kind {
            Some(MotionKind::Periodic(n)) => Self::Periodic(n as usize),
            Some(MotionKind::QuasiPeriodic) => Self::Torus,
            Some(MotionKind::Chaotic) => Self::Chaos,
            _ => Self::Undecided,
        }
    }

    /// Whether one of the two is wrong.
    fn contradicts(self, other: Self) -> bool {
        match (self, other) {
            (Self::Undecided, _) | (_, Self::Undecided) | (Self::Chaos, Self::Passing(_)) => false,
            _ => self != other,
        }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Periodic(n) => write!(f, "{n}T"),
            Self::Torus => write!(f, "quasi-periodic"),
            Self::Chaos => write!(f, "chaotic"),
            Self::Passing(n) => write!(f, "chaotic at first, then {n}T"),
            Self::Undecided => write!(f, "undecided"),
        }
    }
}

/// SplitMix64 [Steele, Lea & Flood 2014]: the same pixels on every machine.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let part = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * part
    }
}

/// A pixel: damping ratio and frequency ratio.
type Pixel = (f64, f64);

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: usize = arguments.next().map_or(Ok(200), |word| word.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |word| word.parse())?;
    let mut random = Random(seed);
    let pixels: Vec<Pixel> = (0..count)
        .map(|_| (random.between(0.1, 0.5), random.between(0.85, 1.15)))
        .collect();
    let plate = PreparedPlate::new(&Setup::dias_del_prado(0.3, 1.0).plate)?;
    let control = Control::default();
    let quick = quick(&pixels, &plate, &control)?;
    let mut judged = judge(&pixels, &plate, &control)?;
    for i in 0..count {
        if let ((Name::Chaos, periods), Name::Periodic(n)) = (quick[i], judged[i].0)
            && lasts(pixels[i], periods, &plate, &control)?
        {
            judged[i].0 = Name::Passing(n);
        }
    }
    print!("{}", table(&quick, &judged));
    let mut wrong = 0;
    for ((pixel, (quick, periods)), (judged, evidence)) in pixels.iter().zip(&quick).zip(&judged) {
        if quick != judged {
            let (zeta, ratio) = pixel;
            println!(
                "{zeta:.6} {ratio:.6}: map {quick} after {periods} periods, judge {judged} ({evidence})"
            );
        }
        wrong += usize::from(quick.contradicts(*judged));
    }
    println!("{wrong} wrong names of {count}");
    std::process::exit(i32::from(wrong > 0));
}

/// Name that the map gives with its defaults, and the periods it took.
fn quick(
    pixels: &[Pixel],
    plate: &Arc<PreparedPlate>,
    control: &Control,
) -> Result<Vec<(Name, u64)>, StudyError> {
    let grid = Grid {
        x: (0..pixels.len()).map(|i| i as f64).collect(),
        y: vec![0.0],
    };
    let model_at = |x: f64, _| {
        let (zeta, ratio) = pixels[x as usize];
        let model = Setup::dias_del_prado(zeta, ratio).model_on(plate)?;
        let start = model.start(START.0, START.1);
        Ok((model, start))
    };
    let mut names = vec![(Name::Undecided, 0); pixels.len()];
    let all = 0..pixels.len();
    map(
        &grid,
        all,
        model_at,
        &Search::default(),
        control,
        |pixel, found| {
            let kind = found.attractor.ok().map(|motion| motion.kind);
            names[pixel] = (Name::of(kind), found.periods);
            Ok::<(), StudyError>(())
        },
    )?;
    Ok(names)
}

/// Name that the judge gives, and on what grounds.
fn judge(
    pixels: &[Pixel],
    plate: &Arc<PreparedPlate>,
    control: &Control,
) -> Result<Vec<(Name, String)>, StudyError> {
    let begin = |&(zeta, ratio): &Pixel, z: f64| {
        let model = Setup::dias_del_prado(zeta, ratio).model_on(plate)?;
        let start = model.start(z, START.1);
        Ok::<_, StudyError>((model, start))
    };
    let starts: Vec<(Model, Point)> = pixels
        .iter()
        .map(|pixel| begin(pixel, START.0))
        .collect::<Result<_, _>>()?;
    let settled = settle(&starts, LONG, KEPT, control)?;
    let mut names: Vec<(Name, String)> = starts
        .iter()
        .zip(&settled)
        .map(|((model, _), settled)| cycle(model, settled, control))
        .map(|found| found.unwrap_or((Name::Undecided, "no return".to_owned())))
        .collect();
    let open: Vec<usize> = (0..pixels.len())
        .filter(|&i| names[i].0 == Name::Undecided && settled[i].status == Status::Completed)
        .collect();
    let mut copies = Vec::new();
    for &i in &open {
        copies.push((starts[i].0.clone(), settled[i].end.clone()));
        for copy in 1..COPIES {
            copies.push(begin(&pixels[i], START.0 + APART * copy as f64)?);
        }
    }
    // each on its own for the transient, then once plain and once with its tangent
    let before = settle(&copies, LONG, KEPT, control)?;
    let on: Vec<(Model, Point)> = copies
        .iter()
        .zip(&before)
        .map(|((model, _), settled)| (model.clone(), settled.end.clone()))
        .collect();
    let after = settle(&on, LONG, KEPT, control)?;
    let exponents = lyapunov_of_states(&on, 1, LONG, control)?;
    for (k, &i) in open.iter().enumerate() {
        let group = k * COPIES..(k + 1) * COPIES;
        let ends = before[group.clone()].iter().chain(&after[group.clone()]);
        let on_cycle = ends
            .filter_map(|settled| cycle(&starts[i].0, settled, control))
            .next();
        names[i] = on_cycle.unwrap_or_else(|| by_exponents(&exponents[group]));
    }
    Ok(names)
}

/// Whether one of the motions from the initial condition of a pixel is on no cycle after `periods` periods: chaos forgets
/// which of them the map ran.
fn lasts(
    (zeta, ratio): Pixel,
    periods: u64,
    plate: &Arc<PreparedPlate>,
    control: &Control,
) -> Result<bool, StudyError> {
    let model = Setup::dias_del_prado(zeta, ratio).model_on(plate)?;
    let start = |copy: usize| {
        let start = model.start(START.0 + APART * copy as f64, START.1);
        (model.clone(), start)
    };
    let starts: Vec<_> = (0..COPIES).map(start).collect();
    let settled = settle(&starts, periods.saturating_sub(KEPT), KEPT, control)?;
    Ok(settled
        .iter()
        .any(|settled| cycle(&model, settled, control).is_none()))
}

/// The stable cycle that a section is on.
fn cycle(model: &Model, settled: &Settled, control: &Control) -> Option<(Name, String)> {
    let (z, v) = (&settled.z()[0], &settled.v()[0]);
    let last = z.len().checked_sub(1)?;
    let back = |n: &usize| {
        (last - n..=last)
            .map(|k| f64::max((z[k] - z[k - n]).abs(), (v[k] - v[k - n]).abs()))
            .fold(0.0, f64::max)
    };
    let near = (1..=z.len() / 2 - 1).filter(|n| back(n) <= NEAR);
    for n in near {
        let segment = Segment {
            system: model.system().clone(),
            start: settled.end.clone(),
            periods: n as u64,
        };
        let way = record(&segment, &control.options).ok()?;
        let places: Vec<_> = std::iter::once(&settled.end)
            .chain(&way.samples)
            .take(n)
            .map(|point| place(model, point))
            .collect();
        let one = Control {
            threads: 1,
            ..control.clone()
        };
        let family = stroboscopic(model, |_: &[f64]| Ok(model.clone()), &one);
        let Ok(orbit) = find_orbit(&family, &[], &places, &NewtonOptions::default()) else {
            continue;
        };
        let first = model
            .system()
            .point(&orbit.places[0].modes, &orbit.places[0].x);
        let here = (model.z(0, &first.x) - z[last]).abs() <= NEAR
            && (model.v(0, &first.x) - v[last]).abs() <= NEAR;
        if here && orbit.stable() {
            let multiplier = orbit.multipliers[0];
            let text = format!(
                "multiplier {:.6}{:+.6}i, {:.1e} eta from it",
                multiplier.re,
                multiplier.im,
                (model.z(0, &first.x) - z[last]).abs()
            );
            return Some((Name::Periodic(orbit.period()), text));
        }
    }
    None
}

/// The name of motions that end on no cycle.
fn by_exponents(copies: &[saltus::study::LyapunovRun]) -> (Name, String) {
    let text: Vec<String> = copies
        .iter()
        .map(|copy| {
            let (mean, weighted) = (copy.spectrum.estimate()[0], copy.spectrum.weighted()[0]);
            format!(
                "{:.5} +- {:.5}, weighted {:.1e} and {:.1e}",
                mean.per_iterate, mean.standard_error, weighted.mean, weighted.difference
            )
        })
        .collect();
    let each = |is: &dyn Fn(&saltus::study::LyapunovRun) -> bool| copies.iter().all(is);
    let chaos = |copy: &saltus::study::LyapunovRun| {
        let mean = copy.spectrum.estimate()[0];
        mean.per_iterate > 5.0 * mean.standard_error && mean.per_iterate * LONG as f64 > 50.0
    };
    // chaos would leave some 1e-3 in a record of this length
    let torus = |copy: &saltus::study::LyapunovRun| {
        let weighted = copy.spectrum.weighted()[0];
        weighted.mean.abs() < 1e-6 && weighted.difference < 1e-6
    };
    let name = if each(&torus) {
        Name::Torus
    } else if each(&chaos) {
        Name::Chaos
    } else {
        Name::Undecided
    };
    (name, text.join("; "))
}

/// The confusion table, in Markdown.
fn table(quick: &[(Name, u64)], judged: &[(Name, String)]) -> String {
    let heads = [
        "same period",
        "other period",
        "quasi-periodic",
        "chaotic",
        "undecided",
    ];
    let column = |quick: Name, judged: Name| match quick {
        Name::Periodic(_) if quick == judged => 0,
        Name::Periodic(_) => 1,
        Name::Torus => 2,
        Name::Chaos | Name::Passing(_) => 3,
        Name::Undecided => 4,
    };
    let mut rows: BTreeMap<&str, [usize; 5]> = BTreeMap::new();
    let order = [
        "1 periodic",
        "2 quasi-periodic",
        "3 chaotic",
        "4 chaotic at first, then periodic",
        "5 undecided",
    ];
    for name in order {
        rows.insert(name, [0; 5]);
    }
    for ((quick, _), (judged, _)) in quick.iter().zip(judged) {
        let row = match judged {
            Name::Periodic(_) => order[0],
            Name::Torus => order[1],
            Name::Chaos => order[2],
            Name::Passing(_) => order[3],
            Name::Undecided => order[4],
        };
        if let Some(row) = rows.get_mut(row) {
            row[column(*quick, *judged)] += 1;
        }
    }
    let mut text = format!(
        "| judge, below; map, right | {} |\n|---|",
        heads.join(" | ")
    );
    text += &"---|".repeat(heads.len());
    text.push('\n');
    for (name, counts) in rows {
        let cells: Vec<String> = counts.iter().map(ToString::to_string).collect();
        text += &format!("| {} | {} |\n", &name[2..], cells.join(" | "));
    }
    text
}
