//! Every key, wrong in every way: a clear error that names key and line, or acceptance where that is right.

use saltus_config::{Study, StudyError, StudyErrorKind, keys, parse};

/// Keys for which zero is a legal value.
const ZERO_IS_FINE: &[&str] = &[
    "attractors.from",
    "attractors.plate",
    "attractors.to",
    "attractors.transient",
    "base.amplitude",
    "basins.exponent",
    "basins.transient",
    "basins.x.from",
    "basins.x.to",
    "basins.y.from",
    "basins.y.to",
    "continue.cloud",
    "continue.doublings",
    "continue.from",
    "continue.period",
    "continue.to",
    "continue.transient",
    "jumper.damping_ratio",
    "lyapunov.exponents",
    "lyapunov.transient",
    "map.exponent",
    "map.transient",
    "map.x.from", // of a damping ratio
    "map.x.to",
    "orbit.period",
    "orbit.segments",
    "orbit.transient",
    "plate.damping_ratio",
    "plate.poisson_ratio",
    "simulate.transient",
    "start.v",
    "start.z",
    "sweep.exponents",
    "sweep.from", // of a damping ratio
    "sweep.to",
    "sweep.transient",
];

/// Keys for which a negative value is legal.
const NEGATIVE_IS_FINE: &[&str] = &[
    "basins.x.from",
    "basins.x.to",
    "basins.y.from",
    "basins.y.to",
    "start.v",
    "start.z",
];

/// Keys that must be there; all others have a documented default.
const REQUIRED: &[&str] = &[
    "attractors.count",
    "attractors.from",
    "attractors.parameter",
    "attractors.to",
    "base.amplitude",
    "base.frequency_ratio", // or base.frequency
    "basins.x.count",
    "basins.x.from",
    "basins.x.parameter",
    "basins.x.to",
    "basins.y.count",
    "basins.y.from",
    "basins.y.parameter",
    "basins.y.to",
    "continue.from",
    "continue.parameter",
    "continue.second.from",
    "continue.second.parameter",
    "continue.second.to",
    "continue.to",
    "jumper.damping_ratio",
    "jumper.mass",
    "jumper.stiffness",
    "jumper.x",
    "jumper.y",
    "map.x.count",
    "map.x.from",
    "map.x.parameter",
    "map.x.to",
    "map.y.count",
    "map.y.from",
    "map.y.parameter",
    "map.y.to",
    "plate.damping_ratio",
    "plate.density",
    "plate.length",
    "plate.modes",
    "plate.poisson_ratio",
    "plate.thickness",
    "plate.width",
    "plate.youngs_modulus",
    "sweep.count",
    "sweep.from",
    "sweep.parameter",
    "sweep.to",
];

/// A study file in which every key stands on its own line.
struct Sheet {
    lines: Vec<String>,
}

impl Sheet {
    fn for_key(key: &str) -> Self {
        let mut study = Study::paper();
        if key == "base.frequency" {
            study.base.frequency = Some(2.5);
            study.base.frequency_ratio = None;
        }
        if let Some(table) = key.strip_suffix(".values") {
            list_values(&mut study, table);
        }
        if key == "simulate.times" {
            study.simulate.times = Some(vec![0.0, 0.5]);
        }
        Self {
            lines: study.to_toml().lines().map(str::to_owned).collect(),
        }
    }

    fn header(&self, key: &str) -> usize {
        let Some(table) = table_of(key) else { return 0 };
        self.lines
            .iter()
            .position(|l| *l == format!("[{table}]") || *l == format!("[[{table}]]"))
            .unwrap()
    }

    fn line_of(&self, key: &str) -> usize {
        let name = key.rsplit('.').next().unwrap();
        let start = self.header(key);
        let below = self.lines[start..]
            .iter()
            .position(|l| l.starts_with(&format!("{name} = ")))
            .unwrap();
        start + below
    }

    /// The file with the key's line replaced.
    fn with(&self, key: &str, line: &str) -> String {
        let mut lines = self.lines.clone();
        lines[self.line_of(key)] = line.to_owned();
        lines.join("\n")
    }
}

/// The key as an error names it: the file has one jumper.
fn named(key: &str) -> String {
    key.replace("jumper.", "jumper.0.")
}

