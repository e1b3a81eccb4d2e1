//! Questions asked of models.

mod ensemble;
mod exponent;
pub mod paper;
mod recurrence;
mod settle;
mod sweep;
mod trajectory;

pub(crate) use ensemble::in_parallel;
pub use ensemble::{Control, StudyError};
pub use exponent::{Exponent, largest_exponents};
pub use recurrence::recurrence;
pub use settle::{Settled, settle};
pub use sweep::{Pass, Sweep, SweepRow, sweep, sweep_many};
pub use trajectory::{History, Trajectory, TrajectorySwitch, simulate};
