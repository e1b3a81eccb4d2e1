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
//! - [`quantity`]: name, meaning and unit of a number, said once;
//! - [`table`]: what of a dataset stands row by row, written by [`mod@csv`] and, as documents, by [`json`];
//! - [`markdown`]: tables for people;
//! - [`page`]: a self-contained HTML page that shows figures, tables and facts without a network.

pub mod compare;
pub mod csv;
pub mod dataset;
mod error;
pub mod figure;
pub mod folder;
pub mod json;
pub mod manifest;
pub mod markdown;
pub mod ordinary;
pub mod page;
pub mod pieces;
pub mod quantity;
pub mod shown;
pub mod staging;
pub mod table;

pub use compare::{Comparison, compare};
pub use csv::csv;
pub use dataset::{Attribute, Dataset, Values, Variable};
pub use error::ResultsError;
pub use figure::{
    Axis, Bifurcation, BifurcationSet, Branches, Class, ClassMap, Cloud, Colour, ColourScale,
    Curves, Figure, FigureStyle, Grid, History, Panel, Portrait, Shares, ValueMap,
};
pub use folder::{ResultFolder, write_file_atomically};
pub use json::Document;
pub use manifest::{FileRecord, Manifest, Problem};
pub use markdown::MarkdownTable;
pub use page::{Fact, FigureBlock, Image, Page, Verdict};
pub use pieces::{Damage, PieceStore, Seal, Survey};
pub use quantity::Quantity;
pub use staging::Staging;
pub use table::{Cells, NamedColumn, Table};
