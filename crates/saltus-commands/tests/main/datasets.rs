//! Data of answers: whole, every quantity in the help, and the same numbers in arrays, tables and documents. What
//! writers make of them is tested where those are.

use saltus_commands::{Request, RunContext};
use saltus_config::{Direction, Inertia, Law, Study};
use saltus_results::{Cells, Dataset, Document, Values};

/// The paper's study, with the condensed plate.
fn study(change: impl FnOnce(&mut Study)) -> Study {
    let mut study = Study::paper();
    study.plate.inertia = Inertia::Condensed;
    change(&mut study);
    study
}

fn two_people(study: &mut Study) {
    let mut other = study.jumper[0].clone();
    other.mass *= 1.5;
    other.damping_ratio = 0.4;
    study.jumper.push(other);
}

/// The data of an answer, which must be whole and described.
fn data(request: &Request, study: &Study) -> Dataset {
    let set = request.ask(study, &RunContext::default()).unwrap().data();
    assert!(set.clone().to_bytes().unwrap().starts_with(b"\x89HDF"));
    let document = serde_json::to_value(Document::new(&set)).unwrap();
    assert!(document.as_object().unwrap().len() > 3);
    all_are_in_the_help(request, &set);
    set
}

/// Each variable is a quantity of the command, that of one of several jumpers, or the values of a parameter.
fn all_are_in_the_help(request: &Request, set: &Dataset) {
    let known: Vec<&str> = request.quantities().iter().map(|q| q.name).collect();
    let told = |name: &str| {
        let number = |c: char| c.is_ascii_digit() || c == '_';
        known.contains(&name) || known.contains(&name.trim_end_matches(number))
    };
    for variable in set.variables() {
        let name = variable.name();
        let of_parameter = variable.attributes().iter().any(|a| a.0 == "study_key");
        assert!(
            told(name) || of_parameter,
            "`{name}` is not in the help of `{}`",
            request.name()
        );
        assert!(!variable.long_name_text().is_empty(), "{name}");
    }
}

/// A column of the file of a table.
fn cells(set: &Dataset, table: &str, title: &str) -> Cells {
    let mut tables = set.tables().iter();
    let found = tables.find(|known| known.is_file() && known.name() == table);
    let columns = found.expect(table).to_columns(set).unwrap();
    let column = columns.into_iter().find(|column| column.title == title);
    column.expect(title).cells
}

fn column(set: &Dataset, table: &str, title: &str) -> Vec<f64> {
    match cells(set, table, title) {
        Cells::F64(values) => values,
        Cells::I64(values) => values.into_iter().map(|value| value as f64).collect(),
        other => panic!("{other:?}"),
    }
}

/// Rows in the file of a table.
fn rows(set: &Dataset, name: &str) -> usize {
    let mut tables = set.tables().iter();
    let table = tables.find(|table| table.is_file() && table.name() == name);
    let columns = table.expect(name).to_columns(set).unwrap();
    match &columns[0].cells {
        Cells::F64(cells) => cells.len(),
        Cells::I64(cells) => cells.len(),
        Cells::Text(cells) => cells.len(),
        other => panic!("{other:?}"),
    }
}

/// An array with its lengths.
struct Array<'a> {
    lengths: Vec<usize>,
    values: &'a Values,
}

impl Array<'_> {
    /// One value; whole numbers as they are.
    fn at(&self, place: &[usize]) -> f64 {
        assert_eq!(place.len(), self.lengths.len());
        let place = place.iter().zip(&self.lengths);
        let place = place.fold(0, |sum, (&at, &length)| sum * length + at);
        match self.values {
            Values::F64(values) => values[place],
            Values::I32(values) => values[place].into(),
            Values::U8(values) => values[place].into(),
            _ => panic!("no numbers"),
        }
    }
}

fn array<'a>(dataset: &'a Dataset, name: &str) -> Array<'a> {
    let variable = dataset.get(name).expect(name);
    let length = |dimension| {
        let known = dataset.dimensions().iter().find(|(n, _)| n == dimension);
        known.expect("a dimension").1
    };
    Array {
        lengths: variable.dimensions().iter().map(length).collect(),
        values: variable.values(),
    }
}

fn assert_same(found: f64, expected: f64) {
    let same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
    assert!(same, "{found:?} and not {expected:?}");
}

