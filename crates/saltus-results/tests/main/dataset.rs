//! Datasets come back to the bit, equal datasets are equal bytes, and misfits are named.

use hdf5_reader::Hdf5File;
use hdf5_reader::messages::datatype::{Datatype, StringSize, VarLenKind};
use saltus_results::{Attribute, Dataset, ResultFolder, ResultsError, Values, Variable};
use std::fmt::Write as _;
use std::process::Command;

const STUDY: &str = "[jumper.0]\ndamping_ratio = 0.3 # ζ_h\n";

fn reals() -> Vec<f64> {
    let mut values = vec![
        0.1,
        -0.0,
        1.0 / 3.0,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        f64::INFINITY,
        f64::NAN,
    ];
    values.extend((8..1200).map(|i| f64::from(i).sqrt()));
    values
}

fn texts<T: Into<String>>(texts: impl IntoIterator<Item = T>) -> Values {
    Values::Text(texts.into_iter().map(Into::into).collect())
}

/// Every type, one to three dimensions, small arrays and compressed ones, short and long texts.
fn arrays() -> Vec<(&'static str, Vec<&'static str>, Values)> {
    let reals = reals();
    vec![
        ("zeta", vec!["zeta"], vec![0.1, 0.2, 0.3].into()),
        (
            "ratio",
            vec!["ratio"],
            (0..400)
                .map(|i| 0.9 + 5e-4 * f64::from(i))
                .collect::<Vec<_>>()
                .into(),
        ),
        ("layer", vec!["layer"], vec![3_i32, -1].into()),
        ("real", vec!["zeta", "ratio"], reals.clone().into()),
        (
            "single",
            vec!["zeta", "ratio"],
            reals.iter().map(|&v| v as f32).collect::<Vec<_>>().into(),
        ),
        (
            "whole",
            vec!["ratio", "zeta"],
            (0..1200)
                .map(|i| i * 7_777_777 % i32::MAX)
                .collect::<Vec<_>>()
                .into(),
        ),
        (
            "cube",
            vec!["layer", "zeta", "ratio"],
            (0..2400_u16).collect::<Vec<_>>().into(),
        ),
        (
            "period",
            vec!["zeta", "ratio"],
            (0..1200).map(|i| (i % 4) as u8).collect::<Vec<_>>().into(),
        ),
        ("seeds", vec!["seed"], (0..5_u8).collect::<Vec<_>>().into()),
        ("long", vec!["zeta"], vec![i64::MIN, 1 << 60, -1].into()),
        (
            "settled",
            vec!["layer", "zeta"],
            vec![true, false, true, true, false, false].into(),
        ),
        (
            "label",
            vec!["zeta"],
            texts(["period 1", "", "ζ_h, \"chaos\""]),
        ),
        ("place", vec!["place"], texts(["plate", "body"])),
        (
            "many",
            vec!["ratio"],
            texts((0..400).map(|i| "s".repeat(i % 9))),
        ),
        ("frequency", vec![], 2.297.into()),
        ("title", vec![], texts(["one"])),
        ("switch", vec!["switch"], Vec::<f64>::new().into()),
        ("mode", vec!["switch"], Vec::<i32>::new().into()),
        ("who", vec!["switch", "place"], texts::<String>([])),
        ("force", vec!["switch", "ratio"], Vec::<f64>::new().into()),
        ("none", vec!["nothing"], Vec::<bool>::new().into()),
    ]
}

fn dataset() -> Dataset {
    let mut dataset = Dataset::new("Attractors")
        .dimension("seed", 5)
        .dimension("nothing", 0);
    for (name, dimensions, values) in arrays() {
        let variable = Variable::new(name, &dimensions, values).units("1");
        dataset = match name {
            "zeta" | "ratio" | "layer" | "place" | "switch" => {
                dataset.coordinate(variable.long_name(format!("The {name}")))
            }
            "period" => dataset.variable(variable.flags([
                (0, "not periodic"),
                (1, "period_1"),
                (2, "period_2"),
                (3, "period_3"),
            ])),
            _ => dataset.variable(variable),
        };
    }
    dataset
        .attribute("study", STUDY)
        .attribute("long", "ζ".repeat(60_000))
        .attribute("accuracy", 1e-12)
        .attribute("seed", 7)
        .attribute("limits", vec![0.5, 2.5])
}

