//! Integration tests: files of a result, written and read back.
#![allow(clippy::unwrap_used)]

mod compare;
mod dataset;
mod figures;
mod folder;
mod manifest;
mod one_writer;
mod tables;
