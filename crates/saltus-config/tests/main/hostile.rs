//! Studies that nobody wrote as one: the messages stay few, short and fit for a terminal, and name cause and cure.

use saltus_config::{Study, StudyError, StudyErrorKind, paper_template, parse, read};
use std::fmt::Write as _;

fn refused(text: &str) -> StudyError {
    parse("study.toml", text, &[]).unwrap_err()
}

/// The first problem and the others.
fn all(error: &StudyError) -> Vec<&StudyError> {
    std::iter::once(error).chain(error.others()).collect()
}

/// The paper's study with so many people.
fn crowd(people: usize) -> String {
    let jumper =
        "\n[[jumper]]\nx = 7.0\ny = 5.0\nmass = 76.64\nstiffness = 18600.0\ndamping_ratio = 0.3\n";
    paper_template() + &jumper.repeat(people - 1)
}

#[test]
fn four_hundred_people_are_taken_and_more_are_counted() {
    assert_eq!(
        parse("study.toml", &crowd(400), &[]).unwrap().jumper.len(),
        400
    );
    for people in [401, 20_000] {
        let error = refused(&crowd(people));
        let words = format!("jumper: {people} were given, at most 400 are possible");
        assert_eq!(error.to_string(), words);
        assert_eq!(
            (error.key(), error.others().len()),
            (Some("jumper"), 0),
            "{error}"
        );
    }
    let mut study = Study::paper();
    study.jumper = vec![study.jumper[0].clone(); 401];
    let error = study.validate().unwrap_err();
    assert!(error.to_string().contains("at most 400"), "{error}");
    assert!(Study::from_json(&study.to_json(), &[]).is_err());
}

#[test]
fn of_many_problems_the_first_twenty_are_told_and_the_others_counted() {
    let text = paper_template();
    let lines = text.lines().count();
    for many in [21, 10_000] {
        let mut text = text.clone();
        for table in 0..many {
            writeln!(text, "[t{table}]").unwrap();
        }
        let error = refused(&text);
        let told = all(&error);
        assert_eq!(told.len(), 21);
        for one in &told[..20] {
            assert!(one.to_string().starts_with("unknown key t"), "{one}");
            assert!(one.line() > Some(lines), "{one}");
        }
        assert!(
            told.windows(2)
                .take(19)
                .all(|pair| pair[0].line() < pair[1].line())
        );
        assert_eq!(told[20].to_string(), format!("and {} more", many - 20));
    }
    // one fewer is no list with an end
    let some: String = (0..20).map(|table| format!("[t{table}]\n")).collect();
    assert_eq!(all(&refused(&(text + &some))).len(), 20);
}

#[test]
fn no_message_holds_what_a_terminal_obeys() {
    let paper = paper_template();
    let keys = ["\\u001b]0;pwned\\u0007", "a\\nb", "\\u009b31m", "\\u202e"];
    let mut errors: Vec<StudyError> = keys
        .iter()
        .map(|key| refused(&format!("{paper}\"{key}\" = 1\n")))
        .collect();
    // raw in a comment, which TOML does not allow
    errors.push(refused(&format!("# \u{1b}[31m\n{paper}")));
    errors.push(parse("\u{1b}[31m\n.toml", "[", &[]).unwrap_err());
    errors.push(parse("x", &paper, &["\u{1b}[31m=1".to_owned()]).unwrap_err());
    errors.push(Study::from_json("{\"\\u001b[31m\": {\"\\n\": null}}", &[]).unwrap_err());
    for error in &errors {
        for one in all(error) {
            let mut text = one.to_string() + one.key().unwrap_or_default();
            text += one.advice().unwrap_or_default();
            assert!(!text.contains(char::is_control), "{text:?}");
            assert!(!text.contains('\u{202e}'), "{text:?}");
            let source = miette::Diagnostic::source_code(one);
            let read = source.map(|s| s.read_span(&(0, 0).into(), 0, 9).unwrap().data().to_vec());
            let shown = String::from_utf8(read.unwrap_or_default()).unwrap();
            let obeyed = |c: char| c.is_control() && c != '\n';
            assert!(!shown.contains(obeyed), "{shown:?}");
        }
    }
    assert!(errors[0].to_string().contains("\\u{1b}]0;pwned\\u{7}"));
    assert!(errors[1].to_string().contains("a\\nb"));
}

#[test]
fn a_file_in_another_encoding_is_told_which_and_what_to_do() {
    let paper = paper_template();
    let pairs = |bytes: fn(u16) -> [u8; 2]| paper.encode_utf16().flat_map(bytes).collect();
    let [little, big]: [Vec<u8>; 2] = [pairs(u16::to_le_bytes), pairs(u16::to_be_bytes)];
    let marked = |mark: &[u8], text: &[u8]| [mark, text].concat();
    let letters = paper.chars().flat_map(|c| u32::from(c).to_le_bytes());
    for (bytes, encoding) in [
        (marked(&[0xff, 0xfe], &little), "UTF-16"),
        (marked(&[0xfe, 0xff], &big), "UTF-16"),
        (little, "UTF-16"),
        (big, "UTF-16"),
        (letters.collect(), "UTF-32"),
    ] {
        let error = read("study.toml", &bytes[..], &[]).unwrap_err();
        assert_eq!(error.kind(), StudyErrorKind::Unreadable);
        let said = error.to_string();
        assert!(
            said.contains(encoding) && said.contains("PowerShell"),
            "{said}"
        );
        assert!(error.advice().unwrap().contains("UTF-8"));
    }
    // its own mark is no fault
    let marked = marked("\u{feff}".as_bytes(), paper.as_bytes());
    assert!(read("study.toml", &marked[..], &[]).is_ok());
}

#[test]
fn wrong_brackets_are_told_and_the_right_ones() {
    let paper = paper_template();
    let single = paper.replace("[[jumper]]", "[jumper]");
    let mass = ["jumper.mass=80".to_owned()];
    let second = "[jumper]\nx = 1.0\n";
    for error in [
        refused(&single),
        parse("study.toml", &single, &mass).unwrap_err(),
        refused(&format!("{single}{second}")),
        refused(&format!("{paper}{second}")),
        Study::from_json("{\"jumper\": {\"x\": 7.0}}", &[]).unwrap_err(),
    ] {
        let told = all(&error);
        let brackets = |one: &&StudyError| {
            one.to_string().contains("[[jumper]]") || one.advice().unwrap().contains("[[jumper]]")
        };
        assert!(told.iter().any(brackets), "{error}");
    }
    let said = refused(&single).to_string();
    assert_eq!(
        said,
        "jumper is one table, [jumper], and must be a list of them"
    );
    for (wrong, right) in [("[[plate]]", "[plate]"), ("[[map.x]]", "[map.x]")] {
        let error = refused(&paper.replace(right, wrong));
        assert!(error.to_string().contains(wrong), "{error}");
        assert!(error.advice().unwrap().contains(right), "{error}");
    }
}
