//! Names of what each jumper has: columns of texts, panels of figures.

/// Names of columns of a table: `z` for one jumper, `z_0`, `z_1`, ... for several.
pub(crate) fn column(name: &str, jumper: usize, jumpers: usize) -> String {
    if jumpers == 1 {
        name.to_owned()
    } else {
        format!("{name}_{jumper}")
    }
}

/// Panels of a figure: beyond some it shows nothing.
pub(crate) const PANELS: usize = 6;

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
