//! A self-contained HTML page: figures inlined, no script, nothing fetched from anywhere.
//!
//! Figures are inlined as images (`data:` addresses), so that the names inside one SVG cannot meet
//! those of another, and linked to the files beside the page.

mod style;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// An HTML page in the making. All text is escaped; there is no way to pass markup.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    body: String,
    contents: Vec<String>,
    open: bool,
    figures: usize,
}

/// A figure with its caption and the files that hold it.
#[derive(Clone, Debug)]
pub struct FigureBlock<'a> {
    /// The caption.
    pub caption: &'a str,
    /// Text for a person who cannot see the figure; the caption if empty.
    pub alternative: &'a str,
    /// The image shown in the page.
    pub image: Image<'a>,
    /// Links below the caption: a label and a file beside the page, such as ("SVG", "fig2a.svg").
    pub files: &'a [(&'a str, &'a str)],
}

/// An image to be inlined.
#[derive(Clone, Copy, Debug)]
pub enum Image<'a> {
    /// SVG text: sharp at any size.
    Svg(&'a str),
    /// PNG bytes.
    Png(&'a [u8]),
}

/// Verdict on a claim. Each badge has its own sign, so that colour is not needed to distinguish them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Reproduced as claimed.
    Reproduced,
    /// Reproduced with a stated departure.
    Departure,
    /// Not reproduced.
    NotReproduced,
}

impl Verdict {
    /// The verdict in words, as in the badge.
    pub fn words(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Departure => "reproduced with a departure",
            Self::NotReproduced => "not reproduced",
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Self::Reproduced => "✓",
            Self::Departure => "≈",
            Self::NotReproduced => "✗",
        }
    }

    fn class(self) -> &'static str {
        match self {
            Self::Reproduced => "yes",
            Self::Departure => "partly",
            Self::NotReproduced => "no",
        }
    }
}

/// A claim set beside our value.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Short name, such as "F1".
    pub name: String,
    /// The claim, in words.
    pub claim: String,
    /// Our value, with its unit.
    pub value: String,
    /// The verdict on the claim.
    pub verdict: Verdict,
    /// Reading of the source on which the verdict depends.
    pub reading: String,
}

