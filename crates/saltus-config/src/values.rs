//! The two ways of giving the values of an axis: `from`, `to` and `count`, or a list.

use crate::axis::{Axis, Ends};
use crate::fault::{Fault, key, wrong};
use crate::schema::description;
use crate::study::AxisTable;

/// The axis of `table`, if its values are given in one way and, being a list, ascend or descend.
pub(crate) fn axis<'a>(
    table: &'a str,
    axis: &'a AxisTable,
    faults: &mut Vec<Fault>,
) -> Option<Axis<'a>> {
    let found = faults.len();
    let even = [
        ("from", axis.from.is_some()),
        ("to", axis.to.is_some()),
        ("count", axis.count.is_some()),
    ];
    match &axis.values {
        Some(values) => {
            faults.extend(both(table, values, &even));
            faults.extend(unordered(table, values));
        }
        None => faults.extend(missing(table, &even)),
    }
    (faults.len() == found).then(|| Axis {
        table,
        parameter: &axis.parameter,
        from: axis.from(),
        to: axis.to(),
        ends: axis
            .values
            .as_ref()
            .map_or(Ends::Keys, |values| Ends::Listed(values.len())),
    })
}

fn both(table: &str, values: &[f64], even: &[(&str, bool)]) -> Option<Fault> {
    let (name, _) = even.iter().find(|(_, given)| *given)?;
    let what = format!("{table}.{name} is given too");
    let fault = wrong(&format!("{table}.values"), values.to_vec(), &what);
    let help = "give values, or from, to and count, and not both".to_owned();
    Some(Fault {
        help: Some(help),
        ..fault
    })
}

/// The first value that does not go on in the direction of the first two.
fn unordered(table: &str, values: &[f64]) -> Option<Fault> {
    let ascend = values.first() < values.get(1);
    let fine = |pair: &[f64]| pair[0] != pair[1] && (pair[0] < pair[1]) == ascend;
    let before = values.windows(2).position(|pair| !fine(pair))?;
    let side = match (before, ascend) {
        (0, _) => "different from",
        (_, true) => "above",
        (_, false) => "below",
    };
    let what = format!(
        "a value {side} the one before it, {:?}, is needed",
        values[before]
    );
    let at = format!("{table}.values.{}", before + 1);
    Some(Fault {
        help: Some("the values ascend or descend, and none comes twice".to_owned()),
        ..wrong(&at, values[before + 1], &what)
    })
}

fn missing(table: &str, even: &[(&str, bool)]) -> Vec<Fault> {
    let absent = even.iter().filter(|(_, given)| !given);
    let fault = |(name, _): &(&str, bool)| {
        let key = key(&format!("{table}.{name}"));
        let or = "or give values, a list, instead of from, to and count";
        let help = description(&key).map(|d| format!("{name}: {d}; {or}"));
        Fault::missing(&key, help)
    };
    absent.map(fault).collect()
}
