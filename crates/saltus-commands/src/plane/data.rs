//! Data of a plane: all layers over (y, x), and what they add up to.

use super::{Layers, Plane, PlaneAxis, Span, Tally, span};
use crate::data::{about, coordinate, each_jumper, in_unit_of, name, parameter_of, whole, wholes};
use crate::quantities as q;
use saltus_config::Study;
use saltus_results::{Dataset, Quantity, Table};

/// Each layer is copied once; no table shows one, since it may have a hundred million values.
pub(crate) fn data(title: &str, study: &Study, plane: &Plane, layers: &Layers) -> Dataset {
    let run = layers.periods_run.iter().map(|&periods| u64::from(periods));
    let set = values(about(title, study), plane, layers);
    let set = axis(set, "x_", &plane.x, [q::X_FROM, q::X_TO, q::X_COUNT]);
    let set = axis(set, "y_", &plane.y, [q::Y_FROM, q::Y_TO, q::Y_COUNT])
        .variable(q::PLANE_TRANSIENT.is(whole(plane.search.transient)))
        .variable(q::PLANE_RECORD.is(whole(plane.search.record)))
        .variable(q::PIXELS.is(whole(plane.grid.len())))
        .variable(q::PERIODS_RUN_TOTAL.is(whole(run.sum::<u64>())));
    let set = first_failure(set, plane, layers);
    spans(tally(set, &layers.tally()), layers)
}

fn values(set: Dataset, plane: &Plane, layers: &Layers) -> Dataset {
    let (x, y) = (&plane.x.parameter, &plane.y.parameter);
    let over = [&*name(y), &*name(x)];
    let status: Vec<u8> = layers.status.iter().map(|&status| status as u8).collect();
    let mut set = set
        .coordinate(coordinate(y, &plane.grid.y))
        .coordinate(coordinate(x, &plane.grid.x))
        .variable(q::PIXEL_PERIOD.over(&over, layers.period.clone()))
        .variable(q::PIXEL_STATUS.over(&over, status))
        .variable(q::PEAK_ACCELERATION.over(&over, layers.peak_acceleration.clone()))
        .variable(q::PIXEL_EXPONENT.over(&over, layers.exponent.clone()))
        .variable(q::EXPONENT_ERROR.over(&over, layers.exponent_error.clone()));
    let people = layers.contact_ratio.iter().zip(&layers.peak_reaction);
    let suffixes = each_jumper(layers.contact_ratio.len());
    for ((contact, reaction), suffix) in people.zip(suffixes) {
        let named = |quantity: Quantity, layer: &[f64]| {
            let variable = quantity.over(&over, layer.to_vec());
            variable.named(format!("{}{suffix}", quantity.name))
        };
        set = set
            .variable(named(q::CONTACT_RATIO, contact))
            .variable(named(q::PEAK_REACTION, reaction));
    }
    let run = wholes(layers.periods_run.iter().copied());
    set.variable(q::PERIODS_RUN.over(&over, run))
        .variable(q::CHAOTIC_PERIODS.over(&over, wholes(layers.chaotic_periods())))
}

fn axis(set: Dataset, prefix: &str, axis: &PlaneAxis, [from, to, count]: [Quantity; 3]) -> Dataset {
    let (parameter, table) = (&axis.parameter, &axis.table);
    parameter_of(set, prefix, parameter)
        .variable(in_unit_of(parameter, from.is(table.from())))
        .variable(in_unit_of(parameter, to.is(table.to())))
        .variable(count.is(whole(table.count())))
}

fn first_failure(set: Dataset, plane: &Plane, layers: &Layers) -> Dataset {
    let first = layers.first_loss.as_ref();
    let (x, y) = first.map_or((f64::NAN, f64::NAN), |(pixel, _)| plane.grid.at(*pixel));
    let [status, reason] = first.map_or(["", ""], |(_, loss)| [&loss.status, &loss.reason]);
    set.variable(in_unit_of(&plane.x.parameter, q::PLANE_FAILURE_X.is(x)))
        .variable(in_unit_of(&plane.y.parameter, q::PLANE_FAILURE_Y.is(y)))
        .variable(q::PLANE_FAILURE_STATUS.is(status))
        .variable(q::PLANE_FAILURE_TEXT.is(reason))
}

/// Numbers of pixels with each status and each period.
fn tally(set: Dataset, tally: &Tally) -> Dataset {
    let counts = |counts: &mut dyn Iterator<Item = usize>| counts.map(whole).collect::<Vec<i64>>();
    let periods = || tally.periods.iter();
    let shares: Vec<f64> = periods().map(|period| period.share).collect();
    let over = tally
        .chaotic_over
        .map_or([0; 2], |[min, max]| [min, max].map(i64::from));
    set.variable(q::CHAOTIC_OVER_MIN.is(over[0]).gap(0))
        .variable(q::CHAOTIC_OVER_MAX.is(over[1]).gap(0))
        .coordinate(q::OUTCOME.along((0..).take(tally.status.len()).collect::<Vec<u8>>()))
        .variable(
            q::OUTCOME_PIXELS
                .over(&["outcome"], counts(&mut tally.status.iter().copied()))
                .gap(0),
        )
        .coordinate(q::CYCLE_PERIOD.along(wholes(periods().map(|p| p.period))))
        .variable(q::CYCLE_PIXELS.over(&["cycle_period"], counts(&mut periods().map(|p| p.pixels))))
        .variable(q::CYCLE_SHARE.over(&["cycle_period"], shares))
        .table(
            Table::new("outcomes", &["outcome"])
                .titled("status", "outcome")
                .titled("pixels", "outcome_pixels")
                .only_where("outcome_pixels")
                .in_document(),
        )
        .table(
            Table::new("periods", &["cycle_period"])
                .titled("period", "cycle_period")
                .titled("pixels", "cycle_pixels")
                .titled("share", "cycle_share")
                .in_document(),
        )
}

/// The ranges of the layers, of those of people for each.
fn spans(set: Dataset, layers: &Layers) -> Dataset {
    let people = layers.contact_ratio.len();
    let each = |set: Dataset, quantities: [Quantity; 2], over: &[&str], layers: &[Vec<f64>]| {
        let spans: Vec<Option<Span>> = layers.iter().map(|layer| span(layer)).collect();
        let of = |end: fn(Span) -> f64| -> Vec<f64> {
            spans
                .iter()
                .map(|span| span.map_or(f64::NAN, end))
                .collect()
        };
        set.variable(quantities[0].over(over, of(|span| span.min)))
            .variable(quantities[1].over(over, of(|span| span.max)))
    };
    let peaks = std::slice::from_ref(&layers.peak_acceleration);
    let set = each(
        set,
        [q::PEAK_ACCELERATION_MIN, q::PEAK_ACCELERATION_MAX],
        &[],
        peaks,
    );
    let set = set.coordinate(q::JUMPER.numbered(0, people));
    let set = each(
        set,
        [q::CONTACT_RATIO_MIN, q::CONTACT_RATIO_MAX],
        &["jumper"],
        &layers.contact_ratio,
    );
    let set = each(
        set,
        [q::PEAK_REACTION_MIN, q::PEAK_REACTION_MAX],
        &["jumper"],
        &layers.peak_reaction,
    );
    set.table(Table::of_document(&[
        "contact_ratio_min",
        "contact_ratio_max",
        "peak_reaction_min",
        "peak_reaction_max",
    ]))
}
