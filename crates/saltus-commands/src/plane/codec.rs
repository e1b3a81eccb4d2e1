//! A cell of a plane as bytes: what a piece of the work folder is made of. Numbers come back to the bit.

use crate::status;
use saltus::model::ModelError;
use saltus::orbits::Exponent;
use saltus::physics::PhysicsError;
use saltus::study::{Attractor, Found, Kind, Lost};

/// What became of one pixel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cell {
    pub(crate) attractor: Result<Attractor, Loss>,
    /// Forcing periods run.
    pub(crate) periods: u64,
}

/// Why there is no motion, in words that fit a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Loss {
    /// A word, as in tables.
    pub(crate) status: String,
    /// A sentence.
    pub(crate) reason: String,
    /// Whether the study is to blame, not the computation.
    pub(crate) impossible: bool,
}

impl From<Found> for Cell {
    fn from(found: Found) -> Self {
        Self {
            attractor: found.attractor.map_err(Loss::from),
            periods: found.periods,
        }
    }
}

impl From<Lost> for Loss {
    fn from(lost: Lost) -> Self {
        match lost {
            Lost::NoModel(error) => Self {
                status: "no-model".to_owned(),
                reason: error.to_string(),
                impossible: !matches!(
                    error,
                    ModelError::Physics(
                        PhysicsError::Algebra { .. } | PhysicsError::NotConverged { .. }
                    )
                ),
            },
            Lost::Ended(end) => Self {
                status: end.name().to_owned(),
                reason: status::text(&end, None),
                impossible: false,
            },
        }
    }
}

/// Appends the cell to `out`.
pub(super) fn write(cell: &Cell, out: &mut Vec<u8>) {
    let mut out = Writer(out);
    out.whole(cell.periods);
    match &cell.attractor {
        Ok(motion) => {
            let (kind, n) = match motion.kind {
                Kind::Periodic(n) => (1, n),
                Kind::NotPeriodic => (2, 0),
                Kind::Undecided => (3, 0),
                Kind::QuasiPeriodic => (4, 0),
                Kind::Chaotic => (5, 0),
            };
            out.whole(kind);
            out.whole(n.into());
            out.whole(motion.ranges.len() as u64);
            out.numbers(&motion.contact_ratio);
            out.numbers(&motion.peak_reaction);
            out.numbers(&[motion.peak_acceleration, motion.rest]);
            out.numbers(&[motion.confidence.unwrap_or(f64::NAN)]);
            out.exponent(motion.exponent);
            motion
                .z
                .iter()
                .chain(&motion.v)
                .for_each(|s| out.numbers(s));
            for (z, v) in &motion.ranges {
                out.numbers(&[z[0], z[1], v[0], v[1]]);
            }
        }
        Err(loss) => {
            out.whole(0);
            out.whole(loss.impossible.into());
            out.text(&loss.status);
            out.text(&loss.reason);
        }
    }
}

/// The cells in `bytes`; `None` if they are not what [`write`] writes.
pub(super) fn read(bytes: &[u8]) -> Option<Vec<Cell>> {
    let mut from = Reader(bytes);
    let mut cells = Vec::new();
    while !from.0.is_empty() {
        cells.push(cell(&mut from)?);
    }
    Some(cells)
}

fn cell(from: &mut Reader) -> Option<Cell> {
    let periods = from.whole()?;
    let kind = from.whole()?;
    if kind == 0 {
        let loss = Loss {
            impossible: from.whole()? != 0,
            status: from.text()?,
            reason: from.text()?,
        };
        return Some(Cell {
            attractor: Err(loss),
            periods,
        });
    }
    let n = u32::try_from(from.whole()?).ok()?;
    let kind = match kind {
        1 => Kind::Periodic(n),
        2 => Kind::NotPeriodic,
        3 => Kind::Undecided,
        4 => Kind::QuasiPeriodic,
        5 => Kind::Chaotic,
        _ => return None,
    };
    let bodies = usize::try_from(from.whole()?).ok()?;
    let (contact_ratio, peak_reaction) = (from.numbers(bodies)?, from.numbers(bodies)?);
    let (peak_acceleration, rest) = (from.number()?, from.number()?);
    let confidence = Some(from.number()?).filter(|value| !value.is_nan());
    let exponent = from.exponent()?;
    let mut lists =
        || -> Option<Vec<Vec<f64>>> { (0..bodies).map(|_| from.numbers(n as usize)).collect() };
    let (z, v) = (lists()?, lists()?);
    let range = |_| {
        Some((
            [from.number()?, from.number()?],
            [from.number()?, from.number()?],
        ))
    };
    let attractor = Attractor {
        kind,
        contact_ratio,
        peak_reaction,
        peak_acceleration,
        z,
        v,
        ranges: (0..bodies).map(range).collect::<Option<_>>()?,
        rest,
        exponent,
        confidence,
    };
    Some(Cell {
        attractor: Ok(attractor),
        periods,
    })
}

