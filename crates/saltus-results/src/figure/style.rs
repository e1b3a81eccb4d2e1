//! The look of all figures: sizes of type, widths of pens and opacities that more than one file draws with.

use super::colour::Colour;

/// Size of the title of a figure (px).
pub(crate) const TITLE: u32 = 16;
/// Size of the title of a panel (px).
pub(crate) const PANEL_TITLE: u32 = 14;
/// Size of the label of an axis (px).
pub(crate) const LABEL: u32 = 15;
/// Size of the numbers at ticks, and of notes (px).
pub(crate) const TICK: u32 = 13;

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
