//! Integration tests: the paper's statements, by the numbers that `saltus reproduce` prints.
#![allow(clippy::unwrap_used)]

mod dias_del_prado;