/// What stands for none.
const NO_EXPONENT: Exponent = Exponent {
    per_iterate: 0.0,
    standard_error: 0.0,
    batches: 0,
    batch_length: 0,
};

struct Writer<'a>(&'a mut Vec<u8>);

impl Writer<'_> {
    fn whole(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }
    fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|v| self.whole(v.to_bits()));
    }
    fn exponent(&mut self, exponent: Option<Exponent>) {
        let (there, e) = (exponent.is_some(), exponent.unwrap_or(NO_EXPONENT));
        self.whole(there.into());
        self.numbers(&[e.per_iterate, e.standard_error]);
        self.whole(e.batches as u64);
        self.whole(e.batch_length as u64);
    }
    fn text(&mut self, text: &str) {
        self.whole(text.len() as u64);
        self.0.extend(text.as_bytes());
    }
}

struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn whole(&mut self) -> Option<u64> {
        let (first, rest) = self.0.split_first_chunk::<8>()?;
        self.0 = rest;
        Some(u64::from_le_bytes(*first))
    }
    fn number(&mut self) -> Option<f64> {
        self.whole().map(f64::from_bits)
    }
    fn numbers(&mut self, count: usize) -> Option<Vec<f64>> {
        (0..count).map(|_| self.number()).collect()
    }
    fn exponent(&mut self) -> Option<Option<Exponent>> {
        let there = self.whole()? != 0;
        let exponent = Exponent {
            per_iterate: self.number()?,
            standard_error: self.number()?,
            batches: usize::try_from(self.whole()?).ok()?,
            batch_length: usize::try_from(self.whole()?).ok()?,
        };
        Some(there.then_some(exponent))
    }
    fn text(&mut self) -> Option<String> {
        let length = usize::try_from(self.whole()?).ok()?;
        let (text, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::{Cell, Exponent, Loss, read, write};
    use saltus::study::{Attractor, Kind};

    fn cells() -> Vec<Cell> {
        let cycle = Attractor {
            kind: Kind::Periodic(2),
            contact_ratio: vec![0.1 + 0.2, -0.0],
            peak_reaction: vec![1e-308, 3.0],
            peak_acceleration: 1.0 / 3.0,
            z: vec![vec![1.0, 2.0], vec![3.0, f64::INFINITY]],
            v: vec![vec![5.0, 6.0], vec![7.0, 8.0]],
            ranges: vec![([1.0, 2.0], [5.0, 6.0]), ([3.0, 4.0], [7.0, 8.0])],
            rest: 1e-9,
            exponent: None,
            confidence: None,
        };
        let chaos = Attractor {
            kind: Kind::Chaotic,
            exponent: Some(Exponent {
                per_iterate: 0.1,
                standard_error: 0.01,
                batches: 20,
                batch_length: 64,
            }),
            confidence: Some(0.9999),
            z: vec![vec![]; 2],
            v: vec![vec![]; 2],
            ..cycle.clone()
        };
        let lost = Loss {
            status: "chattering".to_owned(),
            reason: "ζ".to_owned(),
            impossible: true,
        };
        [Ok(cycle), Err(lost), Ok(chaos)]
            .map(|attractor| Cell {
                attractor,
                periods: 1 << 40,
            })
            .to_vec()
    }

    #[test]
    fn cells_come_back_to_the_bit() {
        let mut bytes = Vec::new();
        cells().iter().for_each(|cell| write(cell, &mut bytes));
        let again = read(&bytes).unwrap_or_default();
        assert_eq!(again, cells());
        let mut twice = Vec::new();
        again.iter().for_each(|cell| write(cell, &mut twice));
        assert_eq!(twice, bytes);
    }

    #[test]
    fn no_bytes_make_it_panic() {
        let mut bytes = Vec::new();
        cells().iter().for_each(|cell| write(cell, &mut bytes));
        for end in 0..bytes.len() {
            let _ = read(&bytes[..end]);
            let mut wrong = bytes.clone();
            wrong[end] ^= 0xff;
            let _ = read(&wrong);
        }
        assert_eq!(read(&[]), Some(Vec::new()));
        assert_eq!(read(&bytes[..bytes.len() - 1]), None);
    }
}
