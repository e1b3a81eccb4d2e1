//! Straight-line code for programs that occur often.
//!
//! The interpreter of `series.rs` spends more on finding its operands than on the multiply-adds. For
//! the shapes listed here the same program was written out as Rust by [`source`], with every index a
//! constant and intermediate results in registers; the numbers are still the system's own. It does
//! the same operations in the same order, so the result is the same to the bit, and a program of
//! any other shape is interpreted.

mod sums;
mod writer;

use crate::arith::Arith;
use crate::structure::Structure;

pub(crate) use writer::source;

macro_rules! shapes {
    ($($name:ident),*) => {
        $(
            // Written by `source`, and not by hand.
            #[rustfmt::skip]
            #[allow(clippy::all, unused_variables)]
            mod $name;
        )*

        /// A shape that is written out.
        #[allow(non_camel_case_types)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) enum Shape {
            $(#[doc = stringify!($name)] $name),*
        }

        impl Shape {
            /// The shape of a program, if it is one of these.
            pub(crate) fn of(structure: &Structure) -> Option<Self> {
                let key = writer::key(structure);
                $(if key == $name::KEY { return Some(Self::$name); })*
                None
            }

            /// Fills all orders, as the interpreter's `expand` does.
            #[inline(always)]
            pub(crate) fn expand<A: Arith>(self, arith: A, stream: &[A::Cell], kept: &mut [A::Cell]) {
                match self {
                    $(Self::$name => $name::expand(arith, stream, kept)),*
                }
            }

            /// Its source, as it is in this crate.
            pub(crate) fn written(self) -> &'static str {
                match self {
                    $(Self::$name => include_str!(concat!("special/", stringify!($name), ".rs"))),*
                }
            }
        }
    };
}

shapes!(
    condensed_4_1,
    condensed_4_1_gap,
    condensed_4_1_relaxing,
    condensed_4_1_tangent,
    slow_manifold_4_1
);
