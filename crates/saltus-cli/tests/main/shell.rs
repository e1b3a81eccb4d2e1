//! What a shell and its user are told of the grammar.

use crate::common::{Desk, saltus};
use predicates::prelude::*;
use predicates::str::contains;
use std::fs;
use std::process::Command;

#[test]
fn every_shell_has_a_script_that_knows_the_commands() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        saltus(&["completions", shell])
            .assert()
            .success()
            .stderr("")
            .stdout(contains("lyapunov").and(contains("threads")));
    }
    saltus(&["completions", "tcsh"])
        .assert()
        .code(2)
        .stderr(contains("possible values: bash, elvish, fish"));
}

#[cfg(unix)]
#[test]
fn bash_understands_its_script() {
    let desk = Desk::new();
    let script = saltus(&["completions", "bash"]).output().unwrap().stdout;
    fs::write(desk.path("saltus.bash"), script).unwrap();
    let complete = "source saltus.bash; COMP_WORDS=(saltus swe); COMP_CWORD=1; _saltus saltus swe saltus; \
                    echo ${COMPREPLY[@]}";
    for (args, said) in [(["-n", "saltus.bash"], ""), (["-c", complete], "sweep\n")] {
        let mut bash = Command::new("bash");
        let output = bash.args(args).current_dir(desk.str(".")).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty());
        assert_eq!(String::from_utf8(output.stdout).unwrap(), said);
    }
}

#[test]
fn the_manual_has_a_page_for_each_command() {
    let desk = Desk::new();
    let out = desk.str("man/man1");
    saltus(&["man", "--out", &out])
        .assert()
        .success()
        .stdout("");
    let page = |name: &str| fs::read_to_string(desk.path("man/man1").join(name)).unwrap();
    let main = page("saltus.1");
    saltus(&["man"])
        .assert()
        .success()
        .stderr("")
        .stdout(main.clone());
    for section in [
        "NAME",
        "SYNOPSIS",
        "DESCRIPTION",
        "OPTIONS",
        "SUBCOMMANDS",
        "VERSION",
    ] {
        assert!(main.contains(&format!(".SH {section}\n")), "{section}");
    }
    // what stands below the options of the help
    assert!(main.contains("Exit codes:"));
    let map = page("saltus-map.1");
    assert!(map.contains("\\-\\-resume") && map.contains("saltus\\-map"));
    assert!(map.contains("Finished pieces are kept"));
}

#[test]
fn a_folder_of_pages_that_cannot_be_made_ends_with_3() {
    let desk = Desk::new();
    saltus(&["man", "--out", &desk.paper()])
        .assert()
        .code(3)
        .stdout("")
        .stderr(contains("paper.toml"));
}

#[test]
fn a_command_that_is_nearly_one_is_guessed() {
    for (typed, meant) in [
        ("mann", "'man'"),
        ("complete", "'completions'"),
        ("mapp", "'map'"),
    ] {
        saltus(&[typed])
            .assert()
            .code(2)
            .stdout("")
            .stderr(contains("unrecognized subcommand").and(contains(meant)));
    }
}
