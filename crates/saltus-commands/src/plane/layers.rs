//! The layers of a plane: one number per pixel and quantity.

use super::{Cell, Loss, Plane};
use crate::failure::Failure;
use saltus::study::Kind;
use serde::Serialize;
use std::collections::BTreeMap;

/// What became of a pixel, by the code it has in the layer `status`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Status {
    Periodic,
    QuasiPeriodic,
    Chaotic,
    NotPeriodic,
    Undecided,
    NoModel,
    Chattering,
    NotFinite,
    TooManySteps,
    /// Anything else that ends a run.
    Ended,
}

impl Status {
    pub(crate) const ALL: [Self; 10] = [
        Self::Periodic,
        Self::QuasiPeriodic,
        Self::Chaotic,
        Self::NotPeriodic,
        Self::Undecided,
        Self::NoModel,
        Self::Chattering,
        Self::NotFinite,
        Self::TooManySteps,
        Self::Ended,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Periodic => "periodic",
            Self::QuasiPeriodic => "quasi-periodic",
            Self::Chaotic => "chaotic",
            Self::NotPeriodic => "not-periodic",
            Self::Undecided => "undecided",
            Self::NoModel => "no-model",
            Self::Chattering => "chattering",
            Self::NotFinite => "not-finite",
            Self::TooManySteps => "too-many-steps",
            Self::Ended => "ended",
        }
    }

    fn of(cell: &Cell) -> Self {
        match &cell.attractor {
            Ok(motion) => match motion.kind {
                Kind::Periodic(_) => Self::Periodic,
                Kind::QuasiPeriodic => Self::QuasiPeriodic,
                Kind::Chaotic => Self::Chaotic,
                Kind::NotPeriodic => Self::NotPeriodic,
                Kind::Undecided => Self::Undecided,
            },
            Err(loss) => {
                let named = |status: &&Self| status.name() == loss.status;
                Self::ALL.iter().find(named).copied().unwrap_or(Self::Ended)
            }
        }
    }

    /// Whether there is a motion, periodic or not.
    pub(crate) fn is_motion(self) -> bool {
        self <= Self::Undecided
    }
}

/// All layers, row by row as the grid; NaN where there is no motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layers {
    /// 0 where not periodic.
    pub(crate) period: Vec<u16>,
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
        self.period.push(match motion.map(|m| m.kind) {
            Some(Kind::Periodic(n)) => n as u16,
            _ => 0,
        });
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
        for &period in self.period.iter().filter(|&&period| period > 0) {
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
            Status::Chaotic => run,
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
        let known = Status::ALL
            .iter()
            .filter(|status| **status < Status::Undecided);
        let known: Vec<&str> = known.map(|status| status.name()).collect();
        let rest = self.status.iter().filter(|(name, _)| !known.contains(name));
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
        let periodic = Status::Periodic.name();
        let others = Status::ALL.iter().filter_map(|status| {
            let pixels = self.status.get(status.name())?;
            let shown = status.name() != periodic;
            let over = self.chaotic_over.filter(|_| *status == Status::Chaotic);
            let over = over.map_or(String::new(), |span| {
                format!(" for {} periods and more", span.min)
            });
            shown.then(|| format!("  {:>5.1} %  {}{over}", percent(*pixels), status.name()))
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
