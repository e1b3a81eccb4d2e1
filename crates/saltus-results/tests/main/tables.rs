//! Each rule of tables and documents on one small dataset: two values, two people, up to three samples.

use saltus_results::{Cells, Dataset, Document, Quantity, Table, csv};

const VALUE: Quantity = Quantity::new("value", "Value of the parameter", "1");
const JUMPER: Quantity = Quantity::new("jumper", "Jumper", "1");
const SAMPLE: Quantity = Quantity::new("sample", "Sample", "1");
const Z: Quantity = Quantity::new("z", "Height", "m");
const PERIOD: Quantity = Quantity::new("period", "Period", "1");
const KIND: Quantity = Quantity::one_of("kind", "What it is", &["none", "limit-cycle"]);
const REMARK: Quantity = Quantity::text("remark", "Remark");
const RATE: Quantity = Quantity::new("rate", "Growth", "s-1");
const STABLE: Quantity = Quantity::text("stable", "Whether it is stable");

fn dataset() -> Dataset {
    let nan = f64::NAN;
    let z = vec![0.1, nan, nan, 0.2, 0.3, nan, nan, nan, nan, nan, nan, nan];
    Dataset::new("Toy")
        .header("source", "saltus 1")
        .attribute("parameter", "mass")
        .ragged("sample")
        .coordinate(VALUE.along(vec![0.5, 1e-7]))
        .coordinate(JUMPER.numbered(0, 2))
        .coordinate(SAMPLE.numbered(1, 3))
        .variable(Z.over(&["value", "jumper", "sample"], z))
        .variable(PERIOD.over(&["value"], vec![2, 0]).gap(0))
        .variable(KIND.spelt(&["value"], ["limit-cycle", "none"]).gap(0))
        .variable(REMARK.over(&["value"], vec!["a, \"b\"".to_owned(), String::new()]))
        .variable(RATE.over(
            &["value", "jumper"],
            vec![f64::NEG_INFINITY, 1.0, nan, -0.0],
        ))
        .variable(STABLE.is(true))
        .column(STABLE.named("odd").over(&["jumper"], vec![false, true]))
}

fn text(dataset: &Dataset, table: &Table) -> String {
    String::from_utf8(csv(dataset, table, Vec::new()).unwrap()).unwrap()
}

fn rows(table: &Table) -> Vec<String> {
    let text = text(&dataset(), table);
    let lines = text.lines().skip_while(|line| line.starts_with('#'));
    lines.map(str::to_owned).collect()
}

fn json(table: Table) -> String {
    serde_json::to_string(&Document::new(&dataset().table(table))).unwrap()
}

#[test]
fn rows_are_the_places_of_axes_and_gaps_are_empty() {
    let table = Table::new("rows", &["value", "jumper"])
        .columns(&["value", "jumper", "period", "kind", "remark"])
        .titled("growth", "rate");
    let expected = [
        "value,jumper,period,kind,remark,growth",
        "0.5,0,2,limit-cycle,\"a, \"\"b\"\"\",-inf",
        "0.5,1,2,limit-cycle,\"a, \"\"b\"\"\",1.0",
        "1e-7,0,,,,",
        "1e-7,1,,,,-0.0",
    ];
    assert_eq!(rows(&table), expected);
    let text = text(&dataset(), &table);
    assert!(text.starts_with(
        "# Toy (saltus 1)\n# value: Value of the parameter (-)\n# jumper: Jumper (-)\n# period"
    ));
    assert!(text.contains("# growth: Growth (s-1)\n"));
}

#[test]
fn places_stand_side_by_side_in_turns() {
    let suffixes = || ["_a", "_b"].map(str::to_owned);
    let table = Table::new("wide", &["value"])
        .columns(&["rate", "odd", "period"])
        .beside("jumper", suffixes());
    assert_eq!(rows(&table)[0], "rate_a,odd_a,rate_b,odd_b,period");
    assert_eq!(rows(&table)[1], "-inf,false,1.0,true,2");
}

#[test]
fn rows_without_a_value_are_left_out() {
    let table = Table::new("samples", &["value", "jumper", "sample"])
        .columns(&["value", "jumper", "sample", "z"]);
    let met = table.clone().only_where("z");
    let expected = [
        "value,jumper,sample,z",
        "0.5,0,1,0.1",
        "0.5,1,1,0.2",
        "0.5,1,2,0.3",
    ];
    assert_eq!(rows(&met), expected);
    let last = table.only_rows((0..12).map(|place| place == 11).collect());
    assert_eq!(rows(&last), ["value,jumper,sample,z", "1e-7,1,3,"]);
}

#[test]
fn a_document_has_keys_lists_and_records() {
    let table = Table::new("rows", &["value"]).columns(&["value", "kind", "rate", "z"]);
    let expected = concat!(
        r#"{"parameter":"mass","stable":true,"rows":["#,
        r#"{"value":0.5,"kind":"limit-cycle","rate":[null,1.0],"z":[[0.1],[0.2,0.3]]},"#,
        r#"{"value":1e-7,"kind":null,"rate":[null,-0.0],"z":[[],[]]}]}"#
    );
    assert_eq!(json(table.clone()), expected);
    assert!(!json(table.in_files()).contains("rows"));
}

#[test]
fn columns_of_no_axis_are_keys_of_the_document() {
    let table = Table::of_document(&["period", "jumper"]);
    assert!(!table.is_file());
    let expected = r#"{"parameter":"mass","stable":true,"period":[2,null],"jumper":[0,1]}"#;
    assert_eq!(json(table), expected);
}

#[test]
fn columns_have_the_types_of_their_variables() {
    let table = Table::new("rows", &["value", "jumper"])
        .columns(&["jumper", "period", "kind", "odd", "rate"]);
    let columns = table.to_columns(&dataset()).unwrap();
    let cells: Vec<&Cells> = columns.iter().map(|column| &column.cells).collect();
    assert_eq!(*cells[0], Cells::I64(vec![0, 1, 0, 1]));
    assert!(matches!(cells[1], Cells::F64(period) if period[0] == 2.0 && period[3].is_nan()));
    let word = |word: &str| Some(word.to_owned());
    let kinds = vec![word("limit-cycle"), word("limit-cycle"), None, None];
    assert_eq!(*cells[2], Cells::Text(kinds));
    assert_eq!(*cells[3], Cells::Flags(vec![false, true, false, true]));
    assert!(matches!(cells[4], Cells::F64(rate) if rate[0] == f64::NEG_INFINITY));
    assert_eq!(columns[4].note, "Growth (s-1)");
}

#[test]
fn a_table_that_does_not_fit_is_refused() {
    let wrong = |table: Table| {
        let error = dataset().table(table).check().unwrap_err();
        error.to_string()
    };
    let names = ["period"];
    assert!(wrong(Table::new("t", &["value"]).columns(&["mass"])).contains("`mass`"));
    assert!(wrong(Table::new("t", &["place"]).columns(&names)).contains("`place`"));
    assert!(wrong(Table::new("t", &["value"]).columns(&["z"])).contains("several values"));
    let short = Table::new("t", &["value"]).columns(&["rate"]);
    let short = short.beside("jumper", ["_a".to_owned()]);
    assert!(wrong(short).contains("several values"));
    let chosen = Table::new("t", &["value"]).columns(&names);
    assert!(wrong(chosen.only_rows(vec![true])).contains("2 places"));
}
