//! Bifurcation sets: curves of bifurcations in a plane of two parameters, alone or over a map.

use super::axis::Axis;
use super::bifurcation::Bifurcation;
use super::colour::Colour;
use super::panel::{Layer, Note, Panel, Place, Swatch};

/// Curves of bifurcations in a plane of two parameters, in one colour for each kind.
///
/// Each curve has a white rim, so that it shows over the cells of any map.
#[derive(Clone, Debug)]
pub struct BifurcationSet {
    panel: Panel,
    curves: Vec<Curve>,
}

#[derive(Clone, Debug)]
struct Curve {
    kind: Bifurcation,
    label: String,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl BifurcationSet {
    /// An empty plane.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            panel: Panel::new(title.into(), x, y, (0.0, 0.0)),
            curves: Vec::new(),
        }
    }

    /// A plane over a map, such as a [`ClassMap`](super::ClassMap), with its title, axes and legend. The
    /// axes stay those of the map; curves end at its edge.
    pub fn over(map: impl Into<Panel>) -> Self {
        let mut panel = map.into();
        let (across, up) = panel.extents();
        panel.x.range = panel.x.range.or(across.limits());
        panel.y.range = panel.y.range.or(up.limits());
        Self {
            panel,
            curves: Vec::new(),
        }
    }

    /// Adds a curve, broken where a point is not finite. The label, such as "PD1", stands beside it; it
    /// may be empty.
    #[must_use]
    pub fn curve(
        mut self,
        kind: Bifurcation,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.curves.push(Curve {
            kind,
            label: label.into(),
            x: x.into(),
            y: y.into(),
        });
        self
    }
}

impl From<BifurcationSet> for Panel {
    fn from(set: BifurcationSet) -> Self {
        let mut panel = set.panel;
        for kind in Bifurcation::ALL {
            if set.curves.iter().any(|curve| curve.kind == kind) {
                let swatch = Swatch::Line {
                    width: 2.4,
                    colour: kind.colour(),
                    dotted: false,
                };
                panel.key(kind.label().to_owned(), swatch);
            }
        }
        // All rims lie below all curves, so that none is cut where two cross.
        let rims = set
            .curves
            .iter()
            .map(|curve| line(curve, 4.8, Colour(255, 255, 255)));
        let lines = set
            .curves
            .iter()
            .map(|curve| line(curve, 2.2, curve.kind.colour()));
        panel.layers.extend(rims.chain(lines));
        panel.layers.push(Layer::Frame);
        let labelled = set.curves.iter().filter(|curve| !curve.label.is_empty());
        let notes = labelled.map(|curve| Note {
            text: curve.label.clone(),
            place: Place::Along(curve.x.clone(), curve.y.clone()),
        });
        panel.layers.push(Layer::Notes(notes.collect()));
        panel
    }
}

fn line(curve: &Curve, width: f64, colour: Colour) -> Layer {
    Layer::Line {
        x: curve.x.clone(),
        y: curve.y.clone(),
        width,
        colour,
        dashed: false,
    }
}
