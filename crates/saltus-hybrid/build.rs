//! Says whether the engine is compiled without optimisation.
//!
//! Its inner functions are inlined into each other, by force, so that a whole step knows the instruction set it
//! runs on. Unoptimised code keeps every intermediate value of such a function on the stack: megabytes of
//! it. There they stay functions, as in `#[cfg_attr(not(unoptimised), inline(always))]`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(unoptimised)");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level == "0") {
        println!("cargo::rustc-cfg=unoptimised");
    }
}