fn little_endian(values: &Values) -> (&'static str, Vec<u8>) {
    match values {
        Values::F64(v) => ("float64", v.iter().flat_map(|v| v.to_le_bytes()).collect()),
        Values::F32(v) => ("float32", v.iter().flat_map(|v| v.to_le_bytes()).collect()),
        Values::I32(v) => ("int32", v.iter().flat_map(|v| v.to_le_bytes()).collect()),
        Values::U16(v) => ("uint16", v.iter().flat_map(|v| v.to_le_bytes()).collect()),
        Values::U8(v) => ("uint8", v.clone()),
        Values::I64(v) => ("int64", v.iter().flat_map(|v| v.to_le_bytes()).collect()),
        Values::Bool(v) => ("bool", v.iter().map(|&v| v.into()).collect()),
        _ => panic!("a type this test does not know"),
    }
}

#[test]
fn values_come_back_to_the_bit() {
    let file = Hdf5File::from_bytes(&dataset().to_bytes().unwrap()).unwrap();
    for (name, dimensions, values) in arrays() {
        let array = file.dataset(name).unwrap();
        if let Values::Text(texts) = &values {
            assert_eq!(&array.read_strings().unwrap(), texts, "{name}");
        } else {
            let bytes = little_endian(&values).1;
            assert_eq!(array.read_raw_bytes().unwrap(), bytes, "{name}");
        }
        let length = |dimension: &str| match dimension {
            "zeta" => 3,
            "ratio" => 400,
            "layer" | "place" => 2,
            "switch" | "nothing" => 0,
            _ => 5,
        };
        let shape: Vec<u64> = dimensions.iter().map(|&name| length(name)).collect();
        assert_eq!(array.shape(), shape, "{name}");
        assert_eq!(
            array.attribute("units").unwrap().read_string().unwrap(),
            "1",
            "{name}"
        );
        let link = match &dimensions[..] {
            [] => continue,
            [only] if *only == name => "CLASS",
            _ => "DIMENSION_LIST",
        };
        assert!(array.attribute(link).is_ok(), "{name} has no {link}");
    }
}

#[test]
fn a_file_reads_back_as_the_dataset_that_it_was_made_of() {
    let made = dataset().variable(
        Variable::new("filled", &["layer"], vec![4_i32, -7])
            .fill(-7)
            .flags([(4, "four"), (-7, "none")]),
    );
    let read = Dataset::from_bytes(made.clone().to_bytes().unwrap()).unwrap();
    assert_eq!(read.dimensions(), made.dimensions());
    assert!(read.attributes().eq(made.attributes()));
    let names = |set: &Dataset| -> Vec<String> {
        let names = set.variables().iter().map(|v| v.name().to_owned());
        names.collect()
    };
    assert_eq!(names(&read), names(&made));
    for (one, other) in made.variables().iter().zip(read.variables()) {
        // a NaN is not equal to itself, and its bits were compared above
        let told = |values: &Values| format!("{values:?}");
        assert_eq!(told(one.values()), told(other.values()), "{}", one.name());
        assert_eq!(one.dimensions(), other.dimensions());
        assert_eq!(one.attributes(), other.attributes());
        assert_eq!(one.flag_meanings(), other.flag_meanings());
        assert_eq!(one.fill_value(), other.fill_value());
        assert_eq!(
            made.is_coordinate(one.name()),
            read.is_coordinate(one.name())
        );
    }
    assert_eq!(read.to_bytes().unwrap(), made.to_bytes().unwrap());
    for damaged in [vec![], b"\x89HDF\r\n\x1a\n".to_vec(), vec![0; 4096]] {
        assert!(matches!(
            Dataset::from_bytes(damaged),
            Err(ResultsError::Unreadable { .. })
        ));
    }
}

#[test]
fn attributes_say_what_numbers_mean() {
    let file = Hdf5File::from_bytes(&dataset().to_bytes().unwrap()).unwrap();
    let root = file.root_group().unwrap();
    let text = |name| root.attribute(name).unwrap().read_string().unwrap();
    assert_eq!(text("Conventions"), "CF-1.11");
    assert_eq!(text("title"), "Attractors");
    assert_eq!(text("study"), STUDY);
    assert_eq!(text("long").chars().count(), 60_000);
    let period = file.dataset("period").unwrap();
    let of = |name: &str| period.attribute(name).unwrap();
    assert_eq!(of("flag_values").read_1d::<u8>().unwrap(), [0, 1, 2, 3]);
    let words = "not_periodic period_1 period_2 period_3";
    assert_eq!(of("flag_meanings").read_string().unwrap(), words);
    let filled = |name: &str| file.dataset(name).unwrap().attribute("_FillValue").is_ok();
    assert!(filled("real") && filled("single") && !filled("zeta") && !filled("period"));
}

