//! Questions of a study.

use crate::answer::{Answer, Told};
use crate::context::RunContext;
use crate::continuation::Labelled;
use crate::estimate::Part;
use crate::failure::CommandError;
use crate::pieces::{Divided, ShardReport};
use crate::quantities as q;
use crate::saved::{SHORTFALL, SUMMARY};
use crate::shard::Shard;
use crate::store::Store;
use crate::{
    attractors, basins, continuation, frequencies, lyapunov, map, orbit, reproduce, simulate, sweep,
};
use saltus_config::Study;
use saltus_results::Quantity;
use serde::{Deserialize, Serialize, Serializer};
use std::path::PathBuf;

/// A question. What it is about stands in the study, but for what is said here.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "command", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Request {
    /// Natural frequencies.
    Frequencies,
    /// One motion.
    Simulate,
    /// Long-term motion while a parameter changes.
    Sweep,
    /// Long-term motion over two parameters.
    Map,
    /// Which long-term motion each initial condition leads to.
    Basins {
        /// Number the attractors as along the sweep of `[attractors]`.
        #[serde(rename = "match", default)]
        matched: bool,
    },
    /// A periodic orbit.
    Orbit,
    /// Branches of periodic orbits.
    Continue {
        /// Begin at a labelled orbit of an earlier result.
        #[serde(default)]
        origin: Option<Labelled>,
        /// Folder of a map to draw the curves over.
        #[serde(
            default,
            skip_serializing_if = "Option::is_none",
            serialize_with = "readable"
        )]
        over: Option<PathBuf>,
    },
    /// Lyapunov exponents.
    Lyapunov,
    /// All coexisting long-term motions.
    Attractors,
    /// Every figure and statement of Dias & Del Prado; the study is theirs.
    Reproduce {
        /// Fewer parameter values and periods.
        #[serde(default)]
        quick: bool,
    },
}

/// A path whose name is no text is written as far as it is one: a manifest must not fail for it.
fn readable<S: Serializer>(path: &Option<PathBuf>, to: S) -> Result<S::Ok, S::Error> {
    let text = path.as_ref().map(|path| path.display().to_string());
    text.serialize(to)
}

impl Request {
    /// Name of the command; the JSON document has it too.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Frequencies => "frequencies",
            Self::Simulate => "simulate",
            Self::Sweep => "sweep",
            Self::Map => "map",
            Self::Basins { .. } => "basins",
            Self::Orbit => "orbit",
            Self::Continue { .. } => "continue",
            Self::Lyapunov => "lyapunov",
            Self::Attractors => "attractors",
            Self::Reproduce { .. } => "reproduce",
        }
    }

    /// Name of the file with the JSON document.
    pub fn document(&self) -> String {
        match self {
            Self::Reproduce { .. } => "facts.json".to_owned(),
            other => format!("{}.json", other.name()),
        }
    }

    /// Name of the file with the arrays.
    pub fn dataset(&self) -> String {
        match self {
            Self::Reproduce { .. } => "fig2.nc".to_owned(),
            other => format!("{}.nc", other.name()),
        }
    }

    /// Quantities of its answers, in the order of the help. Parameters that change are variables beside these, named after
    /// their keys.
    pub fn quantities(&self) -> Vec<Quantity> {
        const STATUS: &[Quantity] = &[q::STATUS, q::STATUS_TEXT];
        const PERSON: &[Quantity] = &[q::JUMPER, q::ETA, q::Z, q::V, q::CONTACT_RATIO];
        const LOADS: &[Quantity] = &[q::CONTACT_RATIO, q::PEAK_REACTION];
        const PEAKS: &[Quantity] = &[q::PEAK_REACTION, q::PEAK_ACCELERATION];
        const NAMED: &[Quantity] = &[q::PERIOD, q::CONFIDENCE];
        let lists: &[&[Quantity]] = match self {
            Self::Frequencies => &[q::FREQUENCIES, &[q::JUMPER]],
            Self::Simulate => &[
                STATUS,
                &[q::PERIODS_RUN, q::PEAK_REACTION],
                q::RUN,
                q::BASE_MOTION,
                q::SECTION,
                q::HISTORY,
            ],
            Self::Sweep => &[q::SWEEP, NAMED, STATUS, PERSON, q::EXPONENTS],
            Self::Map => &[
                q::PLANE,
                PEAKS,
                &[
                    q::CONTACT_RATIO,
                    q::PERIODS_RUN,
                    q::EXPONENT_ERROR,
                    q::JUMPER,
                ],
            ],
            Self::Basins { .. } => return [q::BASINS, &[q::ETA], &Self::Map.quantities()].concat(),
            Self::Orbit => &[
                &[q::PERIOD],
                q::ORBITS,
                q::ORBIT,
                LOADS,
                q::BASE_MOTION,
                q::SECTION,
                q::HISTORY,
            ],
            Self::Continue { .. } => &[q::BRANCHES, &[q::PERIOD], q::ORBITS, q::SECTION],
            Self::Lyapunov => &[
                STATUS,
                NAMED,
                &[q::STATES],
                q::EXPONENTS,
                q::SPECTRUM,
                q::BASE_MOTION,
            ],
            Self::Attractors => &[
                q::ATTRACTORS,
                &[q::PERIOD, q::PERIODS_RUN, q::EXPONENT_ERROR],
                PERSON,
                PEAKS,
            ],
            Self::Reproduce { .. } => {
                &[q::PAPER, q::SWEEP, q::EXPONENTS, &[q::Z, q::BASE_FREQUENCY]]
            }
        };
        lists.concat()
    }

    /// The study that this question is about, given the one at hand: a branch that begins at an orbit of
    /// an earlier result begins at its value of the parameter, and the paper's figures are of its study.
    ///
    /// # Errors
    /// [`CommandError`] if the earlier result cannot be read or does not fit the study.
    pub fn study(&self, study: &Study) -> Result<Study, CommandError> {
        match self {
            Self::Continue {
                origin: Some(origin),
                ..
            } => continuation::adopted(origin, study),
            Self::Reproduce { .. } => Ok(reproduce::study()),
            _ => Ok(study.clone()),
        }
    }

    /// Computes the answer. `study` is what [`Self::study`] gives.
    ///
    /// # Errors
    /// [`CommandError`] if the study does not fit the question, the computation does not get through, or it was
    /// stopped.
    pub fn ask(
        &self,
        study: &Study,
        context: &RunContext,
    ) -> Result<Box<dyn Answer>, CommandError> {
        match self {
            Self::Frequencies => frequencies::ask(study, context),
            Self::Simulate => simulate::ask(study, context),
            Self::Sweep => sweep::ask(study, context),
            Self::Map => map::ask(study, context),
            Self::Basins { matched } => basins::ask(study, *matched, context),
            Self::Orbit => orbit::ask(study, context),
            Self::Continue { origin, over } => {
                continuation::ask(study, origin.as_ref(), over.as_deref(), context)
            }
            Self::Lyapunov => lyapunov::ask(study, context),
            Self::Attractors => attractors::ask(study, context),
            Self::Reproduce { quick } => reproduce::ask(*quick, context),
        }
    }
}

