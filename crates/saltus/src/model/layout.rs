//! The places of the coordinates in the state vector.

/// Numbers of coordinates, and with them the place of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// In-plane amplitudes; 0 in the condensed model.
    pub(crate) in_plane: usize,
    pub(crate) transverse: usize,
    pub(crate) jumpers: usize,
    /// Whether each leg has a state of its own.
    pub(crate) legs: bool,
}

impl Layout {
    pub(crate) fn p(self, i: usize) -> usize {
        i
    }
    pub(crate) fn dp(self, i: usize) -> usize {
        self.in_plane + i
    }
    pub(crate) fn r(self, j: usize) -> usize {
        2 * self.in_plane + j
    }
    pub(crate) fn dr(self, j: usize) -> usize {
        2 * self.in_plane + self.transverse + j
    }
    pub(crate) fn z(self, i: usize) -> usize {
        2 * (self.in_plane + self.transverse) + i
    }
    pub(crate) fn dz(self, i: usize) -> usize {
        self.z(0) + self.jumpers + i
    }
    pub(crate) fn leg(self, i: usize) -> usize {
        self.z(0) + 2 * self.jumpers + i
    }
    pub(crate) fn len(self) -> usize {
        self.leg(0) + if self.legs { self.jumpers } else { 0 }
    }
}
