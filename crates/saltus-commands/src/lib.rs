//! The questions that a study file can ask, answered: a document, a summary in words, tables, figures and
//! datasets. What the program writes to a folder and another front end keeps in memory is made here, once.
//!
//! No terminal and no arguments: [`Request`] is what is asked, [`RunContext`] who asks, [`Answer`] what was
//! found, [`Store`] where its parts go.

mod about;
mod answer;
mod attractors;
mod basins;
mod citations;
mod colours;
mod context;
mod continuation;
mod data;
mod describe;
mod destination;
mod estimate;
mod failure;
mod frequencies;
mod kinds;
mod lyapunov;
mod map;
mod models;
mod orbit;
mod per_jumper;
mod pieces;
mod plane;
mod portrait;
mod quantities;
mod repeats;
mod reproduce;
mod request;
mod saved;
mod shard;
mod simulate;
mod status;
mod store;
mod sweep;
mod words;

pub use about::about;
pub use answer::{Answer, Take, Told};
pub use citations::{Citation, bibtex, citations};
pub use colours::of as attractor_colours;
pub use context::{Existing, Pieces, PiecesAt, Progress, RunContext, Stage, Unwatched};
pub use continuation::Labelled;
pub use describe::{describe, warnings};
pub use destination::Destination;
pub use estimate::Estimate;
pub use failure::CommandError;
pub use pieces::ShardReport;
pub use request::Request;
pub use saved::{KeptResult, Rerun, SavedResult};
pub use shard::{DefectivePiece, Shard, ShardError};
pub use store::{Fill, Folder, Store};