/// The table that holds the key, if it is not the study itself.
fn table_of(key: &str) -> Option<&str> {
    Some(key.rsplit_once('.')?.0)
}

/// The same values, one by one.
fn list_values(study: &mut Study, table: &str) {
    let (map, basins) = (study.map.as_mut().unwrap(), study.basins.as_mut().unwrap());
    let axis = match table {
        "sweep" => {
            let sweep = study.sweep.as_mut().unwrap();
            sweep.values = Some(sweep.values());
            (sweep.from, sweep.to, sweep.count) = (None, None, None);
            return;
        }
        "attractors" => {
            let swept = &mut study.attractors;
            swept.values = swept.sweep().map(|axis| axis.values());
            (swept.from, swept.to, swept.count) = (None, None, None);
            return;
        }
        "map.x" => &mut map.x,
        "map.y" => &mut map.y,
        "basins.x" => &mut basins.x,
        _ => &mut basins.y,
    };
    axis.values = Some(axis.values());
    (axis.from, axis.to, axis.count) = (None, None, None);
}

fn name_of(key: &str) -> &str {
    key.rsplit('.').next().unwrap()
}

/// The values every key is tried with, and whether each is fine.
fn trials(key: &str) -> Vec<(&'static str, bool)> {
    let fine = |list: &[&str]| list.contains(&key);
    let whole = is_whole(key);
    let mut trials = vec![
        ("nan", false),
        ("-nan", false),
        ("inf", false),
        ("-inf", false),
        ("0", fine(ZERO_IS_FINE)),
        ("-3", fine(NEGATIVE_IS_FINE)),
        ("1e300", false),
        ("-1e300", false),
        ("9000000000000000", false),
        ("true", false),
        ("1979-05-27", false),
        (
            "[]",
            ["sweep.starts", "continue.second.curves"].contains(&key),
        ),
        ("[[1, \"a\"]]", false),
        ("[[1, 2, 3]]", false),
        ("{}", false),
        ("\"\"", false),
        ("\"much\"", false),
        ("'''\nmany\nlines\n'''", false),
    ];
    if !whole {
        trials.push(("-0.0", fine(ZERO_IS_FINE)));
    } else {
        trials.extend([("0.0", false), ("10.5", false), ("-0.0", false)]);
    }
    trials
}

fn is_whole(key: &str) -> bool {
    let whole = [
        "periods",
        "transient",
        "steps_per_period",
        "max_switches",
        "count",
        "record",
        "period",
        "segments",
        "exponent",
        "exponents",
        "exponent_periods",
        "history",
        "replicas",
        "samples_per_period",
        "points",
        "doublings",
        "cloud",
        "starts",
        "format",
    ];
    whole.contains(&name_of(key))
}

fn all(error: &StudyError) -> Vec<&StudyError> {
    std::iter::once(error).chain(error.others()).collect()
}

#[test]
fn every_bad_value_in_the_file_is_named_with_its_line() {
    for key in keys() {
        let sheet = Sheet::for_key(&key);
        for (value, fine) in trials(&key) {
            let text = sheet.with(&key, &format!("{} = {value}", name_of(&key)));
            let result = parse("study.toml", &text, &[]);
            if fine {
                assert!(result.is_ok(), "{key} = {value}: {}", result.unwrap_err());
                continue;
            }
            let error = result.expect_err(&format!("{key} = {value} was accepted"));
            let hit = all(&error)
                .into_iter()
                .find(|e| e.key().is_some_and(|k| k.starts_with(&named(&key))));
            let hit = hit.unwrap_or_else(|| panic!("{key} = {value}: {error}"));
            assert!(hit.to_string().contains(&named(&key)), "{hit}");
            assert_eq!(
                hit.line(),
                Some(sheet.line_of(&key) + 1),
                "{key} = {value}: {hit}"
            );
            assert!(
                hit.to_string().contains("needed") || hit.advice().is_some(),
                "{hit}"
            );
        }
    }
}

