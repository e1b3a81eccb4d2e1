//! Colours of attractors: that of the period for the first of each, so that a colour means the same in all figures.

use saltus::orbits::MotionKind;
use saltus_results::Colour;

/// A colour for each of `kinds`; `None` when there are no more.
pub fn of(kinds: impl IntoIterator<Item = MotionKind>) -> Vec<Option<Colour>> {
    let mut taken: Vec<Colour> = Vec::new();
    let colour = |kind: MotionKind| {
        let own = match kind {
            MotionKind::Periodic(n) => Colour::of_period(n),
            MotionKind::QuasiPeriodic => Colour::QUASI_PERIODIC,
            _ => Colour::IRREGULAR,
        };
        let mut more = Colour::ATTRACTORS.into_iter();
        let free = |colour: &Colour| !taken.contains(colour);
        let colour = Some(own).filter(free).or_else(|| more.find(free));
        taken.extend(colour);
        colour
    };
    kinds.into_iter().map(colour).collect()
}
