//! The work folder: finished pieces of a plane, so that an interrupted computation can go on.
//!
//! A piece is a run of neighbouring pixels. Pixels come in any order and leave in theirs: pieces that are
//! complete wait until all before them are, so the results do not depend on who was first, and what is
//! held in memory is the pieces under way and not the plane.

use super::{Cell, Gather, Plane, codec};
use crate::context::{Context, Keep};
use crate::failure::Failure;
use saltus_config::Study;
use saltus_results::PieceStore;
use saltus_results::pieces::{MANIFEST, pieces_beside};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

/// Pieces in a plane, about: each costs a file, and an interruption costs those under way.
const PIECES: usize = 256;
/// Least and most pixels in a piece.
const PIXELS: (usize, usize) = (16, 4096);

/// A plane on its way.
pub(super) struct Work<'a, G> {
    gather: &'a mut G,
    store: Option<PieceStore>,
    total: usize,
    /// Pixels in a piece; the last one may have fewer.
    size: usize,
    /// Pieces that the store has.
    kept: BTreeSet<u32>,
    /// Pieces under way, with the number of cells that are still to come.
    open: BTreeMap<u32, (usize, Vec<Option<Cell>>)>,
    /// Complete pieces that wait for one before them.
    waiting: BTreeMap<u32, Vec<Cell>>,
    /// First piece that was not handed on.
    next: u32,
}

/// The work folder after the computation.
pub(crate) struct Kept {
    store: Option<PieceStore>,
}

impl<'a, G: Gather> Work<'a, G> {
    /// Opens the work folder beside the folder of results, if there is to be one.
    pub(super) fn open(
        context: &Context,
        command: &str,
        study: &Study,
        plane: &Plane,
        gather: &'a mut G,
    ) -> Result<Self, Failure> {
        let total = plane.grid.len();
        let size = total.div_ceil(PIECES).clamp(PIXELS.0, PIXELS.1);
        let open = |keep: &Keep| store(keep, &fingerprint(command, study, plane, size));
        let store = context.keep.as_ref().map(open).transpose()?;
        let mut kept = BTreeSet::new();
        if let Some(store) = &store {
            let survey = store.survey()?;
            kept.extend(survey.whole);
            for damage in &survey.damaged {
                context.watch.note(&format!(
                    "piece {} of the work folder is damaged ({}) and is made again",
                    damage.piece, damage.problem
                ));
            }
        }
        Ok(Self {
            gather,
            store,
            total,
            size,
            kept,
            open: BTreeMap::new(),
            waiting: BTreeMap::new(),
            next: 0,
        })
    }

    fn pixels(&self, piece: u32) -> Range<usize> {
        let first = piece as usize * self.size;
        first..(first + self.size).min(self.total)
    }

    fn pieces(&self) -> u32 {
        // the clamp on the size keeps this far below u32
        self.total.div_ceil(self.size) as u32
    }

    /// Pixels that need not be computed.
    pub(super) fn kept(&self) -> usize {
        self.kept
            .iter()
            .map(|&piece| self.pixels(piece).len())
            .sum()
    }

    /// The pixels to compute, piece by piece.
    pub(super) fn missing(&self) -> Vec<Range<usize>> {
        let missing = (0..self.pieces()).filter(|piece| !self.kept.contains(piece));
        missing.map(|piece| self.pixels(piece)).collect()
    }

    /// Takes a cell. A piece that is complete is on the disk when this returns.
    pub(super) fn put(&mut self, pixel: usize, cell: Cell) -> Result<(), Failure> {
        let piece = (pixel / self.size) as u32;
        let pixels = self.pixels(piece);
        let new = || (pixels.len(), vec![None; pixels.len()]);
        let (left, cells) = self.open.entry(piece).or_insert_with(new);
        if cells[pixel - pixels.start].replace(cell).is_none() {
            *left -= 1;
        }
        if *left > 0 {
            return Ok(());
        }
        let (_, cells) = self.open.remove(&piece).unwrap_or_default();
        let cells: Vec<Cell> = cells.into_iter().flatten().collect();
        if let Some(store) = &self.store {
            let mut bytes = Vec::new();
            cells.iter().for_each(|cell| codec::write(cell, &mut bytes));
            store.write(piece, &bytes)?;
        }
        self.waiting.insert(piece, cells);
        self.hand_on()
    }