#[test]
fn every_bad_override_is_named() {
    for key in keys() {
        for (value, fine) in trials(&key) {
            let set = format!("{key}={value}");
            let result = parse(
                "study.toml",
                &Study::paper().to_toml(),
                std::slice::from_ref(&set),
            );
            if fine {
                assert!(result.is_ok(), "{set}: {}", result.unwrap_err());
                continue;
            }
            let error = result.expect_err(&format!("{set} was accepted"));
            assert!(
                error.to_string().starts_with(&format!("--set {set}")),
                "{error}"
            );
            assert!(error.key().unwrap().starts_with(&named(&key)), "{error}");
            assert_eq!(error.line(), None, "{error}");
        }
    }
}

#[test]
fn a_number_too_long_for_any_integer_is_shown_in_its_line() {
    for key in keys() {
        let sheet = Sheet::for_key(&key);
        let text = sheet.with(&key, &format!("{} = 1{}", name_of(&key), "0".repeat(40)));
        let error = parse("study.toml", &text, &[]).unwrap_err();
        assert_eq!(
            error.line(),
            Some(sheet.line_of(&key) + 1),
            "{key}: {error}"
        );
    }
}

#[test]
fn an_override_too_long_for_any_integer_is_out_of_range() {
    for (key, wanted) in [
        ("jumper.mass", "a number from"),
        ("simulate.periods", "a whole number from"),
    ] {
        for value in [
            "9223372036854775808",
            "-9223372036854775809",
            "1".repeat(40).as_str(),
        ] {
            let sets = [format!("{key}={value}")];
            let error = parse("paper.toml", &saltus_config::paper_template(), &sets).unwrap_err();
            let said = error.to_string();
            assert!(
                said.contains(wanted) && !said.contains("was given"),
                "{said}"
            );
        }
    }
}

#[test]
fn every_missing_key_is_named_with_its_table() {
    for key in keys() {
        let sheet = Sheet::for_key(&key);
        let result = parse("study.toml", &sheet.with(&key, ""), &[]);
        let instead = |key: &str| match key.strip_suffix(".values") {
            Some(table) => Some(format!("{table}.from")),
            None => (key == "base.frequency").then(|| "base.frequency_ratio".to_owned()),
        };
        if !REQUIRED.contains(&key.as_str()) && instead(&key).is_none() {
            assert!(result.is_ok(), "{key}: {}", result.unwrap_err());
            continue;
        }
        let error = result.expect_err(&format!("{key} is not required"));
        let expected = instead(&key).unwrap_or_else(|| named(&key));
        assert_eq!(error.kind(), StudyErrorKind::Key, "{error}");
        assert_eq!(error.key(), Some(expected.as_str()), "{error}");
        assert_eq!(error.line(), Some(sheet.header(&key) + 1), "{error}");
        assert!(error.to_string().contains("is missing"), "{error}");
        assert!(error.advice().unwrap().contains(name_of(&key)), "{error}");
    }
}

#[test]
fn every_misspelt_key_is_named_and_the_right_one_suggested() {
    for key in keys() {
        let sheet = Sheet::for_key(&key);
        let name = name_of(&key);
        for misspelt in [
            format!("{name}s"),
            format!("{name}{}", &name[name.len() - 1..]),
            name.to_uppercase(),
        ] {
            let line = sheet.lines[sheet.line_of(&key)].replacen(name, &misspelt, 1);
            let error = parse("study.toml", &sheet.with(&key, &line), &[]).expect_err(&misspelt);
            let hit = all(&error)
                .into_iter()
                .find(|e| e.to_string().starts_with("unknown key"))
                .unwrap();
            assert_eq!(hit.kind(), StudyErrorKind::Key);
            assert!(hit.to_string().contains(&misspelt), "{hit}");
            assert_eq!(hit.line(), Some(sheet.line_of(&key) + 1), "{hit}");
            let suggestion = format!("did you mean {}?", named(&key));
            assert!(
                hit.advice().unwrap().starts_with(&suggestion),
                "{misspelt}: {}",
                hit.advice().unwrap()
            );

            let table = table_of(&key).map_or_else(String::new, |table| format!("{table}."));
            let set = [format!("{table}{misspelt}=1")];
            let error = parse("study.toml", &sheet.lines.join("\n"), &set).unwrap_err();
            assert_eq!(error.kind(), StudyErrorKind::Override);
            assert_eq!(
                error.advice(),
                Some(format!("did you mean {key}?").as_str()),
                "{error}"
            );
        }
    }
}

