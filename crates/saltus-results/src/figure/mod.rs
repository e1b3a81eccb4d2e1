//! Figures: declared as data, rendered to SVG text and PNG bytes from one drawing.
//!
//! kuva draws the axes, ticks and all type; the marks between the axes are ours, because a cloud of
//! 200 000 points needs thinning and one path instead of one element per point.
//!
//! Build one of [`Cloud`], [`Branches`], [`BifurcationSet`], [`Shares`], [`Portrait`], [`History`], [`Curves`],
//! [`ClassMap`] or [`ValueMap`] and hand it to [`Figure::new`], or several as panels to [`Figure::grid`]. Points
//! that are not finite are skipped, empty series are fine, and constant data get a sensible range. So a figure
//! cannot fail; a PNG can only be too large.
//!
//! ```
//! use saltus_results::{Axis, Cloud, Figure};
//! let (x, y) = (vec![0.01, 0.02, 0.03], vec![1.0, f64::NAN, 1.2]);
//! let cloud = Cloud::new("Jump height", Axis::new("Damping ratio (-)"), Axis::new("Height (m)"))
//!     .series("Up-sweep", x, y);
//! let figure = Figure::new(cloud);
//! assert!(figure.svg().starts_with("<svg"));
//! ```

mod area;
mod axis;
mod bar;
mod bifurcation;
mod bifurcation_set;
mod branches;
mod cloud;
mod colour;
mod compose;
mod curves;
mod dash;
mod frame;
mod history;
mod ink;
mod legend;
mod lettering;
mod map;
mod marks;
mod mosaic;
mod notes;
mod panel;
mod parts;
mod portrait;
mod raster;
mod scale;
mod shares;
mod style;
mod text;
mod thin;
mod vector;

pub use axis::Axis;
pub use bifurcation::Bifurcation;
pub use bifurcation_set::BifurcationSet;
pub use branches::Branches;
pub use cloud::Cloud;
pub use colour::Colour;
pub use curves::Curves;
pub use history::History;
pub use map::{Class, ClassMap, Grid, ValueMap};
pub use panel::Panel;
pub use portrait::Portrait;
pub use scale::ColourScale;
pub use shares::Shares;

use crate::ResultsError;

/// One or more panels with a common title and legend.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    columns: usize,
    panels: Vec<Panel>,
    tagged: bool,
    plot: (f64, f64),
}

impl Figure {
    /// A figure of one panel, whose title becomes the figure's.
    pub fn new(panel: impl Into<Panel>) -> Self {
        let mut panel = panel.into();
        let title = std::mem::take(&mut panel.title);
        Self {
            title,
            columns: 1,
            panels: vec![panel],
            tagged: false,
            plot: (760.0, 430.0),
        }
    }

    /// Panels in rows of `columns`, tagged (a), (b), ... with one legend for all. Entries of equal
    /// label are shown once, so a label should mean the same in each panel.
    pub fn grid(columns: usize, panels: impl IntoIterator<Item = Panel>) -> Self {
        let columns = columns.max(1);
        let plot = match columns {
            1 => (760.0, 300.0),
            2 => (440.0, 300.0),
            _ => (350.0, 270.0),
        };
        let panels = panels.into_iter().collect();
        Self {
            title: String::new(),
            columns,
            panels,
            tagged: true,
            plot,
        }
    }

    /// The title above all panels.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Size of the area between the axes of each panel (px); 80 at least.
    #[must_use]
    pub fn plot_size(mut self, width: f64, height: f64) -> Self {
        let sane = |size: f64| {
            if size.is_finite() {
                size.clamp(80.0, 4000.0)
            } else {
                300.0
            }
        };
        self.plot = (sane(width), sane(height));
        self
    }

    /// The figure as SVG text: white ground, scalable, vectors except for the cells of maps.
    pub fn svg(&self) -> String {
        vector::svg(compose::drawing(self))
    }

    /// The figure as PNG bytes with `scale` pixels per unit of the SVG; 2 suits screens and print.
    ///
    /// # Errors
    /// [`ResultsError::PngScale`] if the scale is not between 0.5 and 8 or the image would exceed
    /// 200 million pixels; [`ResultsError::Png`] if the rasteriser refuses.
    pub fn png(&self, scale: f32) -> Result<Vec<u8>, ResultsError> {
        raster::png(compose::drawing(self), scale)
    }
}
