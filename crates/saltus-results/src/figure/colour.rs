//! Colours that people with colour-blindness can distinguish: the palette of Okabe & Ito (2008).

/// A solid colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(
    /// Red, 0 to 255.
    pub u8,
    /// Green, 0 to 255.
    pub u8,
    /// Blue, 0 to 255.
    pub u8,
);

impl Colour {
    /// Okabe-Ito black.
    pub const BLACK: Self = Self(0, 0, 0);
    /// Okabe-Ito orange.
    pub const ORANGE: Self = Self(230, 159, 0);
    /// Okabe-Ito sky blue.
    pub const SKY: Self = Self(86, 180, 233);
    /// Okabe-Ito bluish green.
    pub const GREEN: Self = Self(0, 158, 115);
    /// Okabe-Ito yellow; weak on white, so in no automatic order.
    pub const YELLOW: Self = Self(240, 228, 66);
    /// Okabe-Ito blue.
    pub const BLUE: Self = Self(0, 114, 178);
    /// Okabe-Ito vermillion.
    pub const VERMILLION: Self = Self(213, 94, 0);
    /// Okabe-Ito reddish purple.
    pub const PURPLE: Self = Self(204, 121, 167);
    /// Neutral grey for lines that carry other marks.
    pub const GREY: Self = Self(140, 140, 140);
    /// Dark grey for reference lines.
    pub const DARK: Self = Self(70, 70, 70);

    /// Colours of periods, those of doublings first. Together with the four below they were chosen by computer so that
    /// any two differ for normal and for colour-blind eyes, and in grey: the test
    /// `classes_differ_for_all_eyes_and_in_grey` says by how much.
    const PERIODS: [(u32, Self); 8] = [
        (1, Self(0, 82, 155)),
        (2, Self(235, 133, 45)),
        (4, Self(104, 208, 146)),
        (8, Self(165, 108, 184)),
        (16, Self(9, 143, 240)),
        (3, Self(113, 61, 8)),
        (6, Self(146, 36, 213)),
        (5, Self(223, 197, 36)),
    ];
    /// Longer and rarer periods, which have no class of their own in a map: less far apart.
    const RARE: [Self; 6] = [
        Self::OTHER,
        Self(0, 128, 128),
        Self(190, 60, 90),
        Self(90, 150, 30),
        Self(240, 140, 180),
        Self(130, 119, 76),
    ];
    /// Any other period: navy.
    pub const OTHER: Self = Self(13, 47, 102);
    /// Quasi-periodic motion: slate.
    pub const QUASI_PERIODIC: Self = Self(95, 107, 126);

    /// The colour of a period, the same in all figures.
    pub fn of_period(period: u32) -> Self {
        let own = Self::PERIODS.iter().find(|(known, _)| *known == period);
        own.map_or(Self::of(&Self::RARE, period as usize), |(_, colour)| {
            *colour
        })
    }

    /// A class without order, such as chaos: nearly black.
    pub const IRREGULAR: Self = Self(24, 24, 24);
    /// A class of undecided cells: middle grey.
    pub const UNDECIDED: Self = Self(150, 150, 150);
    /// A class of cells that could not be computed, rare and to be seen: red.
    pub const FAILED: Self = Self(222, 30, 70);
    /// Cells of a map without a value: light grey.
    pub const MISSING: Self = Self(225, 225, 225);

    /// Order for curves: the first colours are the darkest on white.
    pub const CURVES: [Self; 7] = [
        Self::BLUE,
        Self::VERMILLION,
        Self::GREEN,
        Self::PURPLE,
        Self::ORANGE,
        Self::SKY,
        Self::BLACK,
    ];

    /// Order for sets side by side, such as attractors and their basins. They were chosen by computer so that
    /// any two, and each and white, differ for normal and for colour-blind eyes (test
    /// `attractors_differ_for_all_eyes`); only one is nearly black, since thin lines show hues poorly.
    pub const ATTRACTORS: [Self; 12] = [
        Self(53, 67, 255),
        Self(48, 182, 2),
        Self(144, 38, 5),
        Self(71, 206, 255),
        Self(176, 0, 176),
        Self(0, 0, 0),
        Self(250, 157, 170),
        Self(0, 90, 102),
        Self(179, 217, 0),
        Self(158, 131, 255),
        Self(130, 119, 76),
        Self(245, 69, 169),
    ];

    /// Order for shades behind curves: those that differ most when drawn with little opacity.
    pub(crate) const SHADES: [Self; 4] = [Self::SKY, Self::YELLOW, Self::VERMILLION, Self::DARK];

