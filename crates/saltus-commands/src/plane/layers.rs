//! The layers of a plane: one number per pixel and quantity.

use super::{Cell, Loss, Plane};
use crate::failure::Failure;
use saltus::orbits::MotionKind;
use serde::Serialize;
use std::collections::BTreeMap;

/// The end of a pixel: a motion, or the reason why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    Motion(MotionKind),
    Lost(Ending),
}

/// Ways in which a pixel has no motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    NoModel,
    Chattering,
    NotFinite,
    TooManySteps,
    /// Anything else that ends a run.
    Other,
}

impl Ending {
    const ALL: [Self; 5] = [
        Self::NoModel,
        Self::Chattering,
        Self::NotFinite,
        Self::TooManySteps,
        Self::Other,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::NoModel => "no-model",
            Self::Chattering => "chattering",
            Self::NotFinite => "not-finite",
            Self::TooManySteps => "too-many-steps",
            Self::Other => "ended",
        }
    }

    fn of(loss: &Loss) -> Self {
        let named = |ending: &Self| ending.name() == loss.status;
        Self::ALL.into_iter().find(named).unwrap_or(Self::Other)
    }
}

impl Status {
    /// The names of all, each at the place of its [`Self::code`].
    pub(super) fn names() -> impl Iterator<Item = &'static str> {
        let endings = Ending::ALL.map(Ending::name);
        MotionKind::NAMES.into_iter().chain(endings)
    }

    /// Number in the layer `status`.
    pub(super) fn code(self) -> u8 {
        match self {
            Self::Motion(kind) => kind.code() as u8,
            Self::Lost(ending) => MotionKind::NAMES.len() as u8 + ending as u8,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Motion(kind) => kind.name(),
            Self::Lost(ending) => ending.name(),
        }
    }

    fn of(cell: &Cell) -> Self {
        match &cell.attractor {
            Ok(motion) => Self::Motion(motion.kind),
            Err(loss) => Self::Lost(Ending::of(loss)),
        }
    }

    /// Whether there is a motion, periodic or not.
    pub(crate) fn is_motion(self) -> bool {
        matches!(self, Self::Motion(_))
    }

    /// Forcing periods of a cycle, 0 where there is none.
    pub(super) fn period(self) -> u16 {
        match self {
            Self::Motion(MotionKind::Periodic(n)) => n as u16,
            _ => 0,
        }
    }
}

/// All layers, row by row as the grid; NaN where there is no motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layers {
    pub(crate) status: Vec<Status>,
    /// Jumper by jumper.
    pub(crate) contact_ratio: Vec<Vec<f64>>,
    pub(crate) peak_reaction: Vec<Vec<f64>>,
    pub(crate) peak_acceleration: Vec<f64>,
    /// Largest Lyapunov exponent per forcing period, and its standard error; NaN where the returns of a cycle
    /// told what the motion is.
    pub(crate) exponent: Vec<f64>,
    pub(crate) exponent_error: Vec<f64>,
    pub(crate) periods_run: Vec<u32>,
    /// The first pixel without a motion.
    pub(crate) first_loss: Option<(usize, Loss)>,
}

/// The first pixel without a motion.
#[derive(Serialize)]
pub(crate) struct FirstFailure {
    x: f64,
    y: f64,
    status: String,
    pub(crate) status_text: String,
}

impl FirstFailure {
    pub(crate) fn of(plane: &Plane, layers: &Layers) -> Option<Self> {
        let (pixel, loss) = layers.first_loss.as_ref()?;
        let (x, y) = plane.grid.at(*pixel);
        Some(Self {
            x,
            y,
            status: loss.status.clone(),
            status_text: loss.reason.clone(),
        })
    }
}

/// How often each status and each period occurs.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Tally {
    status: BTreeMap<&'static str, usize>,
    /// Fewest and most forcing periods over which a chaotic motion was seen not to settle.
    pub(crate) chaotic_over: Option<Span>,
    pub(crate) periods: Vec<PeriodShare>,
}

#[derive(Clone, Debug, Serialize)]
pub(crate) struct PeriodShare {
    pub(crate) period: u16,
    pub(crate) pixels: usize,
    pub(crate) share: f64,
}

/// The range of a layer, where there is a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Span {
    pub(crate) min: f64,
    pub(crate) max: f64,
}

impl Layers {
    /// For so many people.
    pub(crate) fn new(jumpers: usize) -> Self {
        Self {
            contact_ratio: vec![Vec::new(); jumpers],
            peak_reaction: vec![Vec::new(); jumpers],
            ..Self::default()
        }
    }

