//! Maps: a colour for each cell of a grid over two parameters.
//!
//! # Where the cells lie
//! A value belongs to the middle of its cell, so ticks point at middles. Cells end halfway to their
//! neighbours; the outermost extend half a cell beyond the first and the last value, and so do the axes.

use super::axis::{Axis, Extent, Scale};
use super::bar::Bar;
use super::colour::Colour;
use super::mosaic::{Cells, Mixing, edges};
use super::panel::{Key, Layer, Panel, Swatch, Tally};
use super::scale::ColourScale;

/// Places of the cells of a map: the values along both axes.
#[derive(Clone, Debug)]
pub struct Grid {
    x: (Axis, Vec<f64>),
    y: (Axis, Vec<f64>),
}

impl Grid {
    /// A grid of `x_values.len()` columns and `y_values.len()` rows. The values must ascend or descend, or
    /// the map stays empty; equal distances are usual, but not required.
    ///
    /// Cells are given in rows of constant y: cell (i, j), column i of row j, has the index
    /// `j * x_values.len() + i`.
    pub fn new(
        x: Axis,
        x_values: impl Into<Vec<f64>>,
        y: Axis,
        y_values: impl Into<Vec<f64>>,
    ) -> Self {
        Self {
            x: (x, x_values.into()),
            y: (y, y_values.into()),
        }
    }
}

/// One class of a [`ClassMap`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Class {
    /// Name of the class in the legend.
    pub label: String,
    /// Its colour: one of [`Colour::of_period`], [`Colour::OTHER`], [`Colour::IRREGULAR`],
    /// [`Colour::UNDECIDED`] and [`Colour::FAILED`], any two of which are easy to distinguish.
    pub colour: Colour,
}

impl Class {
    /// A class with a label and a colour.
    pub fn new(label: impl Into<String>, colour: Colour) -> Self {
        Self {
            label: label.into(),
            colour,
        }
    }
}

/// A map of discrete classes, with a legend of those that occur.
#[derive(Clone, Debug)]
pub struct ClassMap {
    title: String,
    grid: Grid,
    cells: Vec<u8>,
    classes: Vec<Class>,
    shares: bool,
}

impl ClassMap {
    /// A map of `cells`, each the index of its class in `classes`, in the order of [`Grid`]. Missing cells,
    /// and those with an index beyond the classes, are drawn as without a value.
    pub fn new(
        title: impl Into<String>,
        grid: Grid,
        cells: impl Into<Vec<u8>>,
        classes: impl IntoIterator<Item = Class>,
    ) -> Self {
        Self {
            title: title.into(),
            grid,
            cells: cells.into(),
            classes: classes.into_iter().collect(),
            shares: false,
        }
    }

    /// Adds to each legend entry the share of its class in all cells of the figure, in per cent.
    #[must_use]
    pub fn shares(mut self) -> Self {
        self.shares = true;
        self
    }
}

/// A map of continuous values, with a colour bar at its right.
#[derive(Clone, Debug)]
pub struct ValueMap {
    title: String,
    grid: Grid,
    values: Vec<f64>,
    bar: Axis,
    scale: ColourScale,
    missing: String,
}

impl ValueMap {
    /// A map of `values` in the order of [`Grid`]; `bar` labels the colour bar and may fix its limits or
    /// make it logarithmic. Values beyond fixed limits have the colour of the nearest end, which the bar
    /// shows by an arrow. Values that are not finite, or missing, are light grey.
    pub fn new(
        title: impl Into<String>,
        grid: Grid,
        values: impl Into<Vec<f64>>,
        bar: Axis,
    ) -> Self {
        Self {
            title: title.into(),
            grid,
            values: values.into(),
            bar,
            scale: ColourScale::default(),
            missing: "No value".to_owned(),
        }
    }

    /// Another colour scale than the default.
    #[must_use]
    pub fn scale(mut self, scale: ColourScale) -> Self {
        self.scale = scale;
        self
    }

    /// Name of cells without a value in the legend, if there are any; "No value" by default.
    #[must_use]
    pub fn missing(mut self, label: impl Into<String>) -> Self {
        self.missing = label.into();
        self
    }
}

