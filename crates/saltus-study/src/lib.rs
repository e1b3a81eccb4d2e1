//! Long-term motion of forced piecewise-smooth systems.
//!
//! A [`Subject`] is a system of the engine with what is seen of it. Whatever it is, it can be asked for its motions
//! after transients ([`settle`], [`sweep`]), for the attractor behind each initial condition or parameter ([`map`],
//! [`attractors`]), for all attractors along a parameter ([`follow`]), for Lyapunov exponents ([`lyapunov`]) and for
//! periodic orbits ([`orbit`]), of which `saltus-orbits` follows branches.

mod approach;
mod attractor;
mod basins;
mod census;
mod classify;
mod confirm;
mod cross_check;
mod ensemble;
mod exponents;
mod flow;
mod follow;
mod fraction;
mod lineages;
mod map;
mod matching;
mod orbits;
mod peaks;
mod pursuit;
mod recording;
mod recurrence;
mod rows;
mod search;
mod settle;
mod spread;
mod subject;
mod survival;
mod sweep;

pub use attractor::{Arrival, Attractor, Found, Lost, Range};
pub use basins::{AttractorCatalogue, Entry};
pub use census::{AttractorCensus, CountedAttractor, Row, Transient};
pub use cross_check::second_opinion;
pub use ensemble::{Control, Outcome, StudyError};
pub use exponents::{LyapunovRun, Measurement, lyapunov, lyapunov_of_states};
pub use flow::{Flow, Nothing, Region};
pub use follow::{census, follow};
pub use fraction::BasinFraction;
pub use lineages::{AttractorRange, ContinuedAttractors, Hysteresis, RangeEnd};
pub use map::{Grid, map};
pub use orbits::{
    ORBIT_METHOD, OrbitError, OrbitSearch, orbit, orbit_of, place, point, stroboscopic,
};
pub use peaks::Peaks;
pub use pursuit::attractors;
pub use recurrence::recurrence;
pub use rows::{Label, exponents, labels};
pub use search::Search;
pub use settle::{Settled, settle};
pub use spread::spread;
pub use subject::{Probe, Starts, Subject};
pub use survival::Survival;
pub use sweep::{Pass, Sweep, SweepRow, linspace, sweep, sweep_many};
