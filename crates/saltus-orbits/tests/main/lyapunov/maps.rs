//! Maps of one line whose exponents are known.

use saltus_orbits::{Image, MapPoint, MapRequest, Matrix, NoImage, ParametricMap};

/// x' and dx'/dx, row by row, from parameters and x.
type Rule = fn(&[f64], &[f64]) -> (Vec<f64>, Vec<f64>);

pub(crate) struct Toy {
    dimension: usize,
    rule: Rule,
}

impl ParametricMap for Toy {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn images(&self, shots: &[MapRequest<'_>]) -> Vec<Result<Image, NoImage>> {
        shots.iter().map(|shot| Ok(self.image(shot))).collect()
    }
}

impl Toy {
    fn image(&self, shot: &MapRequest<'_>) -> Image {
        let n = self.dimension;
        let (x, rows) = (self.rule)(shot.parameters, &shot.start.x);
        Image {
            place: place(&x),
            derivative: Some(Matrix::from_fn(n, n, |i, j| rows[i * n + j])),
            crossings: Vec::new(),
            touches: Vec::new(),
        }
    }
}

pub(crate) fn place(x: &[f64]) -> MapPoint {
    MapPoint {
        modes: Vec::new(),
        x: x.to_vec(),
    }
}

impl Toy {
    pub(crate) fn next(&self, parameters: &[f64], x: &[f64]) -> Vec<f64> {
        (self.rule)(parameters, x).0
    }

    /// One iterate of a map of the line, and its slope.
    pub(crate) fn step(&self, parameters: &[f64], x: f64) -> (f64, f64) {
        let (next, slope) = (self.rule)(parameters, &[x]);
        (next[0], slope[0])
    }
}

/// Two bands, [0, 1) and [1, 2), on which the map is uniform: a part p of each is spread over the other, the rest
/// two and four times over itself.
pub(crate) const BANDS: Toy = Toy {
    dimension: 1,
    rule: |p, x| {
        let (band, at, stay) = (
            x[0].floor().clamp(0.0, 1.0),
            x[0] - x[0].floor(),
            1.0 - p[0],
        );
        if at >= stay {
            return (
                vec![1.0 - band + ((at - stay) / p[0]).min(1.0 - 1e-15)],
                vec![1.0 / p[0]],
            );
        }
        let slope = if band == 0.0 { 2.0 } else { 4.0 } / stay;
        (vec![band + (slope * at).fract()], vec![slope])
    },
};

/// Its exponent: the mean of ln slope, half of the time in each band.
pub(crate) fn bands_exponent(p: f64) -> f64 {
    let of = |folds: f64| (1.0 - p) * (folds / (1.0 - p)).ln() - p * p.ln();
    f64::midpoint(of(2.0), of(4.0))
}

/// x' = r x (1 - x).
pub(crate) const LOGISTIC: Toy = Toy {
    dimension: 1,
    rule: |p, x| {
        (
            vec![p[0] * x[0] * (1.0 - x[0])],
            vec![p[0] * (1.0 - 2.0 * x[0])],
        )
    },
};

/// x' = 2 x mod 1.
pub(crate) const DOUBLING: Toy = Toy {
    dimension: 1,
    rule: |_, x| (vec![(2.0 * x[0]).fract()], vec![2.0]),
};

/// A tent of slope p.
pub(crate) const TENT: Toy = Toy {
    dimension: 1,
    rule: |p, x| {
        let slope = if x[0] < 0.5 { p[0] } else { -p[0] };
        (vec![p[0] * x[0].min(1.0 - x[0])], vec![slope])
    },
};

/// x' = x + omega - k/(2 pi) sin(2 pi x), not reduced modulo one.
pub(crate) const CIRCLE: Toy = Toy {
    dimension: 1,
    rule: |p, x| {
        let (sin, cos) = (std::f64::consts::TAU * x[0]).sin_cos();
        let next = x[0] + p[0] - p[1] / std::f64::consts::TAU * sin;
        (vec![next], vec![1.0 - p[1] * cos])
    },
};

/// x' = 1 - a x^2 + y, y' = b x.
pub(crate) const HENON: Toy = Toy {
    dimension: 2,
    rule: |p, x| {
        let next = vec![1.0 - p[0] * x[0] * x[0] + x[1], p[1] * x[0]];
        (next, vec![-2.0 * p[0] * x[0], 1.0, p[1], 0.0])
    },
};

/// x' = r x (1 - y), y' = x.
pub(crate) const DELAYED: Toy = Toy {
    dimension: 2,
    rule: |p, x| {
        let next = vec![p[0] * x[0] * (1.0 - x[1]), x[0]];
        (next, vec![p[0] * (1.0 - x[1]), -p[0] * x[0], 1.0, 0.0])
    },
};

/// A spiral into a fixed point at 0: 0.9 times a turn by a fifth of the golden mean, with a parabola on top.
pub(crate) const SPIRAL: Toy = Toy {
    dimension: 2,
    rule: |_, x| {
        let (sin, cos) = (0.123_606_797_75 * std::f64::consts::TAU).sin_cos();
        let (c, s) = (0.9 * cos, 0.9 * sin);
        let next = vec![
            2.0 * (c * x[0] / 2.0 - s * x[1]) + 0.1 * x[0] * x[0],
            s * x[0] / 2.0 + c * x[1],
        ];
        (next, vec![c + 0.2 * x[0], -2.0 * s, s / 2.0, c])
    },
};
