//! The motion at the end of each row of a sweep: its label, and its largest exponents.
//!
//! The label goes on from the very state with which the row ended, and the exponents from where the label was
//! found: all are of the motion that the row shows, also where others coexist. A chaotic transient that ends after
//! the row is an exception: label and exponents are then of what follows it.

use saltus_hybrid::{Point, Status};
use saltus_orbits::{Exponent, MotionKind};

use crate::pursuit::attractors;
use crate::search::Search;
use crate::subject::Subject;
use crate::{Control, Outcome, StudyError, SweepRow, lyapunov_of_states};

/// Name of the motion of a row in the long run.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Kind of the motion; [`MotionKind::Undecided`] also if going on from the row ended early.
    pub kind: MotionKind,
    /// The largest Lyapunov exponent (per forcing period), where it took one to say what the motion is.
    pub exponent: Option<Exponent>,
    /// Confidence of the test behind the name, as in [`Attractor`](crate::Attractor); `None` for a cycle known by its
    /// returns.
    pub confidence: Option<f64>,
    /// Last state, to go on from; `None` if going on from the row ended early.
    pub end: Option<Point>,
}

/// Periods in which cycles up to [`saltus_orbits::MAX_PERIOD`] come back three times and more. The row itself was
/// the transient.
const RETURNS: u64 = 128;

/// Motions whose exponents are followed together: enough for eight lanes on 32 threads, while models and
/// records of more would only wait in memory.
const TOGETHER: usize = 256;

/// The label of each row that was run to its end; `None` for the others.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped.
pub fn labels<S, F>(
    rows: &[SweepRow<S::NoModel>],
    model_at: F,
    control: &Control,
) -> Outcome<Vec<Option<Label>>, S>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    let ended: Vec<(usize, f64, &Point)> = rows
        .iter()
        .enumerate()
        .filter(|(_, row)| row.status == Ok(Status::Completed))
        .filter_map(|(index, row)| Some((index, row.value, row.end.as_ref()?)))
        .collect();
    let start_at = |number: usize| {
        let (_, value, point) = ended[number];
        Ok((model_at(value)?, point.clone()))
    };
    let search = Search {
        transient: RETURNS,
        ..Search::default()
    };
    let mut labels = vec![None; rows.len()];
    attractors(
        0..ended.len(),
        start_at,
        &search,
        control,
        |number, found| {
            let motion = found.attractor.as_ref().ok();
            let label = Label {
                kind: motion.map_or(MotionKind::Undecided, |motion| motion.kind),
                exponent: motion.and_then(|motion| motion.exponent),
                confidence: motion.and_then(|motion| motion.confidence),
                end: found.arrival.map(|arrival| arrival.point),
            };
            labels[ended[number].0] = Some(label);
            Ok::<(), StudyError<S::NoModel>>(())
        },
    )?;
    Ok(labels)
}

/// The `columns` largest Lyapunov exponents (per forcing period) of the motion of each row, over `periods` periods
/// from where its label was found; none without a label, or if the motion ends early now.
///
/// # Errors
/// As [`lyapunov_of_states`].
pub fn exponents<S, F>(
    rows: &[SweepRow<S::NoModel>],
    labels: &[Option<Label>],
    model_at: F,
    columns: usize,
    periods: u64,
    control: &Control,
) -> Outcome<Vec<Vec<Exponent>>, S>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel> + Sync,
{
    let labelled: Vec<(usize, f64, &Point)> = (rows.iter().zip(labels).enumerate())
        .filter_map(|(index, (row, label))| Some((index, row.value, label.as_ref()?.end.as_ref()?)))
        .collect();
    let mut exponents = vec![Vec::new(); rows.len()];
    for some in labelled.chunks(TOGETHER) {
        let start =
            |&(_, value, point): &(usize, f64, &Point)| Ok((model_at(value)?, point.clone()));
        let starts = some
            .iter()
            .map(start)
            .collect::<Result<Vec<_>, _>>()
            .map_err(StudyError::Model)?;
        let found = lyapunov_of_states(&starts, columns, periods, control)?;
        for ((index, ..), growth) in some.iter().zip(found) {
            if growth.status == Status::Completed {
                exponents[*index] = growth.spectrum.estimate();
            }
        }
    }
    Ok(exponents)
}