    /// Adds the next pixel.
    pub(crate) fn push(&mut self, cell: &Cell) {
        let motion = cell.attractor.as_ref().ok();
        if let (None, Err(loss)) = (&self.first_loss, &cell.attractor) {
            self.first_loss = Some((self.status.len(), loss.clone()));
        }
        self.status.push(Status::of(cell));
        self.peak_acceleration
            .push(motion.map_or(f64::NAN, |m| m.peak_acceleration));
        let exponent = motion.and_then(|m| m.exponent);
        self.exponent
            .push(exponent.map_or(f64::NAN, |e| e.per_iterate));
        self.exponent_error
            .push(exponent.map_or(f64::NAN, |e| e.standard_error));
        let run = u32::try_from(cell.periods).unwrap_or(u32::MAX);
        self.periods_run.push(run);
        for jumper in 0..self.contact_ratio.len() {
            let of = |list: &[f64]| list.get(jumper).copied().unwrap_or(f64::NAN);
            self.contact_ratio[jumper].push(motion.map_or(f64::NAN, |m| of(&m.contact_ratio)));
            self.peak_reaction[jumper].push(motion.map_or(f64::NAN, |m| of(&m.peak_reaction)));
        }
    }

    pub(crate) fn tally(&self) -> Tally {
        let mut status = BTreeMap::new();
        for one in &self.status {
            *status.entry(one.name()).or_default() += 1;
        }
        let mut periods: BTreeMap<u16, usize> = BTreeMap::new();
        let all = self.status.iter().map(|status| status.period());
        for period in all.filter(|&period| period > 0) {
            *periods.entry(period).or_default() += 1;
        }
        let share = |(period, pixels): (u16, usize)| PeriodShare {
            period,
            pixels,
            share: pixels as f64 / self.status.len() as f64,
        };
        let chaotic = self.chaotic_periods();
        let chaotic = chaotic.into_iter().filter(|&periods| periods > 0);
        Tally {
            status,
            chaotic_over: span(&chaotic.map(f64::from).collect::<Vec<_>>()),
            periods: periods.into_iter().map(share).collect(),
        }
    }

    /// Forcing periods over which each chaotic motion was seen not to settle; 0 where the motion is not chaotic.
    pub(crate) fn chaotic_periods(&self) -> Vec<u32> {
        let pixels = self.status.iter().zip(&self.periods_run);
        let chaotic = |(&status, &run): (&Status, &u32)| match status {
            Status::Motion(MotionKind::Chaotic) => run,
            _ => 0,
        };
        pixels.map(chaotic).collect()
    }

    /// Nothing is worth keeping if there is no motion anywhere.
    pub(crate) fn refuse_if_all_lost(&self) -> Result<(), Failure> {
        if self.status.iter().any(|status| status.is_motion()) {
            return Ok(());
        }
        let Some((_, loss)) = &self.first_loss else {
            return Err(Failure::computation("the plane has no pixels"));
        };
        let reason = if loss.impossible {
            Failure::Refused {
                message: loss.reason.clone(),
                help: None,
            }
        } else {
            let what = "no pixel was run to its end; the first";
            Failure::computation(format!("{what}: {}", loss.reason))
        };
        Err(Failure::Lost(Box::new(reason)))
    }
}

impl Tally {
    /// Pixels that are undecided or failed.
    pub(crate) fn without_attractor(&self) -> usize {
        let known =
            |name: &&str| MotionKind::NAMES.contains(name) && *name != MotionKind::Undecided.name();
        let rest = self.status.iter().filter(|(name, _)| !known(name));
        rest.map(|(_, pixels)| pixels).sum()
    }

    /// For people: one line per kind of motion.
    pub(crate) fn text(&self) -> String {
        let all: usize = self.status.values().sum();
        let percent = |pixels: usize| 100.0 * pixels as f64 / all as f64;
        let mut lines: Vec<String> = self
            .periods
            .iter()
            .map(|p| format!("  {:>5.1} %  {}T", percent(p.pixels), p.period))
            .collect();
        // the first name, of cycles, is there by their periods
        let others = Status::names().skip(1).filter_map(|name| {
            let pixels = self.status.get(name)?;
            let over = self.chaotic_over;
            let over = over.filter(|_| name == MotionKind::Chaotic.name());
            let over = over.map_or(String::new(), |span| {
                format!(" for {} periods and more", span.min)
            });
            Some(format!("  {:>5.1} %  {name}{over}", percent(*pixels)))
        });
        lines.extend(others);
        lines.join("\n") + "\n"
    }
}

/// The range of the values that are there.
pub(crate) fn span(values: &[f64]) -> Option<Span> {
    let known = values.iter().copied().filter(|v| v.is_finite());
    known.fold(None, |span: Option<Span>, v| {
        let Span { min, max } = span.unwrap_or(Span { min: v, max: v });
        Some(Span {
            min: min.min(v),
            max: max.max(v),
        })
    })
}
