//! Figures: declared as data, rendered to SVG, PNG and PDF from one drawing.
//!
//! A figure is laid out once (`compose.rs`) as marks and type in pixels (`ink.rs`), which three backends draw: SVG, PNG
//! and PDF. No plot library is below: those that were tried had no images, no halves of a pixel, no size in millimetres
//! or no indices, and a cloud of 10⁶ points needs shades by number and not one element per point.
//!
//! Build one of [`Cloud`], [`Branches`], [`BifurcationSet`], [`Shares`], [`Portrait`], [`History`], [`Curves`],
//! [`ClassMap`] or [`ValueMap`] and hand it to [`Figure::new`], or several as panels to [`Figure::grid`]. Points
//! that are not finite are skipped, empty series are fine, and constant data get a sensible range. So a figure
//! cannot fail; a PNG can only be too large.
//!
//! ```
//! use saltus_results::{Axis, Cloud, Figure};
//! let (x, y) = (vec![0.01, 0.02, 0.03], vec![1.0, f64::NAN, 1.2]);
//! let cloud = Cloud::new("Jump height", Axis::new("Damping ratio $ζ_h$"), Axis::new("Height (m)"))
//!     .series("Up-sweep", x, y);
//! let figure = Figure::new(cloud);
//! assert!(figure.svg().starts_with("<svg"));
//! ```

mod area;
mod axes;
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
mod density;
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
mod pdf;
mod portrait;
mod raster;
mod scale;
mod shares;
mod style;
mod thin;
mod typeface;
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
pub use style::FigureStyle;

use crate::ResultsError;

/// One or more panels with a common title and legend.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    columns: usize,
    panels: Vec<Panel>,
    tagged: bool,
    shared: bool,
    plot: (f64, f64),
    style: FigureStyle,
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
            shared: false,
            plot: (760.0, 430.0),
            style: FigureStyle::default(),
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
            shared: false,
            plot,
            style: FigureStyle::default(),
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

    /// One pair of scales for all panels, so that they can be compared.
    #[must_use]
    pub fn same_scales(mut self) -> Self {
        self.shared = true;
        self
    }

    /// Another look, such as a width in print.
    #[must_use]
    pub fn style(mut self, style: FigureStyle) -> Self {
        self.style = style;
        self
    }

    /// The figure as SVG text: white ground, vectors except for the cells of maps and the shades of clouds.
    pub fn svg(&self) -> String {
        vector::svg(&compose::drawing(self))
    }

    /// The figure as PNG bytes with `scale` pixels per unit of the SVG; 2 suits screens. A figure with a
    /// [width](FigureStyle::width) has 600 pixels to an inch, whatever the scale.
    ///
    /// # Errors
    /// [`ResultsError::PngScale`] if the scale is not between 0.3 and 32 or the image would exceed
    /// 200 million pixels; [`ResultsError::Png`] if the rasteriser refuses.
    pub fn png(&self, scale: f32) -> Result<Vec<u8>, ResultsError> {
        raster::png(&compose::drawing(self), scale)
    }

    /// The figure as the bytes of a PDF of one page, its type as outlines. Without a [width](FigureStyle::width) a unit of
    /// the SVG is three quarters of a point.
    pub fn pdf(&self) -> Vec<u8> {
        pdf::pdf(&compose::drawing(self))
    }
}
