//! The study file as records, one table each. The doc comments are the descriptions of the schema.

mod attractors;
mod base;
mod continuation;
mod jumper;
mod map;
mod modes;
mod orbit;
mod plate;
mod run;
mod sweep;

pub use attractors::AttractorsTable;
pub use base::{BaseTable, GravityTable, Reference};
pub use continuation::{ContinueTable, SecondTable};
pub use jumper::{ContactTable, JumperTable, Law, StartTable};
pub use map::{AxisTable, BasinsTable, MapTable};
pub use modes::{ModeLists, Modes};
pub use orbit::{LyapunovTable, OrbitTable};
pub use plate::{Basis, Inertia, PlateTable};
pub use run::{Method, SimulateTable, SolverTable};
pub use sweep::{Direction, SweepTable};

use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A saltus study: a plate, the people on it, the base motion under it, and what to compute. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// The plate.
    #[garde(dive)]
    pub plate: PlateTable,
    /// The people: none, one or many, each written as its own `[[jumper]]`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[garde(dive)]
    pub jumper: Vec<JumperTable>,
    /// When feet leave the floor and come back.
    #[garde(dive)]
    pub contact: ContactTable,
    /// The motion of the plate's edges, A_b cos(Ω t).
    #[garde(dive)]
    pub base: BaseTable,
    /// Gravity.
    #[serde(default)]
    #[garde(dive)]
    pub gravity: GravityTable,
    /// How the motion is integrated.
    #[serde(default)]
    #[garde(dive)]
    pub solver: SolverTable,
    /// The first state of every jumper; the plate starts at rest.
    #[serde(default)]
    #[garde(dive)]
    pub start: StartTable,
    /// What `saltus simulate` runs.
    #[serde(default)]
    #[garde(dive)]
    pub simulate: SimulateTable,
    /// What `saltus sweep` runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "SweepTable")]
    #[garde(dive)]
    pub sweep: Option<SweepTable>,
    /// What `saltus map` runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "MapTable")]
    #[garde(dive)]
    pub map: Option<MapTable>,
    /// What `saltus basins` runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BasinsTable")]
    #[garde(dive)]
    pub basins: Option<BasinsTable>,
    /// What `saltus orbit` seeks.
    #[serde(default)]
    #[garde(dive)]
    pub orbit: OrbitTable,
    /// What `saltus lyapunov` runs.
    #[serde(default)]
    #[garde(dive)]
    pub lyapunov: LyapunovTable,
    /// What `saltus continue` runs.
    #[serde(rename = "continue", default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "ContinueTable")]
    #[garde(dive)]
    pub continuation: Option<ContinueTable>,
    /// What `saltus attractors` runs.
    #[serde(default)]
    #[garde(dive)]
    pub attractors: AttractorsTable,
}

impl Study {
    /// The case of DP section 3 with ζ_h = 0.3 and Ω equal to the body's frequency on the flexible
    /// plate, the sweep of DP Fig. 2b, its branches of orbits, a map, basins and attractors.
    /// [`paper_template`](crate::paper_template) explains it.
    pub fn paper() -> Self {
        Self {
            plate: PlateTable::paper(),
            jumper: vec![JumperTable::paper()],
            contact: ContactTable {
                law: Law::ReactionForce,
            },
            base: BaseTable::paper(),
            gravity: GravityTable::default(),
            solver: SolverTable::default(),
            start: StartTable::default(),
            simulate: SimulateTable::default(),
            sweep: Some(SweepTable::paper()),
            map: Some(MapTable::paper()),
            basins: Some(BasinsTable::paper()),
            orbit: OrbitTable::default(),
            lyapunov: LyapunovTable::default(),
            continuation: Some(ContinueTable::paper()),
            attractors: AttractorsTable::paper(),
        }
    }

    /// The resolved study as TOML, every default written out. Parsing it gives the same bits.
    pub fn to_toml(&self) -> String {
        toml::to_string(self)
            .expect("tables, lists, words and numbers can always be written as TOML")
    }
}