#[test]
fn a_sweep_is_a_block_with_every_row_at_its_value() {
    // a leg without a damper cannot relax: the first value has no model
    let study = study(|study| {
        two_people(study);
        study.contact.law = Law::RelaxingLeg;
        let sweep = study.sweep.as_mut().unwrap();
        (sweep.from, sweep.to, sweep.count) = (Some(0.0), Some(0.4), Some(3));
        (sweep.transient, sweep.record) = (6, 4);
        sweep.direction = Direction::Both;
    });
    let set = data(&Request::Sweep, &study);
    let z = array(&set, "z");
    assert_eq!(z.lengths, [2, 3, 2, 4]);
    assert_eq!(rows(&set, "sweep"), 2 * 2 * 2 * 4);
    assert_eq!(rows(&set, "rows"), 2 * 3 * 2);
    let (status, label) = (array(&set, "status"), array(&set, "label"));
    let ratio = array(&set, "contact_ratio");
    for pass in 0..2 {
        assert!(z.at(&[pass, 0, 1, 3]).is_nan() && ratio.at(&[pass, 0, 1]).is_nan());
        assert_eq!((status.at(&[pass, 0]), label.at(&[pass, 0])), (4.0, 0.0));
        assert!(z.at(&[pass, 1, 1, 3]).is_finite() && ratio.at(&[pass, 1, 1]).is_finite());
        assert_eq!(status.at(&[pass, 1]), 0.0);
        assert!(label.at(&[pass, 1]) > 0.0);
    }
    let Values::Text(texts) = array(&set, "status_text").values else {
        panic!("sentences are texts");
    };
    assert!(
        texts[0].contains("damp") && texts[1] == "completed",
        "{texts:?}"
    );
    assert_eq!(set.get("status").unwrap().flag_meanings()[4].1, "no-model");
}

#[test]
fn a_motion_of_nobody_one_or_two_is_one_of_arrays() {
    for people in 0..3 {
        let study = study(|study| {
            two_people(study);
            study.jumper.truncate(people);
            study.base.frequency_ratio = None;
            study.base.frequency = Some(2.5);
            study.simulate.periods = 3;
        });
        let set = data(&Request::Simulate, &study);
        let z = array(&set, "z");
        assert_eq!(z.lengths, [3, people]);
        for jumper in 0..people {
            let name = if people == 1 {
                "z".to_owned()
            } else {
                format!("z_{jumper}")
            };
            for (period, &expected) in column(&set, "section", &name).iter().enumerate() {
                assert_same(z.at(&[period, jumper]), expected);
            }
        }
        let (m, n, w) = (array(&set, "m"), array(&set, "n"), array(&set, "w"));
        assert_eq!(w.lengths, [3, 4]);
        for term in 0..4 {
            let name = format!("w_{}_{}", m.at(&[term]), n.at(&[term]));
            assert_same(w.at(&[2, term]), column(&set, "section", &name)[2]);
        }
        let floor = array(&set, "history_floor");
        assert_eq!(floor.lengths, [rows(&set, "history"), people]);
        assert_eq!(array(&set, "switch_time").lengths, [rows(&set, "switches")]);
        assert_same(
            array(&set, "energy_base").at(&[1]),
            column(&set, "energy", "base")[1],
        );
    }
}

#[test]
fn branches_are_points_one_after_the_other() {
    let study = study(|study| {
        study.base.frequency_ratio = Some(0.9);
        let table = study.continuation.as_mut().unwrap();
        (table.from, table.to, table.cloud) = (0.15, 0.35, 2);
        table.second = None;
    });
    let set = data(
        &Request::Continue {
            origin: None,
            over: None,
        },
        &study,
    );
    let (z, period) = (array(&set, "z"), array(&set, "period"));
    let texts = |name| match array(&set, name).values {
        Values::Text(texts) => texts.clone(),
        other => panic!("{other:?}"),
    };
    let branch = array(&set, "branch");
    let last = |array: &Array| array.at(&[z.lengths[0] - 1]);
    let places = (0..z.lengths[0]).map(|point| period.at(&[point]) as usize);
    assert_eq!(
        ["branches", "ends"].map(|name| rows(&set, name)),
        [places.sum(), last(&branch) as usize + 1]
    );
    // the branch of Fig. 2a doubles at 0.1893, and period 1 has no second place
    assert_eq!(texts("special_label"), ["PD1"]);
    assert_eq!(texts("branch_origin"), ["", "PD1"]);
    assert!(texts("special_remark")[0].is_empty() && !texts("special_sequence")[0].is_empty());
    assert_eq!((z.lengths[1], last(&period)), (2, 2.0));
    assert!(z.at(&[0, 0, 0]).is_finite() && z.at(&[0, 1, 0]).is_nan());
    let (x, modes) = (array(&set, "special_x"), array(&set, "special_modes"));
    assert_eq!(x.lengths[..2], [1, 2]);
    for state in 0..x.lengths[2] {
        assert!(x.at(&[0, 0, state]).is_finite() && x.at(&[0, 1, state]).is_nan());
    }
    assert!(modes.at(&[0, 0, 0]) >= 0.0 && modes.at(&[0, 1, 0]) < 0.0);
}

