//! The paper, complete: every figure and statement of Dias & Del Prado, with our numbers beside it,
//! and what the paper does not show: other contact laws, full against condensed, the misprints' size.
//!
//! Every function takes an [`Effort`] and a [`saltus::study::Control`], and gives plain data: nothing here writes a file
//! or draws a figure. `saltus reproduce` makes pages of it.
//!
//! ```
//! // Eq. (10) as printed lets the floor pull at a person at rest.
//! let table = saltus_paper::misprints(&saltus::study::Control::default())?;
//! assert!(table.iter().any(|one| one.place == "Eq. (10)" && one.effect.contains("-751.8 N")));
//! # Ok::<(), saltus::study::StudyError>(())
//! ```

mod branches;
mod cases;
mod diagrams;
mod effort;
mod exponents;
mod facts;
mod inertia;
mod misprints;
mod parallel;
mod setting;
mod stretches;

pub use branches::{Detail, Drawn, PanelBranches, Transition, panel_branches};
pub use cases::{Case, CaseResult, cases, run_cases};
pub use diagrams::{Diagram, Met, diagrams};
pub use effort::Effort;
pub use exponents::{PanelExponents, panel_exponents};
pub use facts::{Fact, Verdict, facts};
pub use inertia::{InertiaComparison, InertiaRow, compare_inertia};
pub use misprints::{Misprint, misprints};
pub use setting::RATIOS;
pub use stretches::{Bound, Edge, Stretch};
