//! Curves of special points over two parameters.

use super::Found;
use crate::continuation::Followed;
use crate::data::{in_unit_of, name, parameter_of, texts, values, wholes};
use crate::quantities as q;
use saltus::orbits::{CurvePoint, Multiplier};
use saltus_config::{Parameter, SecondTable};
use saltus_results::{Dataset, Quantity, Table};

/// The curves that were asked for.
pub(super) fn curves(
    set: Dataset,
    found: &Found,
    (table, second): &(SecondTable, Parameter),
) -> Dataset {
    let (over, curves) = (["curve"], &found.curves);
    let kinds = curves.iter().map(Followed::kind);
    let lengths = curves.iter().map(|followed| followed.points().len());
    let end = |quantity: Quantity, which: usize| {
        let end = |followed: &Followed| match &followed.outcome {
            Ok(curve) => curve.ends[which].to_string(),
            Err(_) => String::new(),
        };
        quantity.over(&over, curves.iter().map(end).collect::<Vec<String>>())
    };
    let errors = curves.iter().map(|followed| match &followed.outcome {
        Ok(_) => "",
        Err(reason) => reason,
    });
    let labels = curves.iter().map(|followed| followed.label.as_str());
    let set = parameter_of(set, "second_", second)
        .variable(in_unit_of(second, q::SECOND_FROM.is(table.from)))
        .variable(in_unit_of(second, q::SECOND_TO.is(table.to)))
        .coordinate(q::CURVE.numbered(0, curves.len()))
        .variable(q::CURVE_OF.over(&over, texts(labels)))
        .variable(q::CURVE_KIND.over(&over, texts(kinds)))
        .variable(q::CURVE_POINTS.over(&over, wholes(lengths)))
        .variable(end(q::CURVE_END_FIRST, 0))
        .variable(end(q::CURVE_END_LAST, 1))
        .variable(q::CURVE_ERROR.over(&over, texts(errors)))
        .table(
            Table::new("curves", &over)
                .columns(&["curve"])
                .titled("label", "curve_of")
                .titled("kind", "curve_kind")
                .titled("points", "curve_points")
                .titled("end_first", "curve_end_first")
                .titled("end_last", "curve_end_last")
                .titled("error", "curve_error")
                .in_document(),
        );
    curve_points(set, found, second)
}

/// The points of all curves, one after the other.
fn curve_points(set: Dataset, found: &Found, second: &Parameter) -> Dataset {
    let over = ["curve_point"];
    let curves = found.curves.iter().enumerate();
    let all: Vec<(usize, usize, &CurvePoint)> = curves
        .flat_map(|(curve, followed)| {
            let points = followed.points().iter().enumerate();
            points.map(move |(number, point)| (curve, number, point))
        })
        .collect();
    let curve =
        |of: fn(&Followed) -> &str| texts(all.iter().map(|(curve, ..)| of(&found.curves[*curve])));
    let angle = |point: &CurvePoint| point.pair.map_or(f64::NAN, Multiplier::argument);
    let angles: Vec<f64> = all.iter().map(|(.., point)| angle(point)).collect();
    let periods = wholes(all.iter().map(|(.., point)| point.orbit.period()));
    let mut set = set
        .dimension(over[0], all.len())
        .variable(q::CURVE_LABEL.over(&over, curve(|followed| &followed.label)))
        .variable(q::CURVE_NUMBER.over(&over, wholes(all.iter().map(|at| at.0))))
        .variable(q::NUMBER_ON_CURVE.over(&over, wholes(all.iter().map(|at| at.1))))
        .variable(q::CURVE_PERIOD.over(&over, periods))
        .variable(q::CURVE_ANGLE.over(&over, angles))
        .column(q::CURVE_POINT_KIND.over(&over, curve(Followed::kind)));
    let both = [&found.question.parameter, second];
    for (index, parameter) in both.into_iter().enumerate() {
        let along = all.iter().map(|(.., point)| point.parameters[index]);
        let variable = values(parameter, &over, along.collect());
        set = set.variable(variable.named(curve_value(parameter)));
    }
    let rest = |table: Table, [first, last]: [String; 2]| {
        table
            .titled("point", "number_on_curve")
            .titled(first, curve_value(both[0]))
            .titled(last, curve_value(both[1]))
            .titled("period", "curve_period")
            .titled("angle", "curve_angle")
    };
    let rows = Table::new("curves", &over).titled("label", "curve_label");
    let rows = rows.titled("kind", "curve_point_kind");
    let records = Table::new("curve_points", &over).titled("curve", "curve_number");
    let records = records.titled("label", "curve_label");
    set.table(rest(rows, both.map(name)).in_files())
        .table(rest(records, ["value", "second_value"].map(str::to_owned)).in_document())
}

fn curve_value(parameter: &Parameter) -> String {
    format!("curve_{}", name(parameter))
}
