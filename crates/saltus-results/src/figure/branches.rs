//! Branches of periodic orbits over a parameter: stable ones, which brute force finds, and unstable ones.

use super::axis::Axis;
use super::bifurcation::Bifurcation;
use super::colour::Colour;
use super::panel::{Layer, Note, Panel, Place, Swatch};
use super::parts::only;

/// Branches of periodic orbits, solid where stable and dashed where not, with their special points.
///
/// A cloud from brute force may lie behind them in light grey. Stable parts are drawn over unstable ones and
/// special points over both. Labels stand beside their points, where they hide least; a label that would touch
/// another is left out.
///
/// ```
/// use saltus_results::{Axis, Bifurcation, Branches, Figure};
/// // The fixed point 1 − 1/r of the logistic map loses its stability at r = 3.
/// let r = vec![2.8, 3.0, 3.2];
/// let x = r.iter().map(|r| 1.0 - 1.0 / r).collect();
/// let (across, up) = (Axis::new("Growth rate r (-)"), Axis::new("Population x (-)"));
/// let branches = Branches::new("Logistic map", across, up)
///     .branch("Period 1", r, &[true, true, false], [x])
///     .special(Bifurcation::PeriodDoubling, "PD1", 3.0, [2.0 / 3.0]);
/// assert!(Figure::new(branches).svg().contains("Unstable"));
/// ```
#[derive(Clone, Debug)]
pub struct Branches {
    title: String,
    x: Axis,
    y: Axis,
    cloud: Option<(String, Vec<f64>, Vec<f64>)>,
    branches: Vec<Branch>,
    specials: Vec<Special>,
}

#[derive(Clone, Debug)]
struct Branch {
    label: String,
    colour: Option<Colour>,
    /// All curves end to end, each ended by a NaN.
    x: Vec<f64>,
    y: Vec<f64>,
    /// For each step.
    stable: Vec<bool>,
}

#[derive(Clone, Debug)]
struct Special {
    kind: Bifurcation,
    label: String,
    x: f64,
    y: Vec<f64>,
}

impl Branches {
    /// An empty diagram.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            cloud: None,
            branches: Vec::new(),
            specials: Vec::new(),
        }
    }

    /// Points from brute force, in light grey behind all branches.
    #[must_use]
    pub fn cloud(
        mut self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.cloud = Some((label.into(), x.into(), y.into()));
        self
    }

    /// Adds a branch in the order in which it was followed: the parameter `x`, whether the orbit is stable
    /// there, and for each point of the cycle a curve of as many values. A value that is not finite breaks
    /// its curve; of lists of different length the shortest counts.
    ///
    /// A step is solid where both of its ends are stable. So a special point that belongs to the branch
    /// ends the stable part if it counts as stable. Branches of equal label share a colour: labels that
    /// name the period give a colour for each period.
    #[must_use]
    pub fn branch(
        mut self,
        label: impl Into<String>,
        x: impl Into<Vec<f64>>,
        stable: &[bool],
        curves: impl IntoIterator<Item = Vec<f64>>,
    ) -> Self {
        let x = x.into();
        let mut branch = Branch {
            label: label.into(),
            colour: None,
            x: Vec::new(),
            y: Vec::new(),
            stable: Vec::new(),
        };
        for curve in curves {
            let count = x.len().min(stable.len()).min(curve.len());
            branch.x.extend(&x[..count]);
            branch.y.extend(&curve[..count]);
            branch.x.push(f64::NAN);
            branch.y.push(f64::NAN);
            let steps = stable[..count].windows(2).map(|ends| ends[0] && ends[1]);
            branch.stable.extend(steps);
            // The step to the NaN and the step from it draw nothing.
            branch.stable.resize(branch.x.len(), false);
        }
        self.branches.push(branch);
        self
    }

    /// Gives the branch added last, and those of its label, a colour of their own.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        if let Some(branch) = self.branches.last_mut() {
            branch.colour = Some(colour);
        }
        self
    }

    /// Marks a special point at `x` on each of the curves, at the heights `y`. The label, such as "PD1",
    /// stands beside one of them; it may be empty.
    #[must_use]
    pub fn special(
        mut self,
        kind: Bifurcation,
        label: impl Into<String>,
        x: f64,
        y: impl Into<Vec<f64>>,
    ) -> Self {
        self.specials.push(Special {
            kind,
            label: label.into(),
            x,
            y: y.into(),
        });
        self
    }

    /// The colour of each branch: its own or that of its label, or else the next of the fixed order.
    fn colours(&self) -> Vec<Colour> {
        let mut groups: Vec<&Branch> = Vec::new();
        let mut colours = Vec::new();
        for branch in &self.branches {
            let akin = |other: &&Branch| !other.label.is_empty() && other.label == branch.label;
            let number = groups.iter().position(akin).unwrap_or(groups.len());
            if number == groups.len() {
                groups.push(branch);
            }
            let shared = || self.branches.iter().filter(akin).find_map(|b| b.colour);
            let next = Colour::of(&Colour::CURVES, number);
            colours.push(branch.colour.or_else(shared).unwrap_or(next));
        }
        colours
    }
}