impl Page {
    /// A page with a title and nothing else.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            body: String::new(),
            contents: Vec::new(),
            open: false,
            figures: 0,
        }
    }

    /// Starts a section; it appears in the table of contents.
    #[must_use]
    pub fn section(mut self, title: &str) -> Self {
        self.close();
        self.contents.push(title.to_owned());
        let id = self.contents.len();
        self.open = true;
        self.push(&format!(
            "<section id=\"s{id}\">\n<h2>{}</h2>\n",
            typeset(title)
        ))
    }

    /// A heading below that of the section.
    #[must_use]
    pub fn subsection(self, title: &str) -> Self {
        self.push(&format!("<h3>{}</h3>\n", typeset(title)))
    }

    /// A paragraph.
    #[must_use]
    pub fn paragraph(self, text: &str) -> Self {
        self.push(&format!("<p>{}</p>\n", typeset(text)))
    }

    /// A list with a dot before each item.
    #[must_use]
    pub fn list<'a>(self, items: impl IntoIterator<Item = &'a str>) -> Self {
        let items: String = items
            .into_iter()
            .map(|item| format!("<li>{}</li>\n", typeset(item)))
            .collect();
        self.push(&format!("<ul>\n{items}</ul>\n"))
    }

    /// A sentence that stands out, such as the verdict on all.
    #[must_use]
    pub fn lead(self, text: &str) -> Self {
        self.push(&format!("<p class=\"lead\">{}</p>\n", typeset(text)))
    }

    /// A figure with a numbered caption: R1, R2 and so on, which no paper's numbers are. It leads to the first of its files.
    #[must_use]
    pub fn figure(mut self, figure: &FigureBlock) -> Self {
        self.figures += 1;
        let alternative = if figure.alternative.is_empty() {
            figure.caption
        } else {
            figure.alternative
        };
        let links: Vec<_> = figure
            .files
            .iter()
            .map(|(label, file)| link(label, file))
            .collect();
        let image = format!(
            "<img alt=\"{}\" src=\"{}\">",
            escape(&plain(alternative)),
            data_address(figure.image)
        );
        let image = match figure.files.first() {
            Some((_, file)) => format!("<a href=\"./{}\">{image}</a>", escape(&address(file))),
            None => image,
        };
        let block = format!(
            "<figure>\n<div class=\"scroll\">{image}</div>\n<figcaption><b>Figure R{}.</b> {} \
             <span class=\"files\">{}</span></figcaption>\n</figure>\n",
            self.figures,
            typeset(figure.caption),
            links.join(" · "),
        );
        self.push(&block)
    }

    /// A table. Columns of numbers are set to the right, and a cell with the [words](Verdict::words) of
    /// a verdict shows its badge.
    #[must_use]
    pub fn table<R, C>(self, header: &[&str], rows: R) -> Self
    where
        R: IntoIterator<Item = C>,
        C: IntoIterator<Item: AsRef<str>>,
    {
        let text = |row: C| {
            row.into_iter()
                .map(|cell| cell.as_ref().to_owned())
                .collect()
        };
        let rows: Vec<Vec<String>> = rows.into_iter().map(text).collect();
        let numeric = |column: usize| {
            let mut cells = rows.iter().filter_map(|row| row.get(column)).peekable();
            cells.peek().is_some() && cells.all(|cell| is_number(cell))
        };
        let head: Vec<_> = header
            .iter()
            .enumerate()
            .map(|(i, cell)| (*cell, numeric(i)))
            .collect();
        let cells = |row: &Vec<String>| {
            let cells = row.iter().enumerate();
            row_of(cells.map(|(i, cell)| {
                let name = header.get(i).copied().unwrap_or_default();
                data_cell(name, cell, numeric(i))
            }))
        };
        let body: String = rows.iter().map(cells).collect();
        self.push(&table(&head, &body))
    }

    /// Claims one after the other, each with its verdict and our value; what the verdict depends on is folded away.
    #[must_use]
    pub fn facts(self, facts: &[Fact]) -> Self {
        facts.iter().fold(self, |page, fact| {
            let page = page.push(&format!(
                "<div class=\"fact\">\n<h3>{} {}</h3>\n<blockquote>{}</blockquote>\n<p><b>Ours:</b> {}</p>\n",
                typeset(&fact.name),
                badge(fact.verdict),
                typeset(&fact.claim),
                typeset(&fact.value)
            ));
            let page = match fact.reading.as_str() {
                "" | "-" => page,
                reading => page.details("Depends on the reading", |page| page.paragraph(reading)),
            };
            page.push("</div>\n")
        })
    }

    /// A block of code or of program output.
    #[must_use]
    pub fn code(self, text: &str) -> Self {
        self.push(&format!("<pre><code>{}</code></pre>\n", escape(text)))
    }

    /// A part that is folded away until asked for; `fill` adds to it anything that a page can hold.
    #[must_use]
    pub fn details(self, summary: &str, fill: impl FnOnce(Self) -> Self) -> Self {
        let inside = fill(self.push(&format!(
            "<details>\n<summary>{}</summary>\n",
            escape(summary)
        )));
        inside.push("</details>\n")
    }

    /// Links to files beside the page, as a list.
    #[must_use]
    pub fn files<'a>(self, files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let items: String = files
            .into_iter()
            .map(|(label, file)| format!("<li>{}</li>\n", link(label, file)))
            .collect();
        self.push(&format!("<ul>\n{items}</ul>\n"))
    }

    /// The page as HTML text.
    #[must_use]
    pub fn render(mut self) -> String {
        self.close();
        let title = escape(&self.title);
        let contents: String = self
            .contents
            .iter()
            .zip(1..)
            .map(|(section, id)| format!("<li><a href=\"#s{id}\">{}</a></li>\n", escape(section)))
            .collect();
        let contents = if contents.is_empty() {
            contents
        } else {
            format!("<nav aria-label=\"Contents\">\n<ol>\n{contents}</ol>\n</nav>\n")
        };
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n\
             {contents}</header>\n<main>\n{}</main>\n</body>\n</html>\n",
            style::CSS,
            self.body
        )
    }

    fn push(mut self, markup: &str) -> Self {
        self.body.push_str(markup);
        self
    }

    fn close(&mut self) {
        if std::mem::take(&mut self.open) {
            self.body.push_str("</section>\n");
        }
    }
}

