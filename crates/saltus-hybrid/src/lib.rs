//! Engine for forced piecewise-smooth flows.
//!
//! Describe a system once with [`SystemBuilder`]; integrate it with exactly located switches by
//! [`integrate`], one trajectory or many. Nothing here knows a plate, a person or a unit of measure.

mod adiabatic;
mod arith;
mod builder;
mod cauchy;
mod compile;
mod evaluator;
mod event;
mod flatten;
mod function;
mod idle;
mod jets;
mod kernel;
mod lane;
mod parallel;
mod polynomial;
mod program;
mod record;
mod recurrence;
mod rk4;
mod rows;
mod run;
mod saltation;
mod series;
mod sizes;
mod special;
mod structure;
mod system;
mod tangent;
mod task;
mod taylor;
pub mod testing;

pub use builder::SystemBuilder;
pub use evaluator::Evaluator;
pub use parallel::{integrate_all, integrate_groups, integrate_stream, on_threads};
pub use program::{BuildError, Mode, Node, Transition, Unit};
pub use record::{RecordedSwitch, Recording, record};
pub use run::integrate;
pub use system::{Point, System};
pub use task::{
    End, Instructions, IntegrateError, Method, Minimum, Options, Sample, Segment, Status, Step,
    Switch, SwitchKind, Task,
};
