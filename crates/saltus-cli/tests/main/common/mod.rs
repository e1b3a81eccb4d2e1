//! Common parts of the tests: the program, and a desk to work at.

pub(crate) mod underway;

use assert_cmd::Command;
use std::fs;
use std::path::PathBuf;

pub(crate) fn saltus(args: &[&str]) -> Command {
    let mut command = Command::new(program());
    command.args(args).env_remove("NO_COLOR");
    command
}

pub(crate) fn program() -> &'static str {
    env!("CARGO_BIN_EXE_saltus")
}

/// A folder with the paper's study in it.
pub(crate) struct Desk {
    pub(crate) folder: tempfile::TempDir,
}

impl Desk {
    pub(crate) fn new() -> Self {
        let desk = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        saltus(&["init", "paper", "--out", desk.str("paper.toml").as_str()])
            .assert()
            .success()
            .stdout("");
        desk
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn str(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }

    pub(crate) fn paper(&self) -> String {
        self.str("paper.toml")
    }

    /// The names in the folder.
    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

pub(crate) fn json(command: &mut Command) -> serde_json::Value {
    // on a busy machine a test may be expected to take a minute
    let quiet = predicates::str::is_match("^(note: .*: about .*\n)?$").unwrap();
    let output = command.assert().success().stderr(quiet);
    serde_json::from_slice(&output.get_output().stdout).unwrap()
}

/// The files of a folder with their bytes, by name.
pub(crate) fn files(folder: &std::path::Path) -> std::collections::BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, fs::read(path).unwrap())
    });
    entries.collect()
}
