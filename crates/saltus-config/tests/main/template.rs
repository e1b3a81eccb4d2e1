//! The template, the round trip, and what the schema says.

use saltus_config::{
    AttractorsTable, Inertia, Modes, Parameter, Study, keys, paper_template, parse, schema,
};
use serde_json::Value;

#[test]
fn template_parses_to_the_papers_case() {
    assert_eq!(
        parse("template", &paper_template(), &[]).unwrap(),
        Study::paper()
    );
}

#[test]
fn template_names_every_key_but_alternatives_to_those_it_has() {
    let template = paper_template();
    for key in keys() {
        let name = key.rsplit('.').next().unwrap();
        let written = template
            .lines()
            .any(|line| line.split('=').next().unwrap().trim() == name);
        assert!(
            written || key == "base.frequency" || ["values", "times"].contains(&name),
            "{key} is not in the template"
        );
    }
}

#[test]
fn resolved_study_round_trips_to_the_same_bits() {
    let mut study = Study::paper();
    study.plate.length = 14.0 + f64::EPSILON * 8.0;
    study.plate.youngs_modulus = 1.0 / 3.0 * 1e11;
    study.jumper.push(study.jumper[0].clone());
    study.jumper[1].mass = 0.1 + 0.2;
    study.start.z = -0.0;
    study.solver.tolerance = 3e-13;
    study.plate.inertia = Inertia::Condensed;
    for modes in [
        "3x2",
        "paper",
        "{u = [[2, 1]], v = [], w = [[1, 1], [3, 1]]}",
    ] {
        let set = [format!("plate.modes={modes}")];
        let study = parse("first", &study.to_toml(), &set).unwrap();
        let again = parse("again", &study.to_toml(), &[]).unwrap();
        assert_eq!(again, study);
        assert_eq!(again.to_toml(), study.to_toml());
        assert_eq!(again.start.z.to_bits(), (-0.0_f64).to_bits());
        assert_eq!(
            again.jumper[1].mass.to_bits(),
            study.jumper[1].mass.to_bits()
        );
    }
}

#[test]
fn a_study_of_an_empty_plate_round_trips() {
    let sets = ["jumper=[]", "base.reference=plate"].map(str::to_owned);
    let study = parse("paper", &paper_template(), &sets).unwrap();
    assert!(study.jumper.is_empty());
    let sweep = study.sweep.as_ref().unwrap();
    let error = study
        .set(&sweep.parameter, sweep.axis().from())
        .unwrap_err();
    assert!(error.to_string().contains("no [[jumper]]"), "{error}");
    assert_eq!(parse("again", &study.to_toml(), &[]).unwrap(), study);
}

#[test]
fn tables_with_defaults_may_be_left_out() {
    let text = paper_template();
    let required = text.split("# All tables below").next().unwrap();
    let study = parse("short", required, &[]).unwrap();
    assert_eq!(
        study,
        Study {
            sweep: None,
            map: None,
            basins: None,
            continuation: None,
            attractors: AttractorsTable::default(),
            ..Study::paper()
        }
    );
}

#[test]
fn without_words_the_paper_decides() {
    let words = ["[contact]", "law =", "inertia ="];
    let plain = |line: &&str| !words.iter().any(|word| line.starts_with(word));
    let text = paper_template();
    let kept: Vec<&str> = text.lines().filter(plain).collect();
    assert_eq!(kept.len(), text.lines().count() - words.len());
    let study = parse("plain", &kept.join("\n"), &[]).unwrap();
    assert_eq!(study.contact, Study::paper().contact);
    assert_eq!(Study::paper().plate.inertia, Inertia::SlowManifold);
    assert_eq!(study.plate.inertia, Inertia::Full);
    // an empty table is as good as none
    let empty = parse("empty", &format!("{}\n[contact]", kept.join("\n")), &[]).unwrap();
    assert_eq!(empty, study);
}

#[test]
fn schema_describes_every_key_with_its_unit() {
    let schema = schema();
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    let keys = keys();
    assert_eq!(keys.len(), 101, "{keys:?}");
    for key in keys {
        let node = find(&schema, &key);
        let description = node["description"].as_str().unwrap_or_default();
        // a unit, or (-), or (a word): always in brackets
        assert!(
            description.contains('(') && description.contains(')'),
            "{key}: {description}"
        );
        let question = ["sweep.", "map.", "basins.", "continue.", "attractors."]
            .iter()
            .any(|t| key.starts_with(t));
        let physical = node["type"] == "number" && !question;
        for note in ["x-unit", "x-symbol", "x-label"] {
            assert!(!physical || node[note].is_string(), "{key} has no {note}");
        }
        if physical {
            let unit = node["x-unit"].as_str().unwrap();
            assert!(
                description.contains(&format!("({unit})")),
                "{key}: {description}"
            );
        }
    }
}