/// A table from its header cells, each with whether its column is numeric, and the rows as markup.
fn table(header: &[(&str, bool)], rows: &str) -> String {
    let cell = |(text, numeric): &(&str, bool)| {
        format!(
            "<th scope=\"col\"{}>{}</th>",
            class(*numeric),
            typeset(text)
        )
    };
    let head: String = header.iter().map(cell).collect();
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

fn class(numeric: bool) -> &'static str {
    if numeric { " class=\"number\"" } else { "" }
}

fn is_number(cell: &str) -> bool {
    cell.replace('\u{2212}', "-").parse::<f64>().is_ok()
}

fn row_of(cells: impl IntoIterator<Item = String>) -> String {
    let cells: String = cells.into_iter().collect();
    format!("<tr>{cells}</tr>\n")
}

/// A cell of the column `name`, which a narrow screen shows beside it; one that names a verdict shows its badge.
fn data_cell(name: &str, cell: &str, numeric: bool) -> String {
    let verdicts = [
        Verdict::Reproduced,
        Verdict::Departure,
        Verdict::NotReproduced,
    ];
    let name = escape(&plain(name));
    match verdicts.into_iter().find(|verdict| verdict.words() == cell) {
        Some(verdict) => format!("<td data-name=\"{name}\">{}</td>", badge(verdict)),
        None => format!(
            "<td data-name=\"{name}\"{}>{}</td>",
            class(numeric),
            typeset(cell)
        ),
    }
}

fn badge(verdict: Verdict) -> String {
    let (class, sign, words) = (verdict.class(), verdict.sign(), verdict.words());
    format!(
        "<span class=\"badge {class}\"><span aria-hidden=\"true\">{sign}</span>&nbsp;{words}</span>"
    )
}

/// A link to a file beside the page. A scheme such as `javascript:` becomes a harmless file name.
fn link(label: &str, file: &str) -> String {
    format!(
        "<a href=\"./{}\">{}</a>",
        escape(&address(file)),
        escape(label)
    )
}

/// A relative address with everything but plain characters written as %XX.
fn address(file: &str) -> String {
    file.bytes()
        .map(|byte| match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'/' => {
                char::from(byte).to_string()
            }
            _ => format!("%{byte:02X}"),
        })
        .collect()
}

fn data_address(image: Image) -> String {
    let (kind, bytes) = match image {
        Image::Svg(text) => ("image/svg+xml", text.as_bytes()),
        Image::Png(bytes) => ("image/png", bytes),
    };
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}

/// Text as HTML shows it, its symbols typeset: a single letter with an index, as in ω_h, or a power, as in 10^−3.
fn typeset(text: &str) -> String {
    let letters: Vec<char> = text.chars().filter(|c| *c != '$').collect();
    let mut html = String::with_capacity(text.len());
    let mut at = 0;
    while at < letters.len() {
        let alone = at == 0 || !(letters[at - 1].is_alphanumeric() || letters[at - 1] == '_');
        let next = letters.get(at + 1).copied();
        if alone && letters[at].is_alphabetic() && next == Some('_') {
            let index = script(&letters[at + 2..], char::is_alphanumeric);
            if !index.is_empty() {
                html += &format!("<i>{}</i><sub>{}</sub>", letters[at], escape(&index));
                at += 2 + index.chars().count();
                continue;
            }
        }
        if letters[at] == '^' {
            let power = script(&letters[at + 1..], |c| {
                c.is_ascii_digit() || "-\u{2212}".contains(c)
            });
            if !power.is_empty() {
                html += &format!("<sup>{}</sup>", escape(&power));
                at += 1 + power.chars().count();
                continue;
            }
        }
        html += &escape(letters[at].encode_utf8(&mut [0; 4]));
        at += 1;
    }
    html
}

