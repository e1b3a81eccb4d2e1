//! The study file as records, one table each. The doc comments are the descriptions of the schema.

mod attractors;
mod axis;
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
pub use axis::AxisTable;
pub use base::{BaseTable, GravityTable, Reference};
pub use continuation::{ContinueTable, SecondTable};
pub use jumper::{ContactTable, JumperTable, Law, StartTable};
pub use map::{BasinsTable, MapTable};
pub use modes::{ModeLists, Modes};
pub use orbit::{LyapunovTable, OrbitTable};
pub use plate::{Basis, Inertia, PlateTable};
pub use run::{Method, SimulateTable, SolverTable};
pub use sweep::{Direction, SweepTable};

use garde::Validate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// A saltus study: a plate, the people on it, the base motion under it, and what to compute. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Validate)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// Format of the file (-, a whole number), such as 1: it grows when a key gets another name or meaning, and a
    /// saltus that is too old for a file says so.
    #[serde(default = "current_format")]
    #[garde(range(min = 1, max = Study::FORMAT))]
    #[schemars(range(min = 1, max = 1))]
    pub format: u32,
    /// A simply supported rectangular plate, its edges held in their plane.
    #[garde(dive)]
    pub plate: PlateTable,
    /// The people: none, one or many, up to 400, each written as its own `[[jumper]]`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[garde(length(max = JumperTable::MOST), dive)]
    #[schemars(length(max = JumperTable::MOST))]
    pub jumper: Vec<JumperTable>,
    /// When feet leave the floor and come back.
    #[serde(default)]
    #[garde(dive)]
    pub contact: ContactTable,
    /// The motion of the plate's edges, A_b cos(Ω t). Give frequency_ratio or frequency, not both.
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
    /// The initial condition of every jumper; the plate starts at rest.
    #[serde(default)]
    #[garde(dive)]
    pub start: StartTable,
    /// What `saltus simulate` runs: the motion from the initial condition on.
    #[serde(default)]
    #[garde(dive)]
    pub simulate: SimulateTable,
    /// What `saltus sweep` runs: the long-term motion at each value of a parameter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "SweepTable")]
    #[garde(dive)]
    pub sweep: Option<SweepTable>,
    /// What `saltus map` runs: the long-term motion over a plane of two parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "MapTable")]
    #[garde(dive)]
    pub map: Option<MapTable>,
    /// What `saltus basins` runs: where the initial conditions of a plane of them lead.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BasinsTable")]
    #[garde(dive)]
    pub basins: Option<BasinsTable>,
    /// What `saltus orbit` seeks: a periodic orbit, stable or not.
    #[serde(default)]
    #[garde(dive)]
    pub orbit: OrbitTable,
    /// What `saltus lyapunov` runs: how fast neighbours of the long-term motion part.
    #[serde(default)]
    #[garde(dive)]
    pub lyapunov: LyapunovTable,
    /// What `saltus continue` runs: branches of periodic orbits over a parameter.
    #[serde(rename = "continue", default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "ContinueTable")]
    #[garde(dive)]
    pub continuation: Option<ContinueTable>,
    /// What `saltus attractors` runs: every motion that many initial conditions lead to. At the study's own
    /// parameters or at each value of one: give parameter with from, to and count, or with values, or none of them.
    #[serde(default)]
    #[garde(dive)]
    pub attractors: AttractorsTable,
}

fn current_format() -> u32 {
    Study::FORMAT
}

impl Study {
    /// The format that this version writes, and the newest it reads.
    pub const FORMAT: u32 = 1;

    /// The case of DP section 3 with ζ_h = 0.3 and Ω equal to the body's frequency on the flexible
    /// plate, the sweep of DP Fig. 2b, its branches of orbits, a map, basins and attractors. In-plane motion is on
    /// its slow manifold, which is 25 times as fast as the paper's full inertia and within 2e-9 h of it.
    /// [`paper_template`](crate::paper_template) explains it.
    pub fn paper() -> Self {
        Self {
            format: Self::FORMAT,
            plate: PlateTable::paper(),
            jumper: vec![JumperTable::paper()],
            contact: ContactTable::default(),
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

    /// The resolved study as JSON, every default written out. [`Study::from_json`] of it gives the same bits.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self)
            .expect("tables, lists, words and numbers can always be written as JSON")
    }

    /// Identity of the study in results: SHA-256 of [`Study::to_toml`], in hexadecimal.
    ///
    /// Equal studies have equal hashes however they were written. A version of saltus that knows more keys may
    /// write more of them, and then has other hashes.
    pub fn hash(&self) -> String {
        let digest = Sha256::digest(self.to_toml());
        digest.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
