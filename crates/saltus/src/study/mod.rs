//! Questions asked of models.

mod ensemble;
mod recurrence;
mod sweep;
mod trajectory;

pub use ensemble::{Control, StudyError};
pub use recurrence::recurrence;
pub use sweep::{Pass, Sweep, SweepRow, sweep};
pub use trajectory::{History, Trajectory, TrajectorySwitch, simulate};
