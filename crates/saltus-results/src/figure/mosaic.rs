//! Cells as pixels. A [`Mosaic`] knows the edges of its cells and gives each pixel of any raster one code:
//! rectangles side by side would show seams, pixels cannot.

use super::axis::{Axis, Scale};
use super::colour::Colour;

/// Cells in data coordinates, as a map keeps them until its axes are resolved.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    /// Edges of the cells, one more than there are columns, and the same for the rows.
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
    /// A code for each cell, in rows of constant y; the index of its colour.
    pub(crate) codes: Vec<u8>,
    pub(crate) colours: Vec<Colour>,
    pub(crate) mixing: Mixing,
}

/// Rule for a pixel that several cells share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mixing {
    /// The code that covers most of it: classes have no mean.
    Largest,
    /// The mean code, but the last one, which stands for no value, only if that covers most of it.
    Mean,
}

/// Cells in pixels: edges ascend, and the first code is at the upper left.
#[derive(Clone, Debug)]
pub(crate) struct Mosaic {
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
    codes: Vec<u8>,
    pub(crate) colours: Vec<Colour>,
    mixing: Mixing,
    /// Left, top, right and bottom (px) of the part that shows.
    pub(crate) shown: [f64; 4],
}

/// Edges of the cells around `values`: halfway to the neighbours, and as far beyond the outermost, as the
/// axis measures distances. `None` unless the values ascend or descend and the axis has a place for them.
pub(crate) fn edges(axis: &Axis, values: &[f64]) -> Option<Vec<f64>> {
    let to = |value: f64| {
        if axis.logarithmic {
            value.log10()
        } else {
            value
        }
    };
    let from = |units: f64| {
        if axis.logarithmic {
            10f64.powf(units)
        } else {
            units
        }
    };
    let units: Vec<f64> = values.iter().map(|&value| to(value)).collect();
    let (first, last) = (*units.first()?, *units.last()?);
    let (low, high) = match units[..] {
        [0.0] => (-0.5, 0.5),
        [only] => (only - 0.1 * only.abs(), only + 0.1 * only.abs()),
        [first, second, ..] => {
            let before = units[units.len() - 2];
            (first - 0.5 * (second - first), last + 0.5 * (last - before))
        }
        [] => (first, last),
    };
    let inner = units.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let edges: Vec<f64> = std::iter::once(low).chain(inner).chain([high]).collect();
    let ascending = edges.windows(2).all(|pair| pair[0] < pair[1]);
    let descending = edges.windows(2).all(|pair| pair[0] > pair[1]);
    let edges: Vec<f64> = edges.into_iter().map(from).collect();
    let fine = (ascending || descending) && edges.iter().all(|edge| edge.is_finite());
    fine.then_some(edges)
}

impl Cells {
    /// The cells in pixels of the frame with the given sides; `None` if none of them shows.
    pub(crate) fn place(&self, x: &Scale, y: &Scale, frame: [f64; 4]) -> Option<Mosaic> {
        let pixels = |scale: &Scale, edges: &[f64]| -> Option<Vec<f64>> {
            edges.iter().map(|&edge| scale.pixel(edge)).collect()
        };
        let (mut columns, mut rows) = (pixels(x, &self.x)?, pixels(y, &self.y)?);
        let mut codes = self.codes.clone();
        let width = columns.len().checked_sub(1).filter(|&width| width > 0)?;
        if columns[0] > columns[width] {
            columns.reverse();
            codes.chunks_mut(width).for_each(<[u8]>::reverse);
        }
        if rows.first() > rows.last() {
            rows.reverse();
            codes = codes.chunks(width).rev().flatten().copied().collect();
        }
        let shown = [
            frame[0].max(columns[0]),
            frame[1].max(rows[0]),
            frame[2].min(columns[width]),
            frame[3].min(*rows.last()?),
        ];
        (shown[0] < shown[2] && shown[1] < shown[3]).then(|| Mosaic {
            x: columns,
            y: rows,
            codes,
            colours: self.colours.clone(),
            mixing: self.mixing,
            shown,
        })
    }
}

