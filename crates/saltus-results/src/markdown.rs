//! Markdown tables, for people.

use std::fmt::Write as _;

/// A table in Markdown.
#[derive(Clone, Debug)]
pub struct MarkdownTable {
    text: String,
    columns: usize,
}

impl MarkdownTable {
    /// A table with a header and no rows yet.
    pub fn new(header: &[&str]) -> Self {
        let mut table = Self {
            text: String::new(),
            columns: header.len(),
        };
        table.line(header);
        table.line(&vec!["---"; header.len()]);
        table
    }

    /// Appends a row; missing cells stay empty and surplus ones are left out.
    #[must_use]
    pub fn row(mut self, cells: &[&str]) -> Self {
        self.line(cells);
        self
    }

    fn line(&mut self, cells: &[&str]) {
        for column in 0..self.columns {
            let cell = cells.get(column).copied().unwrap_or_default();
            // writing to a string cannot fail
            let _ = write!(self.text, "| {} ", markdown(cell));
        }
        self.text.push_str("|\n");
    }
}

impl std::fmt::Display for MarkdownTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// A cell that stays one cell: no bars and no line breaks.
fn markdown(cell: &str) -> String {
    cell.replace('\\', "\\\\")
        .replace('|', "\\|")
        .replace("\r\n", " ")
        .replace(['\r', '\n'], " ")
}

#[cfg(test)]
mod tests {
    use super::MarkdownTable;

    #[test]
    fn cells_stay_cells() {
        let table = MarkdownTable::new(&["claim", "value"])
            .row(&["a|b\nc", "2.5"])
            .row(&[]);
        assert_eq!(
            table.to_string(),
            "| claim | value |\n| --- | --- |\n| a\\|b c | 2.5 |\n|  |  |\n"
        );
    }
}
