//! Questions asked of models.

mod ensemble;
mod sweep;
mod trajectory;

pub use ensemble::{Control, StudyError};
pub use sweep::{Pass, Sweep, SweepRow, sweep};
pub use trajectory::{History, Trajectory, TrajectorySwitch, simulate};
