//! A page in the making, with the folder of its figures.

use crate::failure::CommandError;
use crate::store::Store;
use saltus_results::{Figure, FigureBlock, Image, Page};

/// A page that is being filled together with its folder.
pub(super) struct Album<'a> {
    pub(super) folder: &'a mut dyn Store,
    pub(super) page: Page,
}

impl Album<'_> {
    pub(super) fn with(&mut self, change: impl FnOnce(Page) -> Page) {
        let page = std::mem::replace(&mut self.page, Page::new(""));
        self.page = change(page);
    }

    pub(super) fn section(&mut self, title: &str) {
        self.with(|page| page.section(title));
    }

    pub(super) fn say(&mut self, paragraphs: &[&str]) {
        for text in paragraphs {
            self.with(|page| page.paragraph(text));
        }
    }

    /// Puts a figure into the folder (SVG, PNG, PDF) and onto the page.
    pub(super) fn show(
        &mut self,
        name: &str,
        figure: &Figure,
        caption: &str,
        data: &[(&str, &str)],
    ) -> Result<(), CommandError> {
        self.folder.figure(name, figure)?;
        let [svg, png, pdf] = ["svg", "png", "pdf"].map(|kind| format!("{name}.{kind}"));
        let mut files = vec![("SVG", &svg[..]), ("PNG", &png), ("PDF", &pdf)];
        files.extend(data);
        let text = figure.svg();
        self.with(|page| {
            page.figure(&FigureBlock {
                caption,
                alternative: caption,
                image: Image::Svg(&text),
                files: &files,
            })
        });
        Ok(())
    }
}
