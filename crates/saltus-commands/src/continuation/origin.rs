//! A labelled orbit of an earlier result, to begin with.

use crate::failure::CommandError;
use saltus::model::Model;
use saltus::orbits::MapPoint;
use saltus::study::{place, point};
use saltus_config::{Law, Parameter, Study};
use saltus_results::shown::{self, printable};
use saltus_results::{ResultsError, ordinary};
use serde::{Deserialize, Serialize, Serializer};
use std::path::{Path, PathBuf};

/// Name of the document in the folder of a result.
const DOCUMENT: &str = "continue.json";

/// Most bytes of it: a thousand branches of a thousand points.
const LARGEST: u64 = 256 << 20;

/// Advice on what else to give.
const FOLDER: &str = "--from takes a folder that `saltus continue --out` of this version wrote";

/// An orbit of an earlier result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Labelled {
    /// Folder of the result.
    #[serde(serialize_with = "readable")]
    pub from: PathBuf,
    /// Label of a special point, such as `PD1`.
    pub at: String,
}

/// A path whose name is no text is written as far as it is one: a manifest must not fail for it.
fn readable<S: Serializer>(path: &Path, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(&path.display())
}

/// The part of the document that a restart needs.
#[derive(Deserialize)]
struct Document {
    parameter: String,
    special_points: Vec<SpecialPoint>,
}

#[derive(Deserialize)]
struct SpecialPoint {
    label: String,
    kind: String,
    orbit_value: f64,
    /// Of each place of the orbit.
    modes: Vec<Vec<usize>>,
    x: Vec<Vec<f64>>,
}

impl Document {
    /// The special point `label`; `path` is where the document is.
    fn special(&self, label: &str, path: &Path) -> Result<&SpecialPoint, CommandError> {
        let known = self.special_points.as_slice();
        let chosen = known.iter().find(|special| special.label == label);
        chosen.ok_or_else(|| {
            let labels: Vec<&str> = known.iter().map(|special| special.label.as_str()).collect();
            let help = match labels.as_slice() {
                [] => "it has no special points at all".to_owned(),
                labels => format!("those found: {}", labels.join(", ")),
            };
            let message = format!(
                "--at {}: `{}` has no such point",
                printable(label),
                shown::path(path)
            );
            CommandError::refused(message, help)
        })
    }
}

impl SpecialPoint {
    /// The orbit in the units of its own model; `None` if a place is only half known.
    fn places(&self) -> Option<Vec<MapPoint>> {
        let place = |(modes, x): (&Vec<usize>, &Vec<f64>)| MapPoint {
            modes: modes.clone(),
            x: x.clone(),
        };
        let whole = self.modes.len() == self.x.len();
        whole.then(|| self.modes.iter().zip(&self.x).map(place).collect())
    }
}

/// Reads an ordinary file of at most `most` bytes.
fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, ResultsError> {
    ordinary::read(path, most).map_err(|source| ResultsError::Io {
        action: "read",
        path: path.to_path_buf(),
        source,
    })
}

/// The orbit with the model it is one of.
pub(super) struct Origin {
    study: Study,
    model: Model,
    parameter: Parameter,
    value: f64,
    places: Vec<MapPoint>,
}

impl Origin {
    /// The orbit `label` of the result in `folder`.
    pub(super) fn read(folder: &Path, label: &str) -> Result<Self, CommandError> {
        let path = folder.join(DOCUMENT);
        let text = bytes(&path, LARGEST)?;
        let damaged = |why: &dyn std::fmt::Display| {
            CommandError::work(
                format!("`{}` is damaged: {why}", shown::path(&path)),
                FOLDER,
            )
        };
        let document: Document = serde_json::from_slice(&text).map_err(|e| damaged(&e))?;
        let file = folder.join("study.toml");
        let study = bytes(&file, ordinary::TEXT)?;
        let study = saltus_config::read(&file.display().to_string(), &study[..], &[])?;
        let chosen = document.special(label, &path)?;
        let parameter = Parameter::parse(&document.parameter)?;
        let study = parameter.apply(&study, chosen.orbit_value)?;
        let model = study.setup().model()?;
        let fits = |place: &MapPoint| {
            let modes = if study.contact.law == Law::Gap { 3 } else { 2 };
            place.x.len() == model.free_states()
                && place.modes.len() == study.jumper.len()
                && place.modes.iter().all(|&mode| mode < modes)
        };
        let places = chosen.places().filter(|places| places.iter().all(fits));
        let mut places = places
            .ok_or_else(|| damaged(&format!("the state of {label} is not one of its study")))?;
        // where a branch meets that of half its period, the halves of its orbit are one
        let halves = if chosen.kind == "HP" { 2 } else { 1 };
        places.truncate(places.len() / halves);
        Ok(Self {
            study,
            model,
            parameter,
            value: chosen.orbit_value,
            places,
        })
    }

    /// `study` with the parameter of the result where the orbit is, if it has the same states.
    pub(super) fn adopt(&self, study: &Study) -> Result<Study, CommandError> {
        let (before, now) = (self.study.setup(), study.setup());
        let different = [
            ("plate.modes or plate.basis", {
                (&before.plate.modes, before.plate.basis) != (&now.plate.modes, now.plate.basis)
            }),
            ("plate.inertia", before.inertia != now.inertia),
            ("contact.law", before.contact != now.contact),
            (
                "the number of people",
                before.jumpers.len() != now.jumpers.len(),
            ),
        ];
        if let Some((what, _)) = different.iter().find(|(_, differs)| *differs) {
            return Err(CommandError::refused(
                format!("an orbit of the result is none of this study: {what} is not the same"),
                "a restart may change numbers and ranges, not what the states are",
            ));
        }
        Ok(self.parameter.apply(study, self.value)?)
    }

    /// Its places in the units of `model`.
    pub(super) fn places(&self, model: &Model) -> Vec<MapPoint> {
        let here = |there: &MapPoint| {
            let point = point(&self.model, there);
            place(model, &model.carry(&self.model, &point))
        };
        self.places.iter().map(here).collect()
    }
}
