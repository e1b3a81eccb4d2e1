//! Results of saltus: figures, tables and result folders, written whole or not at all.
//!
//! The crate receives plain data (slices of `f64` and labels) and knows no physics. Its parts:
//!
//! - [`ordinary`]: reading what others may have put there; [`shown`]: showing names of theirs;
//! - [`staging`]: places for what is not finished, known as left over if nobody lives who made them;
//! - [`figure`]: a small declarative figure model, rendered to SVG text and PNG bytes;
//! - [`folder`]: result folders and single files that appear whole or not at all;
//! - [`manifest`]: what a result folder says of itself, and whether its files are still those;
//! - [`mod@compare`]: two result folders side by side, with the largest differences;
//! - [`dataset`]: arrays over named axes as one NetCDF-4 file, for xarray and its like;
//! - [`pieces`]: finished pieces of long work, kept so that it can be taken up again;
//! - [`table`]: CSV that reads back to the same bits, and Markdown tables;
//! - [`columns`]: the same rows as typed columns in memory;
//! - `parquet`: the same as Parquet files, behind the feature of that name;
//! - [`page`]: a self-contained HTML page that shows figures, tables and facts without a network.

pub mod columns;
pub mod compare;
pub mod dataset;
mod error;
pub mod figure;
pub mod folder;
pub mod manifest;
pub mod ordinary;
pub mod page;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod pieces;
pub mod shown;
pub mod staging;
pub mod table;

pub use columns::{Column, Columns};
pub use compare::{Comparison, compare};
pub use dataset::{Attribute, Dataset, Values, Variable};
pub use error::ResultsError;
pub use figure::{
    Axis, Bifurcation, BifurcationSet, Branches, Class, ClassMap, Cloud, Colour, ColourScale,
    Curves, Figure, Grid, History, Panel, Portrait, Shares, ValueMap,
};
pub use folder::{ResultFolder, write_file_atomically};
pub use manifest::{FileRecord, Manifest, Problem};
pub use page::{Fact, FigureBlock, Image, Page, Verdict};
#[cfg(feature = "parquet")]
pub use parquet::ParquetTable;
pub use pieces::{Damage, PieceStore, Seal, Survey};
pub use staging::Staging;
pub use table::{CsvTable, MarkdownTable, Value};
