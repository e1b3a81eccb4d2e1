//! The layers of a plane: one number per pixel and quantity.

use super::{Cell, Loss};
use crate::failure::CommandError;
use crate::quantities as q;
use saltus::orbits::MotionKind;
use saltus::study::Effects;
use std::collections::BTreeMap;

/// Status of a pixel, by its code in the layer of that name.
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
        q::PIXEL_STATUS.words[self as usize]
    }

    fn of(cell: &Cell) -> Self {
        let name = match &cell.attractor {
            Ok(motion) => motion.kind.name(),
            Err(loss) => &loss.status,
        };
        let named = |status: &&Self| status.name() == name;
        Self::ALL.iter().find(named).copied().unwrap_or(Self::Ended)
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

/// How often each status and each period occurs.
#[derive(Clone, Debug)]
pub(crate) struct Tally {
    /// By the code of the status.
    pub(crate) status: [usize; Status::ALL.len()],
    /// Fewest and most forcing periods over which a chaotic motion was seen not to settle.
    pub(crate) chaotic_over: Option<[u32; 2]>,
    pub(crate) periods: Vec<PeriodShare>,
}

#[derive(Clone, Debug)]
pub(crate) struct PeriodShare {
    pub(crate) period: u16,
    pub(crate) pixels: usize,
    pub(crate) share: f64,
}

/// The range of a layer, where there is a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
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
        let period = motion.and_then(|m| period(m.kind));
        self.period.push(period.unwrap_or(0) as u16);
        self.status.push(Status::of(cell));
        self.peak_acceleration
            .push(motion.map_or(f64::NAN, Effects::peak_acceleration));
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
            self.peak_reaction[jumper].push(motion.map_or(f64::NAN, |m| of(m.peak_reaction())));
        }
    }

    pub(crate) fn tally(&self) -> Tally {
        let mut status = [0; Status::ALL.len()];
        for &one in &self.status {
            status[one as usize] += 1;
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
        let chaotic = || self.chaotic_periods().filter(|&periods| periods > 0);
        let least = chaotic().min();
        Tally {
            status,
            chaotic_over: least.zip(chaotic().max()).map(<[u32; 2]>::from),
            periods: periods.into_iter().map(share).collect(),
        }
    }

    /// Forcing periods over which each chaotic motion was seen not to settle; 0 where the motion is not chaotic.
    pub(crate) fn chaotic_periods(&self) -> impl Iterator<Item = u32> {
        let pixels = self.status.iter().zip(&self.periods_run);
        pixels.map(|(&status, &run)| match status {
            Status::Chaotic => run,
            _ => 0,
        })
    }

    /// Range of the largest acceleration of the floor.
    pub(crate) fn acceleration(&self) -> Option<Span> {
        span(&self.peak_acceleration)
    }

    /// Why the first pixel without a motion has none, for people; empty if all have one.
    pub(crate) fn first_failure(&self) -> String {
        let first = self.first_loss.as_ref();
        first.map_or(String::new(), |(_, loss)| {
            format!("  first failure: {}\n", loss.reason)
        })
    }

    /// Nothing is worth keeping if there is no motion anywhere.
    pub(crate) fn refuse_if_all_lost(&self) -> Result<(), CommandError> {
        if self.status.iter().any(|status| status.is_motion()) {
            return Ok(());
        }
        let Some((_, loss)) = &self.first_loss else {
            return Err(CommandError::computation("the plane has no pixels"));
        };
        let reason = if loss.impossible {
            CommandError::Refused {
                message: loss.reason.clone(),
                help: None,
            }
        } else {
            let what = "no pixel was run to its end; the first";
            CommandError::computation(format!("{what}: {}", loss.reason))
        };
        Err(CommandError::Lost(Box::new(reason)))
    }
}

impl Tally {
    /// Pixels that are undecided or failed.
    pub(crate) fn without_attractor(&self) -> usize {
        let rest = Status::ALL.iter().zip(self.status);
        let rest = rest.filter(|(status, _)| **status >= Status::Undecided);
        rest.map(|(_, pixels)| pixels).sum()
    }

    /// Periods over which chaotic motions were watched, in words; empty if there are none.
    pub(crate) fn chaotic_for(&self) -> String {
        let over = self.chaotic_over;
        over.map_or(String::new(), |[least, _]| {
            format!(" for {least} periods and more")
        })
    }

    /// For people: one line per kind of motion.
    pub(crate) fn text(&self) -> String {
        let all: usize = self.status.iter().sum();
        let percent = |pixels: usize| 100.0 * pixels as f64 / all as f64;
        let mut lines: Vec<String> = self
            .periods
            .iter()
            .map(|p| format!("  {:>5.1} %  {}T", percent(p.pixels), p.period))
            .collect();
        let others = Status::ALL.iter().zip(self.status);
        let others = others.filter(|&(&status, pixels)| status != Status::Periodic && pixels > 0);
        let others = others.map(|(&status, pixels)| {
            let over = match status {
                Status::Chaotic => self.chaotic_for(),
                _ => String::new(),
            };
            format!("  {:>5.1} %  {}{over}", percent(pixels), status.name())
        });
        lines.extend(others);
        lines.join("\n") + "\n"
    }
}

/// Forcing periods of a cycle.
pub(crate) fn period(kind: MotionKind) -> Option<u32> {
    match kind {
        MotionKind::Periodic(n) => Some(n),
        _ => None,
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
