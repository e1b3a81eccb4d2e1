//! The attractor that a start leads to: one answer per start, for maps of parameters and of starts.
//!
//! A start is run until it is surely on a cycle (see [`saltus_orbits::Samples`]), or for the whole transient; then
//! the cycle once, or the recording, with dense output for peaks (`approach`). Where samples leave a doubt, Newton's
//! method says which stable cycle it is, if any (`confirm`). A motion that is still on its way then is
//! given four times as long. What still has no period is run on with its tangent, until its largest
//! exponent tells what it is (`doubt`), and chaos once more, to see whether it lasts. Starts are independent of each
//! other to the bit: so any part of a map can be computed at any time, by any number of threads.

use saltus_hybrid::Point;

use crate::approach::approach;
use crate::attractor::Found;
use crate::classify::{self, Doubtful};
use crate::ensemble::{Control, StudyError};
use crate::search::Search;
use crate::subject::Subject;

/// The attractor that each of the `starts` leads to, into `sink`, in no particular order.
///
/// `start_at` makes model and start of a number; it is called when the start's turn comes, by several
/// threads at once, and nothing is kept after `sink` has seen the answer. A place without a model, or a
/// run that ends early, is an answer too.
///
/// # Errors
/// [`StudyError::Integrate`] for options out of range or when stopped, and whatever `sink` refuses with.
pub fn attractors<S, F, E>(
    starts: impl IntoIterator<Item = usize, IntoIter: Send>,
    start_at: F,
    search: &Search,
    control: &Control,
    mut sink: impl FnMut(usize, Found<S::NoModel>) -> Result<(), E> + Send,
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
    E: From<StudyError<S::NoModel>> + Send,
    S: Subject,
{
    let mut doubtful = Vec::new();
    approach(starts, &start_at, search, control, |number, found| {
        if search.exponent > 0 && found.has_no_period() {
            doubtful.push(Doubtful::new(number, found));
            return Ok(());
        }
        sink(number, found)
    })?;
    let mut chaotic = Vec::new();
    classify::settle(doubtful, &start_at, search, control, &mut |number,
                                                                 found: Found<
        S::NoModel,
    >| {
        if search.watch > 0 && found.is_chaotic() {
            chaotic.push((number, found));
            return Ok(());
        }
        sink(number, found)
    })?;
    watch(chaotic, &start_at, search, control, &mut sink)
}

/// Runs chaotic motions on, into `sink`: as what they become, or as chaotic over [`Search::watch`] periods more.
fn watch<S, F, E>(
    mut chaotic: Vec<(usize, Found<S::NoModel>)>,
    start_at: &F,
    search: &Search,
    control: &Control,
    sink: &mut (impl FnMut(usize, Found<S::NoModel>) -> Result<(), E> + Send),
) -> Result<(), E>
where
    F: Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
    E: From<StudyError<S::NoModel>> + Send,
    S: Subject,
{
    // In an order of their own, whatever threads found them.
    chaotic.sort_by_key(|one| one.0);
    // what is seen of chaos is known by now, and to read it off each step takes longer than the steps
    let search = Search {
        transient: search.watch,
        record: 1,
        exponent: 0,
        ..*search
    };
    let ends: Vec<(usize, Point)> = chaotic
        .iter()
        .filter_map(|(number, found)| Some((*number, found.arrival.as_ref()?.point.clone())))
        .collect();
    let go_on = |i: usize| {
        let (number, point) = &ends[i];
        Ok((start_at(*number)?.0, point.clone()))
    };
    approach(0..ends.len(), &go_on, &search, control, |i, later| {
        let (number, before) = &chaotic[i];
        sink(*number, before.followed_by(later))
    })
}
