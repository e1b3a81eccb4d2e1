//! The look of all figures: sizes of type, widths of pens and opacities that more than one file draws with, and the
//! size in print that a user asks for.

use super::colour::Colour;
use crate::ResultsError;
use serde::{Deserialize, Serialize};

/// Size of the title of a figure (px).
pub(crate) const TITLE: f64 = 16.0;
/// Size of the title of a panel (px).
pub(crate) const PANEL_TITLE: f64 = 14.0;
/// Size of the label of an axis (px).
pub(crate) const LABEL: f64 = 15.0;
/// Size of the numbers at ticks, of notes and of the legend (px).
pub(crate) const TICK: f64 = 13.0;

/// Empty edge of the sheet (px).
pub(crate) const EDGE: f64 = 8.0;

/// Opacity of a shade.
pub(crate) const SHADE: f64 = 0.3;
/// Opacity of a band: two of them on top of each other still let a curve through.
pub(crate) const BAND: f64 = 0.25;

/// Width of the rim of a dot (px).
pub(crate) const RIM: f64 = 0.9;
/// Width of the pen that draws the rim of type (px).
pub(crate) const HALO: f64 = 3.0;
/// Width (px) and colour of lines that data are compared with.
pub(crate) const REFERENCE: (f64, Colour) = (1.2, Colour::DARK);
/// Colour of the grid.
pub(crate) const GRID: Colour = Colour(228, 228, 228);

/// Look of figures in print: their width, the size of their type, and whether titles stand in them.
///
/// ```
/// use saltus_results::FigureStyle;
/// let column = FigureStyle::default().width("85mm")?.font_size("8pt")?.titles(false);
/// assert!(FigureStyle::default().width("85 miles").is_err());
/// # Ok::<(), saltus_results::ResultsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FigureStyle {
    /// Width (pt); without it the figure has the size that suits a screen.
    pub(crate) width: Option<f64>,
    /// Size of the labels of axes (pt).
    pub(crate) font: f64,
    pub(crate) titles: bool,
}

impl Default for FigureStyle {
    /// The size of a screen, with titles.
    fn default() -> Self {
        Self {
            width: None,
            font: 8.0,
            titles: true,
        }
    }
}

/// Points of a millimetre.
const MILLIMETRE: f64 = 72.0 / 25.4;

impl FigureStyle {
    /// The width in print, 30 to 1000 mm: a length such as `85mm`, `8.5cm`, `3.35in` or `241pt`. A journal's column is
    /// some 85 mm wide, its page 170 mm.
    ///
    /// # Errors
    /// [`ResultsError::FigureStyle`] for anything else.
    pub fn width(mut self, length: &str) -> Result<Self, ResultsError> {
        let fits = |width: &f64| (30.0..=1000.0).contains(&(width / MILLIMETRE));
        let refused = || ResultsError::FigureStyle {
            what: "width of figures",
            given: length.to_owned(),
            right: "a length from 30mm to 1000mm, such as 85mm, 170mm, 3.35in or 241pt",
        };
        self.width = Some(points(length).filter(fits).ok_or_else(refused)?);
        Ok(self)
    }

    /// The size of the labels of axes in print, 4pt to 36pt; other type is in proportion. It counts where a
    /// [width](Self::width) is set, and is 8 pt by default.
    ///
    /// # Errors
    /// [`ResultsError::FigureStyle`] for anything else.
    pub fn font_size(mut self, size: &str) -> Result<Self, ResultsError> {
        let refused = || ResultsError::FigureStyle {
            what: "font size of figures",
            given: size.to_owned(),
            right: "a size from 4pt to 36pt, such as 8pt",
        };
        let fits = |size: &f64| (4.0..=36.0).contains(size);
        self.font = points(size).filter(fits).ok_or_else(refused)?;
        Ok(self)
    }

    /// Whether titles stand above figures and panels; tags such as (a) stay.
    #[must_use]
    pub fn titles(mut self, shown: bool) -> Self {
        self.titles = shown;
        self
    }
}

/// A length in points.
fn points(length: &str) -> Option<f64> {
    let units = [
        ("mm", MILLIMETRE),
        ("cm", 10.0 * MILLIMETRE),
        ("in", 72.0),
        ("pt", 1.0),
    ];
    units.into_iter().find_map(|(unit, size)| {
        let number = length.trim().strip_suffix(unit)?.trim_end();
        number
            .parse::<f64>()
            .ok()
            .filter(|n| n.is_finite())
            .map(|n| n * size)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_units() {
        let close = |length: &str, expected: f64| {
            assert!(
                points(length).is_some_and(|found| (found - expected).abs() < 1e-9),
                "{length}"
            );
        };
        close("25.4mm", 72.0);
        close(" 2.54 cm", 72.0);
        close("1in", 72.0);
        close("8pt", 8.0);
        for odd in ["85", "mm", "NaNmm", "infpt", "8 px", "-85mm", "0mm"] {
            assert!(FigureStyle::default().width(odd).is_err(), "{odd}");
        }
    }
}