    /// Hands on all pieces whose turn has come.
    pub(super) fn hand_on(&mut self) -> Result<(), Failure> {
        while self.next < self.pieces() {
            let cells = match self.waiting.remove(&self.next) {
                Some(cells) => cells,
                None if self.kept.contains(&self.next) => self.read(self.next)?,
                None => return Ok(()),
            };
            for (pixel, cell) in self.pixels(self.next).zip(cells) {
                self.gather.cell(pixel, cell);
            }
            self.next += 1;
        }
        Ok(())
    }

    fn read(&self, piece: u32) -> Result<Vec<Cell>, Failure> {
        let store = self.store.as_ref();
        let bytes = store.map_or(Ok(None), |store| store.read(piece))?;
        let cells = bytes.and_then(|bytes| codec::read(&bytes));
        cells
            .filter(|cells| cells.len() == self.pixels(piece).len())
            .ok_or_else(|| {
                let place = store.map_or(String::new(), |s| s.path().display().to_string());
                Failure::work(
                    format!(
                        "piece {piece} of the work folder `{place}` was changed during the run"
                    ),
                    "remove the folder and start anew",
                )
            })
    }

    pub(super) fn close(self) -> Kept {
        Kept { store: self.store }
    }
}

impl Kept {
    /// The work folder, if there is one.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.store.as_ref().map(PieceStore::path)
    }

    /// Removes the pieces: the results are there.
    pub(crate) fn remove(&mut self) -> Result<(), Failure> {
        Ok(self.store.take().map_or(Ok(()), PieceStore::remove)?)
    }

    /// What to say after an interruption.
    pub(super) fn suspended(self) -> Failure {
        match self.store {
            Some(store) => Failure::Suspended {
                folder: store.path().to_path_buf(),
            },
            None => Failure::Interrupted,
        }
    }
}

/// The store beside the results. One that is left over is only used if that was asked for.
fn store(keep: &Keep, fingerprint: &[(String, String)]) -> Result<PieceStore, Failure> {
    let dir = pieces_beside(&keep.out);
    if dir.join(MANIFEST).exists() && !keep.resume {
        return Err(Failure::work(
            format!(
                "the work folder `{}` of an interrupted run is still there",
                dir.display()
            ),
            "add --resume to go on with it, or remove it to start anew",
        ));
    }
    let fingerprint: Vec<(&str, &str)> = fingerprint
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_str()))
        .collect();
    Ok(PieceStore::open(&dir, &fingerprint)?)
}

/// Everything that the pixels depend on, key by key, so that a difference can be named.
fn fingerprint(command: &str, study: &Study, plane: &Plane, size: usize) -> Vec<(String, String)> {
    let mut names = vec![
        ("command".to_owned(), command.to_owned()),
        ("saltus".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
        ("pixels".to_owned(), plane.grid.len().to_string()),
        ("pixels in a piece".to_owned(), size.to_string()),
    ];
    let tree = serde_json::to_value(study).unwrap_or_default();
    let other = |table: &str| ["sweep", "simulate", "map", "basins"].contains(&table);
    for (table, value) in tree.as_object().into_iter().flatten() {
        if table == command || !other(table) {
            flatten(table, value, &mut names);
        }
    }
    names
}

fn flatten(name: &str, value: &Value, out: &mut Vec<(String, String)>) {
    match value {
        Value::Object(table) => table
            .iter()
            .for_each(|(key, value)| flatten(&format!("{name}.{key}"), value, out)),
        Value::Array(items) if items.iter().any(Value::is_object) => items
            .iter()
            .enumerate()
            .for_each(|(i, value)| flatten(&format!("{name}.{i}"), value, out)),
        other => out.push((name.to_owned(), other.to_string())),
    }
}
