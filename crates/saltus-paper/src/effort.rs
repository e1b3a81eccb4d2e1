//! The work that is spent on the paper: as printed results need it, or a quick look.

/// Numbers of values, periods and starts; what each costs is said by methods beside the work.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// Damping ratios in a bifurcation diagram, from 0.1 to 0.5.
    pub values: usize,
    /// Damping ratios in the diagrams of the other contact laws.
    pub law_values: usize,
    /// Periods before anything is kept.
    pub transient: u64,
    /// Periods kept.
    pub record: u64,
    /// Starts (z/eta, z'/(eta omega_h)) beside the up- and down-sweeps.
    pub starts: Vec<(f64, f64)>,
    /// Damping ratios at which full and condensed are compared, in each panel.
    pub full_values: usize,
    /// Periods for that.
    pub full_periods: (u64, u64),
    /// Periods an exponent is averaged over.
    pub exponent_periods: u64,
    /// Periods the exponents along a panel are averaged over.
    pub panel_exponent_periods: u64,
    /// Damping ratios at which attractors are counted.
    pub census_values: usize,
    /// Starts at each.
    pub census_starts: usize,
    /// Periods that a motion of the rising or the falling sweep that does not repeat is given to end on a cycle.
    pub patience: u64,
    /// Doublings of the period whose branches are followed over the whole range.
    pub doublings: usize,
    /// Longest period of a cycle beside the main branch whose branch is followed over the whole range; longer ones are
    /// followed as far as they are stable.
    pub islands: usize,
    /// Longest period of a cycle whose doubling is sought in a cascade.
    pub cascade_period: usize,
}

impl Effort {
    /// The paper's resolution and better: steps of 0.001 in zeta_h.
    pub fn full() -> Self {
        Self {
            values: 401,
            law_values: 201,
            transient: 300,
            record: 100,
            starts: vec![(3.0, 2.0), (0.0, 0.0), (-2.0, 1.0)],
            full_values: 17,
            full_periods: (150, 50),
            exponent_periods: 5000,
            panel_exponent_periods: 300,
            census_values: 41,
            census_starts: 32,
            patience: 2000,
            doublings: 2,
            islands: 6,
            cascade_period: 64,
        }
    }

    /// A look in seconds.
    pub fn quick() -> Self {
        Self {
            values: 81,
            law_values: 41,
            transient: 150,
            record: 50,
            starts: vec![(3.0, 2.0), (0.0, 0.0)],
            full_values: 5,
            full_periods: (40, 20),
            exponent_periods: 500,
            panel_exponent_periods: 60,
            census_values: 17,
            census_starts: 8,
            patience: 500,
            doublings: 0,
            islands: 0,
            cascade_period: 8,
        }
    }
}