    /// Order for clouds of points: most of them are of the first.
    pub(crate) const CLOUDS: [Self; 6] = [
        Self::BLACK,
        Self::VERMILLION,
        Self::BLUE,
        Self::GREEN,
        Self::PURPLE,
        Self::ORANGE,
    ];

    /// Order for stroboscopic points over a thin line.
    pub(crate) const POINTS: [Self; 5] = [
        Self::VERMILLION,
        Self::BLUE,
        Self::BLACK,
        Self::GREEN,
        Self::PURPLE,
    ];

    /// The colour for number `index` of `order`, starting over at its end.
    pub(crate) fn of(order: &[Self], index: usize) -> Self {
        order[index % order.len()]
    }

    /// As written in SVG: `#rrggbb`.
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_is_what_svg_reads() {
        assert_eq!(Colour::VERMILLION.hex(), "#d55e00");
        assert_eq!(Colour::of(&Colour::CURVES, 7), Colour::BLUE);
    }

    /// Colours as a person without one kind of cone sees them, from linear RGB (Machado, Oliveira & Fernandes 2009,
    /// severity 1).
    const EYES: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ],
    ];

    fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| (0..3).map(|j| matrix[i][j] * v[j]).sum())
    }

    fn linear(colour: Colour) -> [f64; 3] {
        [colour.0, colour.1, colour.2].map(|v| {
            let v = f64::from(v) / 255.0;
            if v <= 0.04045 {
                v / 12.92
            } else {
                ((v + 0.055) / 1.055).powf(2.4)
            }
        })
    }

    /// Lightness between 0 and 1 as CIELAB has it, from Ottosson's (2020) cube root.
    fn toe(l: f64) -> f64 {
        let (k1, k2) = (0.206, 0.03);
        let k3 = (1.0 + k1) / (1.0 + k2);
        let x = k3 * l - k1;
        0.5 * (x + (x * x + 4.0 * k2 * k3 * l).sqrt())
    }

    /// Oklab (Ottosson 2020), in which equal distances look about equal.
    fn oklab(rgb: [f64; 3]) -> [f64; 3] {
        let to_cones = [
            [0.4122214708, 0.5363325363, 0.0514459929],
            [0.2119034982, 0.6806995451, 0.1073969566],
            [0.0883024619, 0.2817188376, 0.6299787005],
        ];
        let to_lab = [
            [0.2104542553, 0.7936177850, -0.0040720468],
            [1.9779984951, -2.4285922050, 0.4505937099],
            [0.0259040371, 0.7827717662, -0.8086757660],
        ];
        let rgb = rgb.map(|v| v.clamp(0.0, 1.0));
        let mut lab = times(&to_lab, times(&to_cones, rgb).map(f64::cbrt));
        lab[0] = toe(lab[0]);
        lab
    }

    #[test]
    fn classes_differ_for_all_eyes_and_in_grey() {
        let mut classes = Colour::PERIODS.map(|(_, colour)| colour).to_vec();
        classes.extend([
            Colour::OTHER,
            Colour::QUASI_PERIODIC,
            Colour::IRREGULAR,
            Colour::UNDECIDED,
            Colour::FAILED,
        ]);
        let grey = |colour| {
            let [r, g, b] = linear(colour);
            toe((0.2126 * r + 0.7152 * g + 0.0722 * b).cbrt())
        };
        for (i, &one) in classes.iter().enumerate() {
            for &two in &classes[..i] {
                assert!((grey(one) - grey(two)).abs() > 0.03, "{one:?} {two:?}");
                // Yellow-blue blindness, the last, is rarer than one in ten thousand.
                differ(one, two, [0.13, 0.09, 0.09, 0.08]);
            }
        }
    }

    /// Asserts that two colours are as far apart as `least` for each kind of eyes.
    fn differ(one: Colour, two: Colour, least: [f64; 4]) {
        for (eye, least) in EYES.iter().zip(least) {
            let (a, b) = (
                oklab(times(eye, linear(one))),
                oklab(times(eye, linear(two))),
            );
            let distance = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
            assert!(distance > least, "{one:?} {two:?}: {distance}");
        }
    }

    #[test]
    fn attractors_differ_for_all_eyes() {
        let mut colours = Colour::ATTRACTORS.to_vec();
        colours.push(Colour(255, 255, 255));
        for (i, &one) in colours.iter().enumerate() {
            for &two in &colours[..i] {
                // Farther than the classes of a map, which differ in grey also.
                differ(one, two, [0.18, 0.13, 0.13, 0.11]);
            }
        }
    }
}
