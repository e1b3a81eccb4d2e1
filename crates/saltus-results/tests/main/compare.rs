//! Two results are the same to the bit, or their differences are reported with place and size.

use saltus_results::compare::{Difference, Outcome};
use saltus_results::{Comparison, Dataset, ResultFolder, Variable, compare};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Folders `a` and `b` with the given files.
struct Two(TempDir);

impl Two {
    fn new(a: &[(&str, &[u8])], b: &[(&str, &[u8])]) -> Self {
        let two = Self(tempfile::tempdir().unwrap());
        for (dir, files) in [(two.dir("a"), a), (two.dir("b"), b)] {
            let mut folder = ResultFolder::stage(&dir).unwrap();
            files
                .iter()
                .for_each(|(name, bytes)| folder.write(name, bytes).unwrap());
            folder.commit().unwrap();
        }
        two
    }

    fn dir(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn compare(&self) -> Comparison {
        compare(&self.dir("a"), &self.dir("b")).unwrap()
    }
}

/// Outcome for a file with the content `a` and `b`.
fn outcome(name: &str, a: &[u8], b: &[u8]) -> Outcome {
    let comparison = Two::new(&[(name, a)], &[(name, b)]).compare();
    assert_eq!(comparison.files[0].name, name);
    comparison.files[0].outcome.clone()
}

fn differences(name: &str, a: &[u8], b: &[u8]) -> Vec<Difference> {
    match outcome(name, a, b) {
        Outcome::Different { differences } => differences,
        other => panic!("{other:?}"),
    }
}

fn table(rows: &[&str]) -> Vec<u8> {
    format!("# mass (kg) = 75\nx,z,kind\n{}\n", rows.join("\n")).into_bytes()
}

#[test]
fn equal_results_are_the_same_to_the_bit() {
    let files: [(&str, &[u8]); 3] = [("a.csv", b"x\n1\n"), ("b/c.nc", b"?"), ("d", b"")];
    let comparison = Two::new(&files, &files).compare();
    assert!(comparison.identical());
    assert_eq!(comparison.text(), "All 4 files are the same to the bit.\n");
}

#[test]
fn files_are_missing_extra_or_drawn_differently() {
    let comparison = Two::new(
        &[
            ("gone", b""),
            ("f.svg", b"<svg/>"),
            ("same", b"1"),
            ("blob", b"\x00\xff"),
        ],
        &[
            ("f.svg", b"<svg />"),
            ("same", b"1"),
            ("new", b""),
            ("blob", b"\x01\xff"),
        ],
    )
    .compare();
    let text = "1 of 6 files are the same to the bit; the others:\n\
                gone: missing in the second result\n\
                f.svg: drawn differently\n\
                blob: other bytes\n\
                new: only in the second result\n\
                saltus-result.json: the same values, written differently\n";
    assert_eq!(comparison.text(), text);
    assert!(!comparison.identical());
    let json = serde_json::to_value(&comparison).unwrap();
    assert_eq!(json["files"][0]["name"], "gone");
    assert_eq!(json["files"][0]["outcome"], "missing");
}

#[test]
fn a_file_that_was_deleted_since_is_missing() {
    let two = Two::new(&[("a.csv", b"x\n1\n")], &[("a.csv", b"x\n1\n")]);
    std::fs::remove_file(two.dir("b").join("a.csv")).unwrap();
    assert_eq!(two.compare().files[0].outcome, Outcome::Missing);
    std::fs::rename(two.dir("a").join("a.csv"), two.dir("b").join("a.csv")).unwrap();
    assert_eq!(two.compare().files[0].outcome, Outcome::Extra);
}

#[test]
fn the_largest_difference_of_a_table_has_its_column_and_row() {
    let a = table(&["1.0,1e-6,flight", "2.0,NaN,flight", "4.0,3.0,flight"]);
    let b = table(&["1.0,3e-6,flight", "2.5,NaN,contact", "4.0,3.25,"]);
    let found = differences("t.csv", &a, &b);
    let [found] = &found[..] else {
        panic!("{found:?}")
    };
    // One setting, three names, nine cells.
    assert_eq!((found.compared, found.differing), (13, 5));
    let absolute = found.absolute.as_ref().unwrap();
    assert_eq!(
        (absolute.difference, absolute.place.as_str()),
        (0.5, "column `x`, row 2")
    );
    let relative = found.relative.as_ref().unwrap();
    assert_eq!(relative.place, "column `z`, row 1");
    // (3e-6 − 1e-6) / 3e-6, to rounding.
    assert!((relative.difference - 2.0 / 3.0).abs() < 1e-15);
    let first = found.first.as_ref().unwrap();
    assert_eq!(first.place, "column `kind`, row 2");
    assert_eq!(
        (first.first.as_str(), first.second.as_str()),
        ("flight", "contact")
    );
    let words = "5 of 13 values differ, at most by 5.0e-1 (column `x`, row 2: 2.0 and 2.5), relative to \
                 size at most by 6.7e-1 (column `z`, row 1: 1e-6 and 3e-6), at first not a number: \
                 column `kind`, row 2 is `flight` and `contact`";
    assert_eq!(found.to_string(), words);
}

#[test]
fn tables_may_differ_in_settings_header_and_length() {
    let first = |a: &str, b: &str| {
        let found = differences("t.csv", a.as_bytes(), b.as_bytes());
        let first = found[0].first.clone().unwrap();
        format!("{}: {} | {}", first.place, first.first, first.second)
    };
    assert_eq!(
        first("# a = x\nb\n1\n", "# a = y\nb\n1\n"),
        "setting 1: a = x | a = y"
    );
    assert_eq!(first("# a = x\nb\n", "b\n"), "setting 1: a = x | ");
    assert_eq!(
        first("a,b\n1,2\n", "a,c\n1,2\n"),
        "column 2 of the header: b | c"
    );
    assert_eq!(first("a\n1\n2\n3\n", "a\n1\n"), "the number of rows: 3 | 1");
    assert_eq!(first("a\n", "a\n1\n"), "the number of rows: 0 | 1");
    assert_eq!(first("a\n1\n", ""), "the number of rows: 1 | 0");
    assert_eq!(first("a\n1\n", "a\n1,2\n"), "column ``, row 1:  | 2");
    assert_eq!(
        first("a\n1.0\n", "a\nNaN\n"),
        "column `a`, row 1: 1.0 | NaN"
    );
    // Beyond 2^53 both are the same floating-point number.
    let big = first("a\n9007199254740993\n", "a\n9007199254740992\n");
    assert_eq!(
        big,
        "column `a`, row 1: 9007199254740993 | 9007199254740992"
    );
    assert_eq!(
        outcome("t.csv", b"a\n1\n", b"a\n\"1.0\"\n"),
        Outcome::WrittenDifferently
    );
}

#[test]
fn reports_differ_by_key() {
    let a = br#"{"a": {"z": [1, 2.5, null]}, "n": "x", "s": 18446744073709551615}"#;
    let b = br#"{"a": {"z": [1, 2.0, 7]}, "m": 1, "s": 18446744073709551614}"#;
    let found = differences("r.json", a, b);
    assert_eq!(found[0].differing, 5);
    assert_eq!(found[0].absolute.as_ref().unwrap().place, "a.z[1]");
    assert_eq!(found[0].first.as_ref().unwrap().place, "a.z[2]");
    let found = differences("r.json", br#"{"a": {"b": 1}}"#, br#"{"a": {}}"#);
    let first = found[0].first.as_ref().unwrap();
    assert_eq!(
        (first.place.as_str(), first.second.as_str()),
        ("a.b", "absent")
    );
    let same = outcome("r.json", br#"{"a": 1, "b": 2}"#, br#"{"b": 2.0, "a": 1}"#);
    assert_eq!(same, Outcome::WrittenDifferently);
}

#[test]
fn the_manifest_tells_another_version_or_request() {
    let two = Two::new(&[], &[]);
    let mut folder = ResultFolder::stage(&two.dir("b")).unwrap();
    folder.about(serde_json::json!({ "methods": ["JZ 2005"] }));
    folder.commit().unwrap();
    let text = two.compare().text();
    let words = "about.methods is `absent` and `[\"JZ 2005\"]`";
    assert!(text.contains(words), "{text}");
}

fn dataset(z: [f64; 6], label: &str, seed: i64, title: &str) -> Dataset {
    Dataset::new(title)
        .coordinate(Variable::coordinate("y", vec![1.0, 2.0]))
        .coordinate(Variable::coordinate("x", vec![1.0, 2.0, 3.0]))
        .variable(Variable::new("z", &["y", "x"], z.to_vec()))
        .variable(Variable::new("code", &["y"], vec![1_u8, 2]).flags([(1, "a"), (2, "b")]))
        .variable(Variable::new(
            "label",
            &["y"],
            vec!["same".to_owned(), label.to_owned()],
        ))
        .variable(Variable::new("seed", &[], vec![seed]))
}

#[test]
fn datasets_differ_by_variable_and_index() {
    let nan = f64::NAN;
    let a = dataset([0.0, 1.0, 2.0, nan, 4.0, 5.0], "chaos", i64::MAX, "one");
    let b = dataset([0.0, 1.0, 2.0, nan, 4.5, 5.0], "torus", i64::MAX - 1, "two")
        .variable(Variable::new("more", &["y"], vec![1.0, 2.0]));
    let found = differences(
        "m.nc",
        &a.clone().to_bytes().unwrap(),
        &b.to_bytes().unwrap(),
    );
    let said: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 4, "{said:#?}");
    assert!(
        said[0].contains("attribute `title` is `one` and `two`"),
        "{}",
        said[0]
    );
    let z = found.iter().find(|part| part.part == "z").unwrap();
    assert_eq!(z.absolute.as_ref().unwrap().place, "[1, 1]");
    assert_eq!(z.absolute.as_ref().unwrap().difference, 0.5);
    let label = found.iter().find(|part| part.part == "label").unwrap();
    assert_eq!(label.first.as_ref().unwrap().place, "[1]");
    let seed = found.iter().find(|part| part.part == "seed").unwrap();
    assert_eq!(
        seed.first.as_ref().unwrap().second,
        (i64::MAX - 1).to_string()
    );

    let shorter = Dataset::new("one").coordinate(Variable::coordinate("y", vec![1.0_f32]));
    let found = differences("m.nc", &a.to_bytes().unwrap(), &shorter.to_bytes().unwrap());
    assert_eq!(found[0].differing, 5, "variables that are gone");
    assert_eq!(found[1].first.as_ref().unwrap().place, "its shape");
}

#[test]
fn pages_differ_by_line() {
    let found = differences("index.html", b"<a>\nx\n", b"<a>\ny\nz\n");
    let words = "2 of 3 values differ, at first not a number: line 2 is `x` and `y`";
    assert_eq!(found[0].to_string(), words);
}

#[test]
fn what_cannot_be_read_is_told_and_nothing_breaks() {
    for (name, words) in [
        ("x.json", "not JSON"),
        ("x.nc", "not NetCDF-4"),
        ("x.md", "not a text"),
    ] {
        let text = outcome(name, b"\xff{", b"\xfe{").to_string();
        assert!(text.contains(words), "{text}");
    }
    outcome("x.csv", b"\xff\"{\n,,,\"", b"#\n#");
    let bytes = Dataset::new("one")
        .coordinate(Variable::coordinate("y", vec![1.0, 2.0]))
        .variable(Variable::new(
            "label",
            &["y"],
            vec!["a".to_owned(), "b".to_owned()],
        ));
    let bytes = bytes.to_bytes().unwrap();
    let two = Two::new(&[("x.nc", &bytes)], &[("x.nc", &bytes)]);
    let damaged = two.dir("b").join("x.nc");
    let write = |bytes: &[u8]| std::fs::write(&damaged, bytes).unwrap();
    for length in (0..bytes.len()).step_by(41) {
        write(&bytes[..length]);
        two.compare();
    }
    for place in (0..bytes.len()).step_by(4) {
        let mut altered = bytes.clone();
        altered[place] ^= [1, 0x80, 0xff][place / 4 % 3];
        write(&altered);
        assert_ne!(two.compare().files[0].outcome, Outcome::Identical);
    }
}

#[test]
fn what_is_no_result_is_refused() {
    let two = Two::new(&[], &[]);
    let error = compare(&two.dir("a"), Path::new("/nowhere")).unwrap_err();
    assert!(
        error.to_string().contains("there is no such folder"),
        "{error}"
    );
}
