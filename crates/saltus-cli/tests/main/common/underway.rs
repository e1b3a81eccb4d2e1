//! Planes of few pixels, and runs of them that are killed.

use super::{Desk, program};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

/// Few pixels, a few periods each; where pixels make many pieces, fewer periods and no exponents, which cost ten times
/// the rest.
pub(crate) fn small(command: &str, count: u32) -> Vec<String> {
    let (transient, exponent) = if count < 10 { (40, 100) } else { (10, 0) };
    let sets = [
        "plate.inertia=condensed".to_owned(),
        format!("{command}.x.count={count}"),
        format!("{command}.y.count={count}"),
        format!("{command}.transient={transient}"),
        format!("{command}.record=8"),
        format!("{command}.exponent={exponent}"),
    ];
    sets.into_iter()
        .flat_map(|set| ["--set".to_owned(), set])
        .collect()
}

/// A run that can be stopped from outside, and its work folder.
pub(crate) struct Underway {
    pub(crate) child: Child,
    pub(crate) pieces: PathBuf,
}

impl Underway {
    pub(crate) fn start(desk: &Desk, command: &str, count: u32, out: &str, more: &[&str]) -> Self {
        let child = Command::new(program())
            .args([command, &desk.paper(), "--quiet", "--out", &desk.str(out)])
            .args(small(command, count))
            .args(more)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        Self {
            child,
            pieces: desk.path(&format!(".{out}.saltus-pieces")),
        }
    }

    /// Waits until there are so many pieces, or the run has ended.
    pub(crate) fn until(&mut self, pieces: usize) {
        while count_pieces(&self.pieces) < pieces && self.child.try_wait().unwrap().is_none() {
            thread::sleep(Duration::from_millis(1));
        }
    }

    /// SIGKILL: nothing can be tidied up.
    pub(crate) fn kill(mut self) {
        // a run that has ended already is as good
        let _ = self.child.kill();
        self.child.wait().unwrap();
    }
}

/// Finished pieces in a folder.
pub(crate) fn count_pieces(folder: &Path) -> usize {
    fs::read_dir(folder).map_or(0, |entries| {
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        names
            .filter(|name| name.starts_with("piece-") && name.ends_with(".bin"))
            .count()
    })
}