#[test]
fn every_missing_table_is_named() {
    for table in ["plate", "base"] {
        let mut text = Study::paper().to_toml().parse::<toml::Table>().unwrap();
        text.remove(table);
        let error = parse("study.toml", &text.to_string(), &[]).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("study.toml: the table [{table}] is missing")
        );
    }
    let error = parse("empty.toml", "", &[]).unwrap_err();
    assert_eq!(error.others().len(), 1);
}

/// (what is done to the study, part of the message)
const CONTRADICTIONS: &[(&str, &str)] = &[
    (
        "jumper.x=14",
        "jumper.0.x = 14.0: outside the plate, 0 < x < plate.length = 14 m",
    ),
    ("jumper.y=10.5", "jumper.0.y = 10.5: outside the plate"),
    ("plate.thickness=12", "thinner than its shorter side, 10 m"),
    (
        "simulate.transient=100",
        "fewer than simulate.periods = 100",
    ),
    ("sweep.to=0.1", "different from sweep.from"),
    ("sweep.to=11", "jumper.0.damping_ratio = 11.0"),
    (
        "sweep.values=[0.1]",
        "2 to 100000 numbers are needed, 1 were",
    ),
    (
        "sweep.values=[0.1, 0.3, 0.2]",
        "sweep.values.2 = 0.2: a value above the one before it, 0.3",
    ),
    ("sweep.values=[0.1, nan]", "sweep.values.1 = nan"),
    (
        "sweep.values=[0.1, 11]",
        "sweep.values.1 = 11.0: jumper.0.damping_ratio = 11.0",
    ),
    (
        "map.x.values=[0.1, 0.1]",
        "different from the one before it, 0.1",
    ),
    (
        "basins.y.values=[2, 1, 3]",
        "basins.y.values.2 = 3.0: a value below the one before it, 1.0",
    ),
    ("attractors.values=[-1, 0.2]", "attractors.values.0 = -1.0"),
    (
        "simulate.times=[0.1, 0.1]",
        "simulate.times.1 = 0.1: a time after the one before it, 0.1",
    ),
    ("sweep.parameter=jumper.1.mass", "there is no jumper.1"),
    (
        "sweep.parameter=plate.modes",
        "not a key that holds a number",
    ),
    ("map.x.to=0.1", "different from map.x.from"),
    ("map.x.to=11", "jumper.0.damping_ratio = 11.0"),
    ("map.y.from=-1", "base.frequency_ratio = -1.0"),
    ("map.y.parameter=jumper.damping_ratio", "two different ones"),
    (
        "map.x.parameter=plate.modes",
        "not a key that holds a number",
    ),
    ("map.x.parameter=base.frequency", "two different ones"),
    ("map.x.parameter=start.z", "from the same [start]"),
    (
        "map.y.parameter=solver.tolerance",
        "not a part of the system",
    ),
    (
        "map.x.parameter=basins.x.from",
        "not a key that holds a number",
    ),
    (
        "basins.x.parameter=jumper.mass",
        "\"start.z\" or \"start.v\"",
    ),
    ("basins.y.parameter=start.z", "two different ones"),
    ("basins.y.to=1e7", "start.v = 10000000.0"),
    ("orbit.period=65", "a whole number from 0 to 64"),
    ("continue.to=0.1", "different from continue.from"),
    ("continue.to=11", "jumper.0.damping_ratio = 11.0"),
    (
        "continue.parameter=solver.tolerance",
        "not a part of the system",
    ),
    ("continue.parameter=start.z", "whatever the start is"),
    (
        "continue.parameter=attractors.plate",
        "not a key that holds a number",
    ),
    (
        "continue.parameter=base.frequency_ratio",
        "continue.parameter is the same",
    ),
    (
        "continue.second.to=0.85",
        "different from continue.second.from",
    ),
    ("continue.second.from=-1", "base.frequency_ratio = -1.0"),
    ("continue.second.parameter=start.v", "whatever the start is"),
    (
        "continue.second.curves=[\"PD1\", \"1\"]",
        "continue.second.curves.1 = \"1\"",
    ),
    ("continue.second.curves=[\"\"]", "a label such as"),
    ("attractors.z=[6, -2]", "[lowest, highest] is needed"),
    ("attractors.v=[0, 1e7]", "attractors.v.1"),
    ("attractors.z=[1, 2, 3]", "2 numbers are needed"),
    ("attractors.to=0.1", "different from attractors.from"),
    ("attractors.from=11", "jumper.0.damping_ratio = 11.0"),
    ("attractors.parameter=start.z", "drawn, not swept"),
    (
        "attractors.parameter=solver.tolerance",
        "not a part of the system",
    ),
    (
        "attractors.parameter=continue.step",
        "not a key that holds a number",
    ),
    ("jumper=[]", "has no body frequency"),
    ("plate.modes='0x3'", "from 1 to 400"),
    ("plate.modes=21x21", "from 1 to 400"),
    ("plate.modes=3by3", "\"3x3\""),
    (
        "plate.modes={ u = [], v = [], w = [] }",
        "at least one transverse term",
    ),
    (
        "plate.modes={ u = [[2, 0]], v = [], w = [[1, 1]] }",
        "half-wave numbers from 1 and 1",
    ),
    (
        "plate.modes={ u = [], v = [], w = [[1, 1], [1, 1]] }",
        "already in the list",
    ),
    (
        "plate.modes={ u = [], v = [], w = [[1, 1001]] }",
        "up to 1000",
    ),
    ("plate.modes={ u = [], v = [], w = [[1, -1]] }", "[1, -1]"),
    (
        "plate.modes={ u = [], w = [[1, 1]] }",
        "plate.modes.v is missing",
    ),
    (
        "plate.modes={ u = [], v = [], w = [[1, 1]], z = [] }",
        "unknown key plate.modes.z",
    ),
    ("plate.modes.w=[[1, 1]]", "set plate.modes itself"),
];