#[test]
fn schema_lists_the_words() {
    let words = |key: &str| -> Vec<String> {
        let schema = schema();
        let choices = find(&schema, key)["oneOf"].as_array().unwrap().clone();
        choices
            .iter()
            .map(|c| c["const"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(
        words("contact.law"),
        ["reaction-force", "gap", "relaxing-leg"]
    );
    assert_eq!(
        words("plate.inertia"),
        ["full", "slow-manifold", "condensed"]
    );
    assert_eq!(words("plate.basis"), ["fixed", "shear-free"]);
    assert_eq!(words("base.reference"), ["occupied", "free", "plate"]);
    assert_eq!(words("solver.method"), ["taylor", "rk4"]);
    assert_eq!(words("sweep.direction"), ["up", "down", "both", "restarts"]);
}

fn find<'a>(schema: &'a Value, key: &str) -> &'a Value {
    key.split('.').fold(schema, |at, name| {
        let at = at
            .get("items")
            .filter(|_| at["type"] == "array")
            .unwrap_or(at);
        &at["properties"][name]
    })
}

#[test]
fn study_becomes_physics() {
    let study = Study::paper();
    assert_eq!(study.plate(), saltus::physics::Plate::dias_del_prado());
    assert_eq!(
        study.jumpers(),
        [saltus::physics::Jumper::dias_del_prado(14.0, 10.0)]
    );
    assert_eq!(
        study.contact_law(),
        saltus::physics::ContactLaw::ReactionForce
    );
    assert_eq!(study.gravity(), 9.81);
    assert!(study.base().check().is_ok());
    let complete = Study {
        plate: saltus_config::PlateTable {
            modes: Modes::Complete { m: 2, n: 3 },
            ..study.plate
        },
        ..Study::paper()
    };
    assert_eq!(complete.plate().modes.w.len(), 6);
}

#[test]
fn a_parameter_has_a_label_and_changes_every_jumper_or_one() {
    let mut study = Study::paper();
    study.jumper.push(study.jumper[0].clone());
    let all = Parameter::parse("jumper.damping_ratio").unwrap();
    assert_eq!(all.label(), "damping ratio ζ_h (-)");
    let changed = all.apply(&study, 0.12).unwrap();
    assert_eq!(
        changed
            .jumper
            .iter()
            .map(|j| j.damping_ratio)
            .collect::<Vec<_>>(),
        [0.12, 0.12]
    );
    assert_eq!(all.value(&changed), Some(0.12));

    let one = Parameter::parse("jumper.1.mass").unwrap();
    assert_eq!(one.unit(), "kg");
    let changed = one.apply(&study, 80.0).unwrap();
    assert_eq!(
        changed.jumper.iter().map(|j| j.mass).collect::<Vec<_>>(),
        [76.64, 80.0]
    );
    assert_eq!(one.value(&changed), Some(80.0));
    assert!(
        one.apply(&Study::paper(), 80.0)
            .unwrap_err()
            .to_string()
            .contains("jumper.1")
    );
}

#[test]
fn a_parameter_refuses_what_the_file_would_refuse() {
    let study = Study::paper();
    for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300] {
        let error = study.set("plate.length", bad).unwrap_err();
        assert!(error.to_string().contains("plate.length"), "{error}");
    }
    for name in [
        "plate.modes",
        "plate",
        "",
        "plate.lenght",
        "sweep.from",
        "sweep.exponents",
        "map.x.from",
        "basins.y.to",
        "orbit.period",
        "lyapunov.exponents",
        "continue.from",
        "continue.step",
        "continue.second.to",
        "attractors.plate",
        "attractors.from",
        "jumper",
        "contact.law",
    ] {
        assert!(Parameter::parse(name).is_err(), "{name}");
    }
    let error = Parameter::parse("jumper.dampingratio").unwrap_err();
    assert_eq!(error.advice(), Some("did you mean jumper.damping_ratio?"));
}

#[test]
fn hertz_and_ratio_replace_each_other() {
    let hertz = Study::paper().set("base.frequency", 2.5).unwrap();
    assert_eq!(
        (hertz.base.frequency, hertz.base.frequency_ratio),
        (Some(2.5), None)
    );
    let ratio = hertz.set("base.frequency_ratio", 0.9).unwrap();
    assert_eq!(
        (ratio.base.frequency, ratio.base.frequency_ratio),
        (None, Some(0.9))
    );
}

#[test]
fn sweep_values_end_where_they_are_told_to() {
    let sweep = Study::paper().sweep.unwrap();
    let values = sweep.values();
    assert_eq!((values.len(), values[0], values[80]), (81, 0.1, 0.5));
    assert!(values.windows(2).all(|pair| pair[0] < pair[1]));
}
