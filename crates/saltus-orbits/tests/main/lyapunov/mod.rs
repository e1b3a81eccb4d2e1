//! Exponents, their errors, and what is made of them, on maps whose answers are known.

mod errors;
mod exponents;
mod flows;
mod maps;
mod natures;