#[test]
fn keys_that_contradict_each_other_are_refused() {
    for (set, part) in CONTRADICTIONS {
        let error = parse(
            "study.toml",
            &Study::paper().to_toml(),
            &[(*set).to_owned()],
        )
        .expect_err(set);
        let said: Vec<String> = all(&error).iter().map(ToString::to_string).collect();
        assert!(said.iter().any(|s| s.contains(part)), "{set}: {said:?}");
    }
    let segments = ["orbit.period=2", "orbit.segments=3"].map(str::to_owned);
    let error = parse("study.toml", &Study::paper().to_toml(), &segments).unwrap_err();
    assert!(error.to_string().contains("orbit.period = 2"), "{error}");
    let relaxing = ["contact.law=relaxing-leg", "jumper.damping_ratio=0"].map(str::to_owned);
    let error = parse("study.toml", &Study::paper().to_toml(), &relaxing).unwrap_err();
    assert!(error.to_string().contains("relaxing-leg"), "{error}");
    let restarts = Study::paper().to_toml().replace("\"both\"", "\"restarts\"");
    let error = parse(
        "study.toml",
        &restarts[..restarts.find("starts =").unwrap()],
        &[],
    )
    .unwrap_err();
    assert!(
        error.to_string().contains("sweep.starts is missing"),
        "{error}"
    );
}

#[test]
fn a_cosine_may_have_no_half_wave() {
    let sets = [
        "plate.basis=shear-free",
        "plate.modes={ u = [[2, 0]], v = [[0, 2]], w = [[1, 1]] }",
    ];
    assert!(
        parse(
            "study.toml",
            &Study::paper().to_toml(),
            &sets.map(str::to_owned)
        )
        .is_ok()
    );
}

#[test]
fn ratio_and_hertz_exclude_each_other() {
    let paper = Study::paper().to_toml();
    let both = paper.replace(
        "frequency_ratio = 1.0",
        "frequency_ratio = 1.0\nfrequency = 2.5",
    );
    let error = parse("study.toml", &both, &[]).unwrap_err();
    assert_eq!(
        (error.key(), error.line()),
        (Some("base.frequency"), Some(28))
    );

    let over = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
        parse("study.toml", &paper, &sets)
    };
    let base = over(&["base.frequency=2.5"]).unwrap().base;
    assert_eq!((base.frequency, base.frequency_ratio), (Some(2.5), None));
    assert!(over(&["base.frequency=2.5", "base.frequency_ratio=0.9"]).is_err());
    assert_eq!(
        over(&["base.frequency_ratio=0.9"])
            .unwrap()
            .base
            .frequency_ratio,
        Some(0.9)
    );
}

