//! Work on many items at once, for studies that take one.

use std::sync::atomic::{AtomicUsize, Ordering};

use saltus::hybrid::on_threads;

/// `f` of each item, spread over threads (0: as many as the machine has), in the order of the items.
pub(crate) fn in_parallel<I: Sync, O: Send>(
    items: &[I],
    threads: usize,
    f: impl Fn(&I) -> O + Sync,
) -> Vec<O> {
    let next = AtomicUsize::new(0);
    let work = |_| {
        let take = || {
            let index = next.fetch_add(1, Ordering::Relaxed);
            items.get(index).map(|item| (index, item))
        };
        std::iter::from_fn(take)
            .map(|(index, item)| (index, f(item)))
            .collect::<Vec<_>>()
    };
    let found = on_threads(threads, items.len(), work);
    let mut out: Vec<(usize, O)> = found.into_iter().flatten().collect();
    out.sort_by_key(|(index, _)| *index);
    out.into_iter().map(|(_, value)| value).collect()
}