/// The time that it takes; see [`Request::estimate`].
impl Request {
    /// The parts of its work, for a probe; nothing where there is none worth counting.
    pub(crate) fn parts(&self, study: &Study, threads: usize) -> Result<Vec<Part>, CommandError> {
        match self {
            Self::Frequencies | Self::Orbit => Ok(Vec::new()),
            Self::Simulate => simulate::parts(study),
            Self::Sweep => sweep::parts(study, threads),
            Self::Map => map::parts(study, threads),
            Self::Basins { matched } => basins::parts(study, *matched, threads),
            Self::Continue { .. } => continuation::parts(study, threads),
            Self::Lyapunov => lyapunov::parts(study),
            Self::Attractors => attractors::parts(study, threads),
            Self::Reproduce { quick } => reproduce::parts(*quick, threads),
        }
    }
}

/// Work that is shared out: `map`, `basins`, and `sweep` where each value is taken anew. Its pieces come together in
/// [`Request::ask`] with a [`Pieces`](crate::Pieces) that says where they are. `study` is what [`Request::study`] gives.
impl Request {
    /// How many pieces there are. It depends on the study alone.
    ///
    /// # Errors
    /// [`CommandError`] if the study does not fit the question, or it cannot be cut.
    pub fn pieces(&self, study: &Study) -> Result<u32, CommandError> {
        Ok(self.divided(study)?.pieces())
    }

    /// Makes those pieces of a shard that are missing in the folder of pieces, beside others that do the same.
    /// No results are written; `context` must say where they will be.
    ///
    /// # Errors
    /// As [`Self::ask`], [`Self::pieces`]; [`CommandError::Results`] if the folder is of other work, or somebody is putting
    /// its pieces together.
    pub fn share(
        &self,
        study: &Study,
        shard: Shard,
        context: &RunContext,
    ) -> Result<ShardReport, CommandError> {
        self.divided(study)?.share(shard, context)
    }

    /// Makes these pieces, counted from 0, as bytes that say of themselves whether they are whole and of which
    /// work: those of their files. They come in the order of their numbers, each once.
    ///
    /// # Errors
    /// As [`Self::ask`], [`Self::pieces`]; [`CommandError::Refused`] if there is no such piece.
    pub fn compute(
        &self,
        study: &Study,
        pieces: &[u32],
        context: &RunContext,
    ) -> Result<Vec<(u32, Vec<u8>)>, CommandError> {
        self.divided(study)?.compute(pieces, context)
    }

    fn divided<'a>(&self, study: &'a Study) -> Result<Box<dyn Divided + 'a>, CommandError> {
        match self {
            Self::Map => map::divided(study),
            Self::Basins { .. } => basins::divided(study),
            Self::Sweep => sweep::divided(study),
            other => Err(CommandError::refused(
                format!("the work of `{}` cannot be cut into pieces", other.name()),
                "that of map, basins and sweep can",
            )),
        }
    }
}

impl dyn Answer + '_ {
    /// Hands everything to `store`, the document of `request` first.
    ///
    /// # Errors
    /// [`CommandError`] where the store refuses or a figure cannot be drawn.
    pub fn store(&self, request: &Request, store: &mut dyn Store) -> Result<(), CommandError> {
        store.put_words(SUMMARY, &Told::summary(self));
        if let Some(shortfall) = self.shortfall() {
            store.put_words(SHORTFALL, &shortfall.to_string());
        }
        store.put_text(&request.document(), &mut |file| Told::document(self, file))?;
        self.fill(store, &request.dataset())
    }
}
