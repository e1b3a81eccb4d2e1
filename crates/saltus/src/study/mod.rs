//! Questions asked of models.

mod approach;
mod attractor;
mod basins;
mod census;
mod classify;
mod confirm;
mod coordinates;
mod cross_check;
mod ensemble;
mod exponents;
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
mod starts;
mod survival;
mod sweep;
mod trajectory;

pub use attractor::{Arrival, Attractor, Found, Lost, Range};
pub use basins::{AttractorCatalogue, Entry};
pub use census::{AttractorCensus, CountedAttractor, Row, Transient};
pub use cross_check::second_opinion;
pub use ensemble::{Control, StudyError};
pub use exponents::{LyapunovRun, Measurement, lyapunov, lyapunov_of_states};
pub use follow::{census, follow};
pub use fraction::BasinFraction;
pub use lineages::{AttractorRange, ContinuedAttractors, Hysteresis, RangeEnd};
pub use map::{Grid, map};
pub use orbits::{
    ORBIT_METHOD, OrbitError, OrbitSearch, Portrait, orbit, orbit_of, place, point, portrait,
    sequence, stroboscopic,
};
pub use pursuit::attractors;
pub use recurrence::recurrence;
pub use rows::{Label, exponents, labels};
pub use search::Search;
pub use settle::{Settled, settle};
pub use starts::Starts;
pub use survival::Survival;
pub use sweep::{Pass, Sweep, SweepRow, sweep, sweep_many};
pub use trajectory::{History, Instants, Trajectory, TrajectorySwitch, simulate, simulate_at};
