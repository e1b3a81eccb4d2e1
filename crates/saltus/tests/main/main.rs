//! Integration tests: equations and studies, against closed forms and other programs.
#![allow(clippy::unwrap_used)]

mod attractors;
mod exponents;
mod independent;
mod lineages;
mod many_modes;
mod motion;
mod orbits;
mod plate_validation;
mod quadrature;
mod rigid_base;
mod rows;
mod slow_manifold;
mod specialised;
mod statistics;
mod tangent;