#[test]
fn texts_of_attributes_are_characters_whatever_letters_they_have() {
    // NC_CHAR in netCDF is a string of fixed length in HDF5; NC_STRING, of any length, is for what fits nowhere else
    let fixed = |attribute: &hdf5_reader::Attribute| match &attribute.datatype {
        Datatype::String { size, .. } => Some(matches!(size, StringSize::Fixed(_))),
        Datatype::VarLen { kind, .. } => (*kind == VarLenKind::String).then_some(false),
        _ => None,
    };
    let letters = "η ζ_h ".repeat(7000);
    let dataset = dataset().attribute("letters", letters.as_str());
    let file = Hdf5File::from_bytes(&dataset.to_bytes().unwrap()).unwrap();
    let root = file.root_group().unwrap();
    let mut found = root.attributes().unwrap();
    found.extend(file.dataset("period").unwrap().attributes());
    found.extend(file.dataset("zeta").unwrap().attributes());
    let mut texts = 0;
    for attribute in &found {
        if let Some(fixed) = fixed(attribute) {
            texts += 1;
            assert_eq!(fixed, attribute.name != "long", "{}", attribute.name);
        }
    }
    // Conventions, title, study, long, letters; units, flag_meanings; CLASS, NAME, units, long_name
    assert_eq!(texts, 11);
    let read = root.attribute("letters").unwrap().read_string().unwrap();
    assert_eq!(read, letters);
}

#[test]
fn equal_datasets_are_equal_bytes_and_small() {
    let bytes = dataset().to_bytes().unwrap();
    assert_eq!(bytes, dataset().to_bytes().unwrap());
    assert!(bytes.starts_with(b"\x89HDF\r\n\x1a\n"));
    let n = 300;
    let axis = || (0..n).map(f64::from).collect::<Vec<_>>();
    let labels = vec![1_u8; (n * n) as usize];
    let map = Dataset::new("Labels")
        .coordinate(Variable::coordinate("x", axis()))
        .coordinate(Variable::coordinate("y", axis()))
        .variable(Variable::new("label", &["y", "x"], labels));
    assert!(
        map.to_bytes().unwrap().len() < 16_000,
        "labels are compressed"
    );
}

#[test]
fn a_dataset_is_a_file_of_the_folder() {
    let home = tempfile::tempdir().unwrap();
    let mut folder = ResultFolder::stage(&home.path().join("out")).unwrap();
    folder.write_dataset("data/map.nc", dataset()).unwrap();
    let wrong = Dataset::new("").dimension("", 1);
    assert!(matches!(
        folder.write_dataset("x.nc", wrong),
        Err(ResultsError::Dataset { .. })
    ));
    let file = folder.commit().unwrap().join("data/map.nc");
    assert_eq!(std::fs::read(file).unwrap(), dataset().to_bytes().unwrap());
}

#[test]
fn a_dataset_can_be_read_in_memory() {
    let dataset = dataset();
    dataset.check().unwrap();
    assert_eq!(dataset.dimensions()[0], ("seed".to_owned(), 5));
    assert_eq!(dataset.variables().len(), arrays().len());
    for (name, dimensions, values) in arrays() {
        let variable = dataset.get(name).unwrap();
        assert_eq!(
            (variable.name(), variable.dimensions()),
            (
                name,
                &dimensions.iter().map(|&d| d.to_owned()).collect::<Vec<_>>()[..]
            )
        );
        assert_eq!(variable.values().len(), values.len());
        assert_eq!(dataset.is_coordinate(name), dimensions == [name], "{name}");
    }
    let period = dataset.get("period").unwrap();
    assert_eq!(period.attributes(), [("units".to_owned(), "1".into())]);
    assert_eq!(period.flag_meanings()[0], (0, "not_periodic".to_owned()));
    assert_eq!(period.fill_value(), None);
    let title = |entry: &&(String, Attribute)| entry.0 == "title";
    assert_eq!(
        dataset.attributes().find(title).unwrap().1,
        "Attractors".into()
    );
    let settled = dataset
        .into_variables()
        .into_iter()
        .find(|v| v.name() == "settled");
    let expected = Values::Bool(vec![true, false, true, true, false, false]);
    assert_eq!(settled.unwrap().into_values(), expected);
}