/// The letters of a script at the beginning.
fn script(letters: &[char], fits: impl Fn(char) -> bool) -> String {
    letters.iter().copied().take_while(|&c| fits(c)).collect()
}

/// Text without the marks of symbols.
fn plain(text: &str) -> String {
    text.replace('$', "")
}

/// Text as HTML shows it, safe in elements and in quoted attributes.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    const NASTY: &str = "<script>alert('x')</script> & \"quotes\"";

    #[test]
    fn no_text_becomes_markup() {
        let fact = Fact {
            name: NASTY.into(),
            claim: NASTY.into(),
            value: NASTY.into(),
            verdict: Verdict::Departure,
            reading: NASTY.into(),
        };
        let block = FigureBlock {
            caption: NASTY,
            alternative: "",
            image: Image::Png(b"x"),
            files: &[(NASTY, NASTY)],
        };
        let html = Page::new(NASTY)
            .section(NASTY)
            .subsection(NASTY)
            .paragraph(NASTY)
            .list([NASTY])
            .figure(&block)
            .table(&[NASTY], [[NASTY]])
            .facts(&[fact])
            .code(NASTY)
            .details(NASTY, |page| page.paragraph(NASTY))
            .files([(NASTY, "javascript:alert(1)")])
            .render();
        assert!(
            !html.contains("<script")
                && !html.contains("alert('")
                && !html.contains("\"javascript:")
        );
        assert!(html.contains("&lt;script&gt;alert(&#39;x&#39;)"));
    }

    #[test]
    fn the_page_needs_nothing_else() {
        let image = Image::Svg("<svg/>");
        let block = FigureBlock {
            caption: "A",
            alternative: "",
            image,
            files: &[("SVG", "a b.svg")],
        };
        let html = Page::new("Results")
            .section("One")
            .figure(&block)
            .section("Two")
            .render();
        assert!(!html.contains("http:") && !html.contains("https:") && !html.contains("<link"));
        assert!(
            html.contains("data:image/svg+xml;base64,PHN2Zy8+") && html.contains("./a%20b.svg")
        );
        assert_eq!(
            html.matches("<section").count(),
            html.matches("</section>").count()
        );
        assert!(html.contains("<a href=\"#s2\">Two</a>"));
    }

    #[test]
    fn symbols_are_typeset_and_names_are_not() {
        assert_eq!(
            typeset("PRF/(m_h g) at $ω_h$, 4^2/π^2 < 10^-3"),
            "PRF/(<i>m</i><sub>h</sub> g) at <i>ω</i><sub>h</sub>, 4<sup>2</sup>/π<sup>2</sup> &lt; 10<sup>-3</sup>"
        );
        assert_eq!(
            typeset("damping_ratio, w_, a^, _x"),
            "damping_ratio, w_, a^, _x"
        );
    }

    #[test]
    fn verdicts_differ_without_colour() {
        let html = Page::new("t")
            .table(
                &["v", "n"],
                [["not reproduced", "2.5"], ["reproduced", "−1"]],
            )
            .render();
        assert!(
            html.contains("✗</span>&nbsp;not reproduced")
                && html.contains("✓</span>&nbsp;reproduced")
        );
        assert!(html.contains("<td data-name=\"n\" class=\"number\">2.5</td>"));
    }
}