impl From<ClassMap> for Panel {
    fn from(map: ClassMap) -> Self {
        let Grid { x, y } = map.grid;
        // One code is left for cells without a class.
        let classes = &map.classes[..map.classes.len().min(255)];
        let missing = classes.len();
        let total = x.1.len() * y.1.len();
        let class = |index: usize| {
            map.cells
                .get(index)
                .map_or(missing, |&c| usize::from(c).min(missing))
        };
        let codes: Vec<u8> = (0..total).map(|index| class(index) as u8).collect();
        let mut counts = [0_usize; 256];
        codes
            .iter()
            .for_each(|&code| counts[usize::from(code)] += 1);

        let mut panel = Self::new(map.title, x.0, y.0, (0.0, 0.0));
        let absent = Class::new("No value", Colour::MISSING);
        for (class, &cells) in classes.iter().chain([&absent]).zip(&counts) {
            let (colour, share) = (class.colour, map.shares);
            panel.keys.push(Key {
                label: class.label.clone(),
                swatch: Swatch::Patch { colour },
                tally: Some(Tally {
                    cells,
                    total,
                    share,
                }),
            });
        }
        let colours = classes.iter().chain([&absent]).map(|class| class.colour);
        panel.cells((&x.1, &y.1), codes, colours.collect(), Mixing::Largest);
        panel
    }
}

/// Steps of a colour scale; one more code stands for no value.
const STEPS: u8 = 255;

impl From<ValueMap> for Panel {
    fn from(map: ValueMap) -> Self {
        let Grid { x, y } = map.grid;
        let mut extent = Extent::EMPTY;
        map.values
            .iter()
            .for_each(|&value| extent.include(&map.bar, value));
        let scale = Scale::resolve(&map.bar, extent.unless_noise(), 0.0, 6);
        let share = |value: f64| scale.share(value).filter(|_| map.bar.admits(value));
        let code = |value: f64| match share(value) {
            Some(share) => (share.clamp(0.0, 1.0) * f64::from(STEPS - 1)).round() as u8,
            None => STEPS,
        };
        let total = x.1.len() * y.1.len();
        let value = |index: usize| map.values.get(index).copied().unwrap_or(f64::NAN);
        let codes: Vec<u8> = (0..total).map(|index| code(value(index))).collect();
        let beyond =
            |limit: fn(f64) -> bool| map.values.iter().any(|&v| share(v).is_some_and(limit));

        let mut panel = Self::new(map.title, x.0, y.0, (0.0, 0.0));
        let cells = codes.iter().filter(|&&code| code == STEPS).count();
        panel.keys.push(Key {
            label: map.missing,
            swatch: Swatch::Patch {
                colour: Colour::MISSING,
            },
            tally: Some(Tally {
                cells,
                total,
                share: false,
            }),
        });
        let step = |step: u8| map.scale.at(f64::from(step) / f64::from(STEPS - 1));
        let mut colours: Vec<Colour> = (0..STEPS).map(step).collect();
        panel.bar = Some(Bar {
            label: scale.label(&map.bar),
            // Rounding is no excess.
            below: beyond(|share| share < -1e-9),
            above: beyond(|share| share > 1.0 + 1e-9),
            colours: colours.clone(),
            scale,
        });
        colours.push(Colour::MISSING);
        panel.cells((&x.1, &y.1), codes, colours, Mixing::Mean);
        panel
    }
}

impl Panel {
    /// Adds the cells around the values of both axes, unless these are of no use.
    fn cells(
        &mut self,
        (x, y): (&[f64], &[f64]),
        codes: Vec<u8>,
        colours: Vec<Colour>,
        mixing: Mixing,
    ) {
        if let (Some(x), Some(y)) = (edges(&self.x, x), edges(&self.y, y)) {
            self.layers.push(Layer::Cells(Cells {
                x,
                y,
                codes,
                colours,
                mixing,
            }));
            self.layers.push(Layer::Frame);
        }
    }
}