/// (override, part of the message)
const MALFORMED: &[(&str, &str)] = &[
    ("", "no `=`"),
    ("jumper.mass", "no `=`"),
    ("=3", "no key"),
    ("plate..length=3", "no key"),
    ("plate.length=", "no value"),
    ("plate=3", "plate is a table"),
    ("jumper.0=3", "jumper.0 is a table"),
    ("jumper.1.mass=80", "there is no jumper.1; the study has 1"),
    ("jumper.99999999999999999999999.mass=80", "unknown key"),
    ("jumper.-1.mass=80", "unknown key"),
    ("mass=80", "unknown key mass"),
    ("plate.length.unit=3", "unknown key"),
];

#[test]
fn malformed_overrides_are_named() {
    for (set, part) in MALFORMED {
        let error = parse(
            "study.toml",
            &Study::paper().to_toml(),
            &[(*set).to_owned()],
        )
        .expect_err(set);
        assert_eq!(error.kind(), StudyErrorKind::Override, "{set}: {error}");
        assert!(
            error.to_string().starts_with(&format!("--set {set}: ")),
            "{error}"
        );
        assert!(error.to_string().contains(part), "{set}: {error}");
        assert!(error.advice().is_some(), "{set}");
    }
}

#[test]
fn overrides_set_every_jumper_or_one_and_the_last_wins() {
    let mut study = Study::paper();
    study.jumper.push(study.jumper[0].clone());
    let sets = [
        "jumper.mass=80",
        "jumper.1.mass=90",
        "start.z=4",
        "start.z=3",
        "contact.law=gap",
    ]
    .map(str::to_owned);
    let study = parse("study.toml", &study.to_toml(), &sets).unwrap();
    assert_eq!(
        study.jumper.iter().map(|j| j.mass).collect::<Vec<_>>(),
        [80.0, 90.0]
    );
    assert_eq!(study.start.z, 3.0);
}

/// (text, line)
const NOT_TOML: &[(&str, usize)] = &[
    ("[plate\n", 1),
    ("[plate]\nlength = 14.0 m\n", 2),
    ("[plate]\nlength = 1\nlength = 2\n", 3),
    ("[plate]\nlength =\n", 2),
    ("[plate]\n\n[plate]\n", 3),
    ("[plate]\nmodes = \"paper\n", 2),
    ("\u{0}", 1),
];

#[test]
fn text_that_is_not_toml_is_shown_with_its_line() {
    for (text, line) in NOT_TOML {
        let error = parse("study.toml", text, &[]).expect_err(text);
        assert_eq!(
            (error.kind(), error.line()),
            (StudyErrorKind::Syntax, Some(*line)),
            "{text:?}: {error}"
        );
        assert!(
            error
                .to_string()
                .starts_with(&format!("study.toml, line {line}: ")),
            "{error}"
        );
    }
    let deep = format!("a = {}", "[".repeat(100_000));
    assert_eq!(
        parse("deep.toml", &deep, &[]).unwrap_err().kind(),
        StudyErrorKind::Syntax
    );
}

#[test]
fn one_bracket_too_few_is_explained() {
    let text = Study::paper().to_toml().replace("[[jumper]]", "[jumper]");
    let error = parse("study.toml", &text, &[]).unwrap_err();
    assert!(
        error.advice().unwrap().starts_with("write [[jumper]]"),
        "{error}: {:?}",
        error.advice()
    );
}

#[test]
fn all_problems_of_a_file_are_told_at_once() {
    let text = Study::paper()
        .to_toml()
        .replace("length = 14.0", "lenght = 14.0")
        .replace("mass = 76.64", "mass = -1");
    let error = parse("study.toml", &text, &[]).unwrap_err();
    let said: Vec<&str> = all(&error)
        .into_iter()
        .filter_map(StudyError::key)
        .collect();
    assert_eq!(said, ["plate.lenght", "jumper.0.mass"]);
}
