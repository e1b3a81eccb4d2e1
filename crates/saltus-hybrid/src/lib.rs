//! Engine for forced piecewise-smooth flows.
//!
//! Describe a system once with [`SystemBuilder`]; integrate it with exactly located switches by
//! [`integrate`], one trajectory or many. Nothing here knows a plate, a person or a unit of measure.

mod adiabatic;
mod arith;
mod cauchy;
mod compile;
mod event;
mod flatten;
mod jets;
mod kernel;
mod lane;
mod parallel;
mod polynomial;
mod record;
mod rk4;
mod run;
mod saltation;
mod series;
mod sizes;
mod special;
mod system;
mod tangent;
mod taylor;
pub mod testing;

pub use parallel::{integrate_all, integrate_groups, integrate_stream};
pub use record::{RecordedSwitch, Recording, record};
pub use run::{
    End, Instructions, IntegrateError, Leg, Method, Minimum, Options, Sample, Status, Step, Switch,
    SwitchKind, Task, integrate,
};
pub use system::{
    BuildError, Evaluator, Mode, Node, Point, System, SystemBuilder, Transition, Unit,
};
