//! The saltus program; all of it is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    saltus_cli::main(std::env::args_os()).into()
}