/// A raster over a part of the sheet: pixel (i, j) spans `x + i·step` to `x + (i+1)·step`, and so in y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Raster {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) step: (f64, f64),
    pub(crate) size: (usize, usize),
}

impl Mosaic {
    /// Codes of a raster, row by row.
    pub(crate) fn sample(&self, raster: Raster) -> Vec<u8> {
        let across = overlaps(&self.x, raster.x, raster.step.0, raster.size.0);
        let down = overlaps(&self.y, raster.y, raster.step.1, raster.size.1);
        let width = self.x.len() - 1;
        let mut codes = Vec::with_capacity(across.len() * down.len());
        let mut weights = [0.0_f64; 256];
        for rows in &down {
            for columns in &across {
                let code = match (&rows[..], &columns[..]) {
                    ([row], [column]) => self.codes[row.0 * width + column.0],
                    _ => {
                        let mut touched = Vec::new();
                        for row in rows {
                            for column in columns {
                                let code = self.codes[row.0 * width + column.0];
                                weights[usize::from(code)] += row.1 * column.1;
                                touched.push(code);
                            }
                        }
                        let code = self.mixed(&weights, &touched);
                        touched
                            .iter()
                            .for_each(|&code| weights[usize::from(code)] = 0.0);
                        code
                    }
                };
                codes.push(code);
            }
        }
        codes
    }

    /// One code for the `touched` ones, which may repeat, by the `weights` of all codes.
    fn mixed(&self, weights: &[f64; 256], touched: &[u8]) -> u8 {
        let weight = |code: u8| weights[usize::from(code)];
        let missing = (self.colours.len() - 1) as u8;
        let mut distinct = touched.to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        let total: f64 = distinct.iter().map(|&code| weight(code)).sum();
        if self.mixing == Mixing::Mean && weight(missing) < 0.5 * total {
            let sum = |value: fn(u8) -> f64| -> f64 {
                let present = distinct.iter().filter(|&&code| code != missing);
                present.map(|&code| weight(code) * value(code)).sum()
            };
            return (sum(f64::from) / sum(|_| 1.0)).round() as u8;
        }
        // Of equals the first, so that equal maps are equal pictures.
        let largest = distinct
            .iter()
            .rev()
            .max_by(|&&a, &&b| weight(a).total_cmp(&weight(b)));
        largest.copied().unwrap_or(missing)
    }

    /// A raster of whole cells for a picture that a viewer scales, with its place on the sheet.
    ///
    /// Cells of equal size become equal blocks of pixels, about a thousand across in all, so that a viewer
    /// that smooths does so only at their edges. Other cells are sampled at four pixels per unit.
    pub(crate) fn blocks(&self) -> Raster {
        let [left, top, right, bottom] = self.shown;
        let axis = |edges: &[f64], low: f64, high: f64| {
            let count = edges.len() - 1;
            let cell = (edges[count] - edges[0]) / count as f64;
            let even =
                (0..=count).all(|i| (edges[i] - edges[0] - cell * i as f64).abs() < 0.01 * cell);
            let whole = low == edges[0] && high == edges[count];
            let pixels = if even && whole {
                count * 1000_usize.div_ceil(count)
            } else {
                ((high - low) * 4.0).ceil() as usize
            };
            (pixels, (high - low) / pixels as f64)
        };
        let (columns, across) = axis(&self.x, left, right);
        let (rows, down) = axis(&self.y, top, bottom);
        Raster {
            x: left,
            y: top,
            step: (across, down),
            size: (columns, rows),
        }
    }
}

