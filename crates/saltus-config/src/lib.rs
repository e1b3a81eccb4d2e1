//! The saltus study file: TOML with units, schema, overrides and errors that point at the line.
//!
//! A [`Study`] is the file, key by key, in SI units. [`load()`] reads and checks it, with overrides as
//! on the command line, and [`Study::from_json`] does so for other languages. [`Study::plate`] and its sisters
//! give it as [`saltus::physics`] records.
//! The [`schema()`] made from the records is the one description of the keys: structure, ranges,
//! suggestions, overrides and axis labels are all read from it.
//!
//! ```
//! let study = saltus_config::parse(
//!     "paper.toml",
//!     &saltus_config::paper_template(),
//!     &["jumper.damping_ratio=0.28".to_owned()],
//! )?;
//! assert_eq!(study.jumper[0].damping_ratio, 0.28);
//! # Ok::<(), saltus_config::StudyError>(())
//! ```

mod axis;
mod error;
mod fault;
mod format;
mod json;
mod key;
mod load;
mod overrides;
mod parameter;
mod physics;
mod questions;
mod range;
mod schema;
mod shown;
mod source;
mod structure;
mod study;
mod template;
mod validate;
mod values;

pub use error::{StudyError, StudyErrorKind};
pub use load::{load, parse, read};
pub use parameter::Parameter;
pub use schema::{keys, schema};
pub use study::{
    AttractorsTable, AxisTable, BaseTable, BasinsTable, Basis, ContactTable, ContinueTable,
    Direction, GravityTable, Inertia, JumperTable, Law, LyapunovTable, MapTable, Method, ModeLists,
    Modes, OrbitTable, PlateTable, Reference, SecondTable, SimulateTable, SolverTable, StartTable,
    Study, SweepTable,
};
pub use template::paper_template;