#[test]
fn basins_have_a_row_for_each_sample_and_one_for_a_motion_without() {
    let study = study(|study| {
        // DP Fig. 2b: chaotic at 0.12
        study.jumper[0].damping_ratio = 0.12;
        let table = study.basins.as_mut().unwrap();
        (table.transient, table.record, table.exponent) = (60, 8, 0);
        table.x.count = Some(3);
        table.y.count = Some(3);
    });
    let set = data(&Request::Basins { matched: false }, &study);
    let (period, z) = (array(&set, "attractor_period"), array(&set, "attractor_z"));
    let periods = (0..period.lengths[0]).map(|place| period.at(&[place]) as usize);
    let periods: Vec<usize> = periods.collect();
    assert!(periods.contains(&0), "{periods:?}");
    let samples = periods.iter().map(|&period| period.max(1));
    assert_eq!(rows(&set, "attractors"), samples.sum::<usize>());
    for (place, &period) in periods.iter().enumerate() {
        for sample in 0..z.lengths[2] {
            assert_eq!(z.at(&[place, 0, sample]).is_nan(), sample >= period);
        }
    }
    let (status, pixels) = (array(&set, "status"), array(&set, "outcome_pixels"));
    assert_eq!(status.lengths, [3, 3]);
    assert_eq!(pixels.lengths, [10]);
}

#[test]
fn attractors_are_numbers_over_value_and_attractor() {
    let study = study(|study| {
        study.attractors.count = Some(2);
        study.attractors.starts = 4;
    });
    let set = data(&Request::Attractors, &study);
    let (share, kind) = (array(&set, "share"), array(&set, "kind"));
    let [values, attractors] = share.lengths[..] else {
        panic!("{:?}", share.lengths);
    };
    let mut met = 0;
    for value in 0..values {
        let all = ["undecided", "lost"].map(|name| array(&set, name).at(&[value]));
        let mut all = all[0] + all[1];
        for place in (0..attractors).map(|attractor| [value, attractor]) {
            assert_eq!(share.at(&place).is_nan(), kind.at(&place) == 0.0);
            if kind.at(&place) > 0.0 {
                all += share.at(&place);
                met += 1;
            }
        }
        assert!((all - 1.0).abs() < 1e-12, "{all}");
    }
    assert_eq!(set.get("kind").unwrap().flag_meanings()[1].1, "periodic");
    let z = array(&set, "z");
    assert_eq!(z.lengths[..2], [met, 1]);
    assert_eq!(array(&set, "motion_attractor").lengths, [met]);
    let Values::F64(all) = z.values else {
        panic!("heights are numbers");
    };
    let samples = all.iter().filter(|z| !z.is_nan()).count();
    assert_eq!(
        ["attractors", "sections", "ranges", "rows"].map(|name| rows(&set, name)),
        [met, samples, attractors, values]
    );
    for name in ["first", "birth_high", "death_to"] {
        assert_eq!(array(&set, name).lengths, [attractors], "{name}");
    }
}

#[test]
fn an_orbit_its_exponents_and_the_frequencies_are_arrays_too() {
    let study = study(|study| {
        study.base.frequency_ratio = Some(0.9);
        study.jumper[0].damping_ratio = 0.45;
        (study.lyapunov.transient, study.lyapunov.periods) = (20, 30);
        study.lyapunov.exponents = 2;
    });
    let set = data(&Request::Orbit, &study);
    let modulus = column(&set, "multipliers", "modulus");
    assert_same(array(&set, "multiplier_modulus").at(&[9]), modulus[9]);
    assert_same(
        array(&set, "z").at(&[0, 0]),
        column(&set, "section", "z")[0],
    );
    let set = data(&Request::Lyapunov, &study);
    let running = array(&set, "running_exponent");
    let last = column(&set, "convergence", "exponent_2");
    for (row, &expected) in last.iter().enumerate() {
        assert_same(running.at(&[row, 1]), expected);
    }
    let set = data(&Request::Frequencies, &study);
    // DP section 3 prints 2.297 Hz
    assert!((array(&set, "plate").at(&[0]) - 2.297).abs() < 5e-4);
    assert!(array(&set, "body").lengths.is_empty());
}
