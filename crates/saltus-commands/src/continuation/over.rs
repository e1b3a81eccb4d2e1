//! The map under the curves: that of an earlier result, over the same two parameters.

use super::question::Question;
use crate::data::name;
use crate::failure::CommandError;
use crate::plane::{Status, motions};
use crate::request::Request;
use crate::saved::SavedResult;
use crate::words::axis;
use saltus_results::shown::path;
use saltus_results::{ClassMap, Dataset, Grid, Values};
use std::path::Path;

/// Advice on what would do.
const FOLDER: &str = "--over takes a folder that `saltus map --out` wrote, with the parameters of [continue] and \
                      [continue.second] as its axes";

/// The map of the result in `folder`, its axes those of the curves.
pub(super) fn map(folder: &Path, question: &Question) -> Result<ClassMap, CommandError> {
    let refused =
        |why: &str| CommandError::refused(format!("--over {}: {why}", path(folder)), FOLDER);
    let Some((_, second)) = &question.second else {
        return Err(refused(
            "the study has no [continue.second], so there are no curves",
        ));
    };
    let kept = SavedResult::open(folder)?.read()?;
    if *kept.request() != Request::Map {
        let what = kept.request().name();
        return Err(refused(&format!("it is a result of `saltus {what}`")));
    }
    let data = kept.data()?;
    let (across, up) = (&question.parameter, second);
    let status = data
        .get("status")
        .filter(|status| status.dimensions().len() == 2);
    let status = status.ok_or_else(|| refused("it has no status of pixels"))?;
    let turned = match [&*status.dimensions()[0], &*status.dimensions()[1]] {
        [y, x] if y == name(up) && x == name(across) => false,
        [y, x] if y == name(across) && x == name(up) => true,
        [y, x] => return Err(refused(&format!("its axes are {x} and {y}"))),
    };
    let values = |parameter| numbers(&data, &name(parameter));
    let (x, y) = (values(across), values(up));
    let place = |i: usize| match turned {
        false => i,
        true => (i % x.len()) * y.len() + i / x.len(),
    };
    let layer = |name: &str| -> Vec<f64> {
        let layer = numbers(&data, name);
        let cells = (0..x.len() * y.len()).map(place);
        cells
            .map(|at| layer.get(at).copied().unwrap_or(f64::NAN))
            .collect()
    };
    let status = layer("status").into_iter().map(|code| {
        let known = Status::ALL.get(code as usize);
        known.copied().unwrap_or(Status::Ended)
    });
    let pixels = status.zip(layer("period").into_iter().map(|period| period as u16));
    let grid = Grid::new(axis(across), &x[..], axis(up), &y[..]);
    Ok(motions(grid, pixels, ""))
}

/// An array as numbers; empty if there is none of that name.
fn numbers(data: &Dataset, name: &str) -> Vec<f64> {
    match data.get(name).map(saltus_results::Variable::values) {
        Some(Values::F64(values)) => values.clone(),
        Some(Values::I32(values)) => values.iter().copied().map(f64::from).collect(),
        Some(Values::U16(values)) => values.iter().copied().map(f64::from).collect(),
        Some(Values::U8(values)) => values.iter().copied().map(f64::from).collect(),
        _ => Vec::new(),
    }
}
