//! Names of what each jumper has: columns of texts, panels of figures.

use saltus_results::{Figure, Panel};

/// Names of columns of a table: `z` for one jumper, `z_0`, `z_1`, ... for several.
pub(crate) fn column(name: &str, jumper: usize, jumpers: usize) -> String {
    if jumpers == 1 {
        name.to_owned()
    } else {
        format!("{name}_{jumper}")
    }
}

/// Panels of a figure: more do not fit on a page.
pub(crate) const PANELS: usize = 24;

/// A figure of one panel for each jumper, in as many columns as they need to fit on a page; up to three stand in
/// `columns`.
pub(crate) fn page(columns: usize, panels: Vec<Panel>) -> Figure {
    match panels.len() {
        0..=3 => Figure::grid(columns, panels),
        4..=9 => Figure::grid(3, panels)
            .plot_size(280.0, 210.0)
            .same_scales(),
        _ => Figure::grid(4, panels)
            .plot_size(210.0, 150.0)
            .same_scales(),
    }
}

/// Title of a jumper's panel; none is needed for one.
pub(crate) fn panel_title(jumper: usize, jumpers: usize) -> String {
    match jumpers {
        1 => String::new(),
        _ if jumpers > PANELS => {
            format!("Jumper {jumper} (of {jumpers}, the first {PANELS} shown)")
        }
        _ => format!("Jumper {jumper}"),
    }
}
