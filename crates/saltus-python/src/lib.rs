//! The native module of the Python package `saltus`: hands arrays in and out, and computes beside Python.
//!
//! The public interface is in `python/saltus`; items here are for that package alone.

mod answer;
mod colour;
mod error;
mod running;
mod saved;
mod study;
mod systems;

use pyo3::prelude::*;

/// The native side of saltus. Everything in it is reached through the package's own modules.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::answer::{Answer, Figure, ask, compute, pieces, program, read, write};
    #[pymodule_export]
    use crate::colour::{colour, colours, palette};
    #[pymodule_export]
    use crate::running::{count, shut_down};
    #[pymodule_export]
    use crate::saved::{cite, rerun};
    #[pymodule_export]
    use crate::study::{describe, load, paper, paper_template, parse, resolve, schema};
    #[pymodule_export]
    use crate::systems::{Exponents, Orbit, Program, Trajectories};

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