#[test]
fn misfits_are_named() {
    let xy = || {
        Dataset::new("t")
            .coordinate(Variable::coordinate("x", vec![1.0, 2.0]))
            .coordinate(Variable::coordinate("y", vec![1.0, 2.0, 3.0]))
    };
    let array = |name: &str, dimensions: &[&str], count: usize| {
        Variable::new(name, dimensions, vec![0_u8; count])
    };
    let cases = [
        (
            xy().variable(array("a", &["y", "x"], 5)),
            "`a` has 5 values, its dimensions ask for 6",
        ),
        (
            xy().variable(array("a", &["z"], 5)),
            "`a` uses the dimension `z`, which is not there",
        ),
        (
            xy().variable(array("x", &["y"], 3)),
            "`x` is a variable twice",
        ),
        (
            xy().dimension("s", 4).variable(array("s", &["y"], 3)),
            "`s` has the name of a dimension",
        ),
        (xy().dimension("x", 4), "`x` is a dimension twice"),
        (xy().variable(array("a/b", &["x"], 2)), "`a/b` is no name"),
        (xy().attribute("", 1.0), "`` is no name"),
        (
            xy().attribute("CLASS", 1.0),
            "`CLASS` is an attribute that the file format sets",
        ),
        (
            xy().attribute("n", vec![0.0; 9000]),
            "`n` has more than 8000 numbers",
        ),
        (
            xy().variable(array("a", &["x"], 2).flags([(256, "b")])),
            "`a` has the code 256, its type holds 0 to 255",
        ),
        (
            xy().variable(array("a", &["x"], 2).fill(-1)),
            "`a` has the code -1",
        ),
        (
            xy().variable(Variable::new("a", &["x"], vec![0.0; 2]).fill(0)),
            "`a` has flags or a fill value",
        ),
        (
            xy().variable(Variable::new("a", &["x"], vec![true; 2]).flags([(1, "b")])),
            "`a` has flags or a fill value",
        ),
    ];
    for (dataset, words) in cases {
        let error = dataset.to_bytes().unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// Content with which `open_in_xarray.py` compares the file.
fn expected() -> String {
    let mut variables = serde_json::Map::new();
    for (name, dimensions, values) in arrays() {
        let (kind, content) = match &values {
            Values::Text(texts) => ("text", serde_json::json!(texts)),
            _ => {
                let (kind, bytes) = little_endian(&values);
                let mut digits = String::new();
                for byte in bytes {
                    write!(digits, "{byte:02x}").unwrap();
                }
                (kind, digits.into())
            }
        };
        let mut attributes = serde_json::json!({ "units": "1" });
        if name == "period" {
            attributes["flag_values"] = serde_json::json!([0, 1, 2, 3]);
            attributes["flag_meanings"] = "not_periodic period_1 period_2 period_3".into();
        }
        let variable = serde_json::json!({
            "dimensions": dimensions, "type": kind, "content": content, "attributes": attributes,
        });
        variables.insert(name.to_owned(), variable);
    }
    let attributes = serde_json::json!({
        "title": "Attractors", "study": STUDY, "accuracy": 1e-12, "seed": 7, "limits": [0.5, 2.5],
        "long": "ζ".repeat(60_000),
    });
    serde_json::json!({ "variables": variables, "attributes": attributes }).to_string()
}

/// Run with `SALTUS_PYTHON` as a Python that has xarray, h5netcdf, h5py and netCDF4.
#[test]
#[ignore = "needs Python with xarray: see tests/open_in_xarray.py"]
fn opens_in_xarray() {
    let home = tempfile::tempdir().unwrap();
    let (file, bits) = (home.path().join("all.nc"), home.path().join("bits.json"));
    std::fs::write(&file, dataset().to_bytes().unwrap()).unwrap();
    std::fs::write(&bits, expected()).unwrap();
    let python = std::env::var("SALTUS_PYTHON").unwrap_or("python3".to_owned());
    let output = Command::new(python)
        .arg(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/tests/open_in_xarray.py"
        ))
        .arg("--expect")
        .args([bits, file])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
