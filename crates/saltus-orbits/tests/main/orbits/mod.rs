//! Orbits, branches and curves of maps whose answers are known by formula.

mod branches;
mod curves;
mod find;
mod grazing;
mod maps;
