//! Writing: standard output without panics, files whole or not at all.

use crate::ending::Ending;
use saltus_commands::Answer;
use saltus_results::shown::printable_lines;
use serde::Serialize;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes text to standard output.
pub(crate) fn print(text: &str) -> Result<(), Ending> {
    print_with(|stdout| stdout.write_all(text.as_bytes()))
}

/// Writes one JSON document to standard output, piece by piece: it may be long.
pub(crate) fn print_json(document: &impl Serialize) -> Result<(), Ending> {
    print_with(|stdout| stream_json(stdout, document))
}

/// Prints an answer: one document, a text for people, or nothing, as asked.
pub(crate) fn tell(json: bool, quiet: bool, answer: &dyn Answer) -> Result<(), Ending> {
    match (json, quiet) {
        (true, _) => print_with(|stdout| answer.document(stdout)),
        (false, true) => Ok(()),
        (false, false) => print(&printable_lines(&answer.summary())),
    }
}

/// Says something on standard error that is neither result nor failure.
pub(crate) fn note(text: &str) {
    // nobody is left to tell if standard error is closed
    let _ = writeln!(io::stderr(), "note: {}", printable_lines(text));
}

pub(crate) fn print_with(
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Ending> {
    let mut stdout = BufWriter::with_capacity(1 << 16, io::stdout().lock());
    fill(&mut stdout)
        .and_then(|()| stdout.flush())
        .map_err(|e| match e.kind() {
            io::ErrorKind::BrokenPipe => Ending::ClosedPipe,
            _ => Ending::Output(e.to_string()),
        })
}

/// Writes a JSON document that ends in a newline.
fn stream_json(to: &mut dyn Write, document: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *to, document)?;
    to.write_all(b"\n")
}

/// Writes text to a file, or to standard output if there is no file.
pub(crate) fn print_or_write(out: Option<&Path>, text: &str) -> Result<(), Ending> {
    match out {
        Some(path) => Ok(saltus_results::write_file_atomically(path, text)?),
        None => print(text),
    }
}
