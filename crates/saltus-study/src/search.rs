//! The lengths of a search for an attractor.

/// Lengths of a search for the attractor that a start leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Forcing periods, at most, before anything is recorded.
    pub transient: u64,
    /// Periods recorded of a motion that has not surely settled before.
    pub record: u64,
    /// Whether the transient ends as soon as the motion has surely settled. The answer is the same within
    /// 1e-6; without it each start takes all its periods.
    pub early_stop: bool,
    /// Forcing periods, at most, over which the largest exponent of a motion without a period is followed, to
    /// say what it is. 0 leaves it at [`MotionKind::NotPeriodic`](saltus_orbits::MotionKind::NotPeriodic).
    pub exponent: u64,
    /// Forcing periods for which a motion that was found to be chaotic is run on, to see whether it stays so. A
    /// transient that outlives all of these is called chaotic; [`Found::periods`](crate::Found::periods) says over how
    /// many it was seen.
    pub watch: u64,
    /// Whether Newton's method confirms every cycle, and not only those of which the samples leave a doubt: for
    /// motions that were carried to where they start, since those may sit on an unstable one.
    pub confirm: bool,
}

impl Default for Search {
    /// 400 periods: what loses a tenth of its amplitude per period is gone by then. 64 recorded show
    /// each period up to 32 twice. 2000 tell an exponent of 0.02 from zero. 500 more are about what it takes to find
    /// chaos, and cost less, since they need neither its tangent nor its peaks.
    fn default() -> Self {
        Self {
            transient: 400,
            record: 64,
            early_stop: true,
            exponent: 2000,
            watch: 500,
            confirm: false,
        }
    }
}
