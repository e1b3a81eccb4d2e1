//! Questions asked of people on a plate: those of [`saltus_study`], which knows neither, and what people and floor see.

mod people;
mod portrait;
mod starts;
mod trajectory;

pub use people::{
    AttractorCensus, Bodies, ContinuedAttractors, Effects, Found, Lost, OrbitError, Pass, Row,
    StudyError, Sweep, SweepRow,
};
pub use portrait::{Portrait, portrait, sequence};
pub use saltus_study::{
    Arrival, Attractor, AttractorCatalogue, AttractorRange, BasinFraction, Control,
    CountedAttractor, Entry, Grid, Hysteresis, Label, LyapunovRun, Measurement, ORBIT_METHOD,
    OrbitSearch, Range, RangeEnd, Search, Settled, Subject, Survival, Transient, attractors,
    census, exponents, follow, labels, linspace, lyapunov, lyapunov_of_states, map, orbit,
    orbit_of, place, point, recurrence, second_opinion, settle, stroboscopic, sweep, sweep_many,
};
pub use starts::Starts;
pub use trajectory::{History, Instants, Trajectory, TrajectorySwitch, simulate, simulate_at};
