//! Integration tests: study files, right and wrong.
#![allow(clippy::unwrap_used)]

mod bad_input;
mod continuation;
mod files;
mod format;
mod hostile;
mod json;
mod template;
mod values;
