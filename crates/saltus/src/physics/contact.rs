//! Contact laws: when the feet leave the floor and when they are back. Three answers from the literature.

/// The law that decides between contact and flight.
///
/// With d = w_P - z the leg's compression and F = k_h d + c_h d' its force on the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ContactLaw {
    /// Contact while F > 0, both ways (DP, below Eq. (13)). The force is max(0, F): continuous, so
    /// nothing jumps at a switch. The price: with damping the foot "touches" while it is still
    /// 2 zeta_h v/omega_h above the floor.
    #[default]
    ReactionForce,
    /// In flight the leg springs back to its natural length at once. Take-off when F falls to 0;
    /// touch-down when the gap closes (d rises through 0), or when F turns compressive again while
    /// the gap is still closed. The force jumps by c_h v at touch-down.
    Gap,
    /// A massless leg whose compression s relaxes in flight by k_h s + c_h s' = 0; touch-down when
    /// the floor catches up with the foot (d rises through s). Needs c_h > 0.
    RelaxingLeg,
}

impl ContactLaw {
    /// All laws, the paper's first.
    pub const ALL: [Self; 3] = [Self::ReactionForce, Self::Gap, Self::RelaxingLeg];

    /// The word used in study files and legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::ReactionForce => "reaction-force",
            Self::Gap => "gap",
            Self::RelaxingLeg => "relaxing-leg",
        }
    }
}
