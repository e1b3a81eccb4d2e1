//! Branches in the paper's units.

use saltus::model::{Model, ModelError, Section};
use saltus::orbits::{BranchWithOrigin, Multiplier, Orbit};
use saltus::study::{point, sequence};

/// An orbit as people see it.
pub(super) struct Seen {
    /// Its points at cos(Omega t) = 1.
    pub(super) section: Vec<Section>,
    /// The order of its switches.
    pub(super) sequence: String,
    /// The largest multiplier.
    pub(super) multiplier: Multiplier,
}

/// The points and special points of a branch, in their order.
pub(super) struct View {
    pub(super) points: Vec<Seen>,
    pub(super) specials: Vec<Seen>,
}

impl Seen {
    fn new(
        orbit: &Orbit,
        model_at: impl Fn(&[f64]) -> Result<Model, ModelError>,
    ) -> Result<Self, ModelError> {
        let model = model_at(&orbit.parameters)?;
        let section = orbit.places.iter().map(|place| {
            let point = point(&model, place);
            model.section(&point.modes, &point.x)
        });
        let nothing = Multiplier {
            re: 0.0,
            im: 0.0,
            error: 0.0,
        };
        Ok(Self {
            section: section.collect(),
            sequence: sequence(&model, orbit),
            multiplier: orbit.multipliers.first().copied().unwrap_or(nothing),
        })
    }
}

impl View {
    pub(super) fn new(
        limb: &BranchWithOrigin,
        model_at: impl Fn(&[f64]) -> Result<Model, ModelError>,
    ) -> Result<Self, ModelError> {
        let branch = &limb.branch;
        let points = branch.points.iter().map(|p| Seen::new(&p.orbit, &model_at));
        let specials = branch.specials.iter();
        let specials = specials.map(|s| Seen::new(&s.orbit, &model_at));
        Ok(Self {
            points: points.collect::<Result<_, _>>()?,
            specials: specials.collect::<Result<_, _>>()?,
        })
    }
}
