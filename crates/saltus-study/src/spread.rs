//! Starts spread evenly over a box of states: Sobol's sequence with Owen's scrambling [Burley 2020].
//!
//! The first 2^m points of the sequence fill a box more evenly than independent ones, so small basins are met
//! sooner and shares come out closer. Unlike multiples of an irrational number it stays even in the many
//! dimensions of a large system, and it is integer arithmetic: the same starts on every machine.

/// Length of the sequence, and its dimensions.
const LENGTH: usize = 1 << 16;
const DIMENSIONS: usize = 256;

/// Dimension `dimension` of point `number`, in [0, 1). Beyond what the sequence has, another scramble of it: independent, not repeated.
pub fn spread(number: usize, dimension: usize) -> f64 {
    let seed = (number / LENGTH) * 0x1_0001 + dimension / DIMENSIONS;
    let (index, dimension) = (number % LENGTH, dimension % DIMENSIONS);
    sobol_burley::sample(index as u32, dimension as u32, seed as u32).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixty_four_starts_meet_each_cell_of_a_chessboard_once() {
        // the first two dimensions are a (0, 2)-sequence in base 2 [Sobol 1967]
        let mut cells: Vec<usize> = (0..64)
            .map(|k| [0, 1].map(|dimension| (8.0 * spread(k, dimension)) as usize))
            .map(|[row, column]| 8 * row + column)
            .collect();
        cells.sort_unstable();
        assert_eq!(cells, (0..64).collect::<Vec<_>>());
    }

    #[test]
    fn the_sequence_goes_on_beyond_its_length_and_its_dimensions() {
        assert_ne!(spread(7, 1), spread(7 + LENGTH, 1));
        assert_ne!(spread(7, 1), spread(7, 1 + DIMENSIONS));
        let mean = (LENGTH..LENGTH + 64).map(|k| spread(k, 300)).sum::<f64>() / 64.0;
        // 64 points, one in each 64th: their mean is off by less than a cell
        assert!((mean - 0.5).abs() < 1.0 / 64.0, "{mean}");
    }
}