/// Width of a branch (px).
const WIDTH: f64 = 1.9;
/// Pen (px) and colour of the points behind.
const BEHIND: (f64, Colour) = (1.3, Colour(110, 110, 110));

impl From<Branches> for Panel {
    fn from(diagram: Branches) -> Self {
        let colours = diagram.colours();
        let mut panel = Self::new(diagram.title, diagram.x, diagram.y, (0.012, 0.05));
        let (pen, colour) = BEHIND;
        let behind = diagram.cloud.map(|(label, x, y)| {
            let shaded = true;
            let dust = Layer::Dust {
                x,
                y,
                pen,
                colour,
                shaded,
            };
            panel.layers.extend([dust, Layer::Frame]);
            label
        });
        let (mut stable, mut unstable) = (Vec::new(), Vec::new());
        for (branch, &colour) in diagram.branches.into_iter().zip(&colours) {
            for (wanted, lines) in [(true, &mut stable), (false, &mut unstable)] {
                let (x, y) = only(&branch.x, &branch.y, &branch.stable, wanted);
                if x.windows(2).any(|ends| ends.iter().all(|x| x.is_finite())) {
                    lines.push(Layer::Line {
                        x,
                        y,
                        width: WIDTH,
                        colour,
                        dashed: !wanted,
                    });
                }
            }
            let swatch = Swatch::Line {
                width: 2.2,
                colour,
                dotted: false,
            };
            panel.key(branch.label, swatch);
        }
        // periods in their order, not in that of their discovery
        panel
            .keys
            .sort_by_key(|key| (key.label.len(), key.label.clone()));
        styles(&mut panel, !stable.is_empty(), !unstable.is_empty());
        panel.layers.extend(unstable.into_iter().chain(stable));
        specials(&mut panel, &diagram.specials);
        let radius = 2.6;
        panel.key(behind.unwrap_or_default(), Swatch::Dot { radius, colour });
        panel
    }
}

/// Legend entries for the line styles that occur.
fn styles(panel: &mut Panel, stable: bool, unstable: bool) {
    let (width, colour) = (2.2, Colour::BLACK);
    if stable {
        let dotted = false;
        panel.key(
            "Stable".to_owned(),
            Swatch::Line {
                width,
                colour,
                dotted,
            },
        );
    }
    if unstable {
        panel.key("Unstable".to_owned(), Swatch::Dashed { width, colour });
    }
}

/// Symbols, legend entries of the kinds that occur, and labels.
fn specials(panel: &mut Panel, specials: &[Special]) {
    for kind in Bifurcation::ALL {
        let points = specials.iter().filter(|special| special.kind == kind);
        let points = points.flat_map(|special| special.y.iter().map(|&y| (special.x, y)));
        let (x, y): (Vec<_>, Vec<_>) = points.unzip();
        if !x.is_empty() {
            panel.key(kind.label().to_owned(), Swatch::Symbol(kind));
            panel.layers.push(Layer::Symbols { kind, x, y });
        }
    }
    let labelled = specials.iter().filter(|special| !special.label.is_empty());
    let notes = labelled.map(|special| Note {
        text: special.label.clone(),
        place: Place::At(special.y.iter().map(|&y| (special.x, y)).collect()),
    });
    panel.layers.push(Layer::Notes(notes.collect()));
}
