//! Integration tests: answers, where they go, and pieces of them.
#![allow(clippy::unwrap_used)]

mod datasets;
mod destination;
mod pieces;
mod unchanged;
