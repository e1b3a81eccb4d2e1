//! A cell of a plane, and its bytes in a piece.

use crate::pieces::{Reader, Writer};
use crate::status;
use saltus::model::ModelError;
use saltus::physics::PhysicsError;
use saltus::study::{Attractor, Found, Lost};

/// The finding of one pixel.
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

impl Cell {
    /// Appends the cell to `out`.
    pub(super) fn write(&self, out: &mut Writer) {
        out.whole(self.periods);
        out.whole(self.attractor.is_ok().into());
        match &self.attractor {
            Ok(motion) => write_motion(motion, out),
            Err(loss) => {
                out.whole(loss.impossible.into());
                out.text(&loss.status);
                out.text(&loss.reason);
            }
        }
    }

    /// The next cell; `None` if the bytes are not what [`Self::write`] writes.
    pub(super) fn read(from: &mut Reader) -> Option<Self> {
        let periods = from.whole()?;
        let attractor = match from.whole()? {
            1 => Ok(motion(from)?),
            0 => Err(Loss {
                impossible: from.whole()? != 0,
                status: from.text()?,
                reason: from.text()?,
            }),
            _ => return None,
        };
        Some(Self { attractor, periods })
    }
}

fn write_motion(motion: &Attractor, out: &mut Writer) {
    out.kind(motion.kind);
    out.whole(motion.contact_ratio.len() as u64);
    out.numbers(&motion.contact_ratio);
    out.numbers(&motion.peaks);
    out.numbers(&[motion.rest]);
    let given = [motion.confidence, motion.multiplier];
    out.numbers(&given.map(|value| value.unwrap_or(f64::NAN)));
    out.exponent(motion.exponent);
    motion
        .section
        .iter()
        .chain([&motion.ranges.concat()])
        .for_each(|numbers| out.numbers(numbers));
}

fn motion(from: &mut Reader) -> Option<Attractor> {
    let kind = from.kind()?;
    let samples = kind.period().map_or(0, |n| n as usize);
    let bodies = usize::try_from(from.whole()?).ok()?;
    let (contact_ratio, peaks) = (from.numbers(bodies)?, from.numbers(1 + bodies)?);
    let rest = from.number()?;
    let mut given = || Some(Some(from.number()?).filter(|value| !value.is_nan()));
    let (confidence, multiplier) = (given()?, given()?);
    let exponent = from.exponent()?;
    let section = from.lists(2 * bodies, samples)?;
    let range = |_| Some([from.number()?, from.number()?]);
    Some(Attractor {
        kind,
        contact_ratio,
        peaks,
        section,
        ranges: (0..2 * bodies).map(range).collect::<Option<_>>()?,
        rest,
        multiplier,
        exponent,
        confidence,
    })
}

#[cfg(test)]
mod tests {
    use super::{Cell, Loss};
    use crate::pieces::{Reader, Writer};
    use saltus::orbits::{Exponent, MotionKind};
    use saltus::study::Attractor;

    fn cells() -> Vec<Cell> {
        let cycle = Attractor {
            kind: MotionKind::Periodic(2),
            contact_ratio: vec![0.1 + 0.2, -0.0],
            peaks: vec![1.0 / 3.0, 1e-308, 3.0],
            section: vec![
                vec![1.0, 2.0],
                vec![3.0, f64::INFINITY],
                vec![5.0, 6.0],
                vec![7.0, 8.0],
            ],
            ranges: vec![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]],
            rest: 1e-9,
            multiplier: Some(0.75),
            exponent: None,
            confidence: None,
        };
        let chaos = Attractor {
            kind: MotionKind::Chaotic,
            exponent: Some(Exponent {
                per_iterate: 0.1,
                standard_error: 0.01,
                batches: 20,
                batch_length: 64,
            }),
            confidence: Some(0.9999),
            multiplier: None,
            section: vec![vec![]; 4],
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

    fn bytes() -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut out = Writer::new(&mut bytes);
        cells().iter().for_each(|cell| cell.write(&mut out));
        bytes
    }

    fn read(bytes: &[u8]) -> Option<Vec<Cell>> {
        let mut from = Reader::new(bytes);
        let mut cells = Vec::new();
        while !from.is_empty() {
            cells.push(Cell::read(&mut from)?);
        }
        Some(cells)
    }

    #[test]
    fn cells_come_back_to_the_bit() {
        let again = read(&bytes()).unwrap_or_default();
        assert_eq!(again, cells());
        let mut twice = Vec::new();
        let mut out = Writer::new(&mut twice);
        again.iter().for_each(|cell| cell.write(&mut out));
        assert_eq!(twice, bytes());
    }

    #[test]
    fn no_bytes_make_it_panic() {
        let bytes = bytes();
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