/// For each of `count` pixels the cells it meets and how much of it each covers.
fn overlaps(edges: &[f64], start: f64, step: f64, count: usize) -> Vec<Vec<(usize, f64)>> {
    let cells = edges.len() - 1;
    // An overlap by rounding alone is left out: it would cost and not show.
    let hair = 1e-3 * step;
    let pixel = |number: usize| {
        let (low, high) = (
            start + step * number as f64,
            start + step * (number + 1) as f64,
        );
        let first = edges
            .partition_point(|&edge| edge <= low + hair)
            .saturating_sub(1)
            .min(cells - 1);
        let mut met = Vec::new();
        for cell in first..cells {
            // The outermost cells also cover what lies beyond them.
            let from = if cell == 0 {
                f64::NEG_INFINITY
            } else {
                edges[cell]
            };
            let to = if cell + 1 == cells {
                f64::INFINITY
            } else {
                edges[cell + 1]
            };
            if from >= high - hair {
                break;
            }
            let part = high.min(to) - low.max(from);
            if part > hair {
                met.push((cell, part / step));
            }
        }
        met
    };
    (0..count).map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mosaic(codes: &[u8], mixing: Mixing) -> Mosaic {
        let edges = |count: usize| (0..=count).map(|i| i as f64).collect::<Vec<_>>();
        Mosaic {
            x: edges(codes.len()),
            y: edges(1),
            codes: codes.to_vec(),
            colours: vec![Colour::BLACK; 11],
            mixing,
            shown: [0.0, 0.0, codes.len() as f64, 1.0],
        }
    }

    fn across(mosaic: &Mosaic, pixels: usize) -> Vec<u8> {
        mosaic.sample(Raster {
            x: 0.0,
            y: 0.0,
            step: ((mosaic.x.len() - 1) as f64 / pixels as f64, 1.0),
            size: (pixels, 1),
        })
    }

    #[test]
    fn cells_end_halfway_and_reach_half_a_cell_beyond() {
        let linear = Axis::new("x");
        assert_eq!(
            edges(&linear, &[1.0, 2.0, 4.0]).expect("ascend"),
            [0.5, 1.5, 3.0, 5.0]
        );
        assert_eq!(
            edges(&linear, &[2.0, 1.0]).expect("descend"),
            [2.5, 1.5, 0.5]
        );
        assert_eq!(edges(&linear, &[5.0]).expect("one"), [4.5, 5.5]);
        let decades = edges(&Axis::new("x").logarithmic(), &[1.0, 100.0]).expect("positive");
        assert!((decades[0] - 0.1).abs() < 1e-12 && (decades[1] - 10.0).abs() < 1e-12);
        for bad in [&[][..], &[1.0, 1.0], &[1.0, 3.0, 2.0], &[1.0, f64::NAN]] {
            assert_eq!(edges(&linear, bad), None, "{bad:?}");
        }
    }

    #[test]
    fn many_pixels_repeat_a_cell_and_few_choose_or_mix() {
        let classes = mosaic(&[1, 2, 2, 7], Mixing::Largest);
        assert_eq!(across(&classes, 8), [1, 1, 2, 2, 2, 2, 7, 7]);
        assert_eq!(across(&classes, 4), [1, 2, 2, 7]);
        assert_eq!(across(&classes, 1), [2]);
        let values = mosaic(&[0, 4, 10, 6], Mixing::Mean);
        assert_eq!(across(&values, 2), [2, 6]);
        assert_eq!(across(&mosaic(&[4, 10, 10], Mixing::Mean), 1), [10]);
        assert_eq!(across(&values, 1), [3]);
    }

    #[test]
    fn blocks_are_whole_cells() {
        let codes: Vec<u8> = (0..9).collect();
        let mosaic = mosaic(&codes, Mixing::Mean);
        let raster = mosaic.blocks();
        assert_eq!(raster.size, (9 * 112, 1000));
        let row = &mosaic.sample(raster)[..9 * 112];
        assert!(
            row.iter()
                .enumerate()
                .all(|(i, &code)| usize::from(code) == i / 112)
        );
    }
}
