//! Colour scales for continuous values: perceptually uniform, safe for colour-blind readers, monotone in grey.

use super::colour::Colour;

/// A scale from values to colours: those of d3-scale-chromatic, from the crate colorous.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColourScale {
    /// From dark violet over green to yellow (Smith & van der Walt 2015, the default of matplotlib).
    #[default]
    Viridis,
    /// From dark blue over grey to yellow, nearly the same for colour-blind readers (Nuñez, Anderton &
    /// Renslow 2018, doi:10.1371/journal.pone.0199239).
    Cividis,
}

impl ColourScale {
    /// The colour at `share` between 0, dark, and 1, light; beyond them that of the nearest end.
    pub fn at(self, share: f64) -> Colour {
        let gradient = match self {
            Self::Viridis => colorous::VIRIDIS,
            Self::Cividis => colorous::CIVIDIS,
        };
        let (red, green, blue) = gradient.eval_continuous(share.clamp(0.0, 1.0)).as_tuple();
        Colour(red, green, blue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: Colour, b: Colour) -> u8 {
        a.0.abs_diff(b.0)
            .max(a.1.abs_diff(b.1))
            .max(a.2.abs_diff(b.2))
    }

    #[test]
    fn the_colours_are_the_published_ones() {
        // Entries 0, 100 and 255 of 256 in matplotlib 3.10.
        let viridis = [
            (0.0, Colour(68, 1, 84)),
            (100.0, Colour(42, 118, 142)),
            (255.0, Colour(253, 231, 37)),
        ];
        let cividis = [
            (0.0, Colour(0, 34, 78)),
            (100.0, Colour(101, 104, 112)),
            (255.0, Colour(254, 232, 56)),
        ];
        for (entry, colour) in viridis {
            assert!(apart(ColourScale::Viridis.at(entry / 255.0), colour) <= 2);
        }
        // d3 fits polynomials to this table, which stray most at the yellow end.
        for (entry, colour) in cividis {
            assert!(apart(ColourScale::Cividis.at(entry / 255.0), colour) <= 13);
        }
    }

    #[test]
    fn lighter_is_more() {
        for scale in [ColourScale::Viridis, ColourScale::Cividis] {
            let grey = |share| {
                let Colour(red, green, blue) = scale.at(share);
                0.2126 * f64::from(red) + 0.7152 * f64::from(green) + 0.0722 * f64::from(blue)
            };
            assert!((0..50).all(|i| grey(f64::from(i) / 50.0) < grey(f64::from(i + 1) / 50.0)));
            assert_eq!(scale.at(f64::NAN.max(2.0)), scale.at(1.0));
        }
    }
}
