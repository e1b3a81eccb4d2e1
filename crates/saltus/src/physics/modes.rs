//! The sine terms that carry the plate's displacements. DP Eqs. (3a-c).
//!
//! # Departures from the paper
//! The paper announces 16 degrees of freedom and prints 14 names, one of them (`u_{1,2}`) among the
//! v terms. [`ModeSet::dias_del_prado`] is the reading 6 u + 6 v + 4 w that gives the printed
//! occupied frequencies; without w_31 the body's would be 2.5382 Hz instead of 2.537 Hz.

use super::PhysicsError;
use std::collections::HashSet;
use std::ops::RangeInclusive;

/// Largest half-wave number that [`ModeSet::check`] lets pass. A plate theory without shear has
/// stopped to be one long before.
const MAX_HALF_WAVES: u32 = 1000;

/// Half-wave numbers of one term: m along the length, n along the width.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Mode {
    /// Half-waves along x.
    pub m: u32,
    /// Half-waves along y.
    pub n: u32,
}

impl Mode {
    /// The term (m, n).
    pub const fn new(m: u32, n: u32) -> Self {
        Self { m, n }
    }
}

/// Shape of the in-plane terms; both hold the edges against in-plane displacement along the normal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum InPlaneBasis {
    /// u and v both sin-sin: every in-plane displacement vanishes on every edge (DP).
    #[default]
    Fixed,
    /// u = sin(m pi x/a) cos(n pi y/b), v = cos sin: normal displacement and shear vanish on the
    /// edges, as Levy (1942) and Chu & Herrmann (1956). The cosine index may be 0.
    ShearFree,
}

/// The terms of u, v and w, in the order of the generalized coordinates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModeSet {
    /// Terms of the in-plane displacement along x.
    pub u: Vec<Mode>,
    /// Terms of the in-plane displacement along y.
    pub v: Vec<Mode>,
    /// Terms of the transverse displacement.
    pub w: Vec<Mode>,
}

fn modes(list: &[(u32, u32)]) -> Vec<Mode> {
    list.iter().map(|&(m, n)| Mode::new(m, n)).collect()
}

impl ModeSet {
    /// The 16 terms of DP section 3, misprints mended.
    pub fn dias_del_prado() -> Self {
        Self {
            u: modes(&[(2, 1), (2, 3), (4, 1), (4, 3), (6, 1), (8, 1)]),
            v: modes(&[(1, 2), (1, 4), (1, 6), (1, 8), (3, 2), (3, 4)]),
            w: modes(&[(1, 1), (1, 3), (3, 1), (3, 3)]),
        }
    }

    /// All w terms with 1..=`m` half-waves along x and 1..=`n` along y, and all in-plane terms up
    /// to 2`m` and 2`n` half-waves: what products of two w slopes contain.
    ///
    /// With [`InPlaneBasis::ShearFree`] these in-plane terms (cosine index 0 included) are exactly
    /// those that such products excite: longer lists change nothing. With
    /// [`InPlaneBasis::Fixed`] the response to a product of slopes is an infinite sine series;
    /// the same limits cut it and leave the plate slightly too stiff: on a square plate by 6 % in
    /// the cubic coefficient of (1, 1) for `complete(1, 1)`, by 0.04 % for `complete(4, 4)`. The
    /// highest w terms always lack some per cent.
    pub fn complete(m: u32, n: u32, basis: InPlaneBasis) -> Self {
        // one beyond the limit is enough for `check` to refuse
        let (m, n) = (m.min(MAX_HALF_WAVES + 1), n.min(MAX_HALF_WAVES + 1));
        let cosine = match basis {
            InPlaneBasis::Fixed => 1,
            InPlaneBasis::ShearFree => 0,
        };
        Self {
            u: grid(1..=2 * m, cosine..=2 * n),
            v: grid(cosine..=2 * m, 1..=2 * n),
            w: grid(1..=m, 1..=n),
        }
    }

    /// Number of terms of u, v and w together.
    pub fn count(&self) -> usize {
        self.u.len() + self.v.len() + self.w.len()
    }

    /// Checks the three lists.
    ///
    /// # Errors
    /// [`PhysicsError::Modes`] if w is empty, a term occurs twice in a list, or a half-wave number
    /// is 0 (other than that of a cosine) or above 1000.
    pub fn check(&self, basis: InPlaneBasis) -> Result<(), PhysicsError> {
        let refuse = |reason| Err(PhysicsError::Modes { reason });
        if self.w.is_empty() {
            return refuse("w is empty; it needs at least one term, such as (1, 1)".into());
        }
        let cosine = match basis {
            InPlaneBasis::Fixed => 1,
            InPlaneBasis::ShearFree => 0,
        };
        for (name, list, least) in [
            ("u", &self.u, Mode::new(1, cosine)),
            ("v", &self.v, Mode::new(cosine, 1)),
            ("w", &self.w, Mode::new(1, 1)),
        ] {
            let mut seen = HashSet::new();
            for &mode in list {
                let Mode { m, n } = mode;
                if m < least.m || n < least.n {
                    return refuse(format!(
                        "{name} lists ({m}, {n}); its half-wave numbers start at ({}, {})",
                        least.m, least.n
                    ));
                }
                if m.max(n) > MAX_HALF_WAVES {
                    return refuse(format!(
                        "{name} lists ({m}, {n}); half-wave numbers end at {MAX_HALF_WAVES}"
                    ));
                }
                if !seen.insert(mode) {
                    return refuse(format!("{name} lists ({m}, {n}) twice"));
                }
            }
        }
        Ok(())
    }
}

fn grid(m: RangeInclusive<u32>, n: RangeInclusive<u32>) -> Vec<Mode> {
    m.flat_map(|m| n.clone().map(move |n| Mode::new(m, n)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_has_sixteen_terms() {
        let set = ModeSet::dias_del_prado();
        assert_eq!(set.count(), 16);
        assert_eq!(set.check(InPlaneBasis::Fixed), Ok(()));
    }

    #[test]
    fn complete_sets_are_complete() {
        let fixed = ModeSet::complete(3, 2, InPlaneBasis::Fixed);
        assert_eq!((fixed.u.len(), fixed.v.len(), fixed.w.len()), (24, 24, 6));
        let free = ModeSet::complete(3, 2, InPlaneBasis::ShearFree);
        assert_eq!(
            (free.u.len(), free.v.len(), free.w.len()),
            (6 * 5, 7 * 4, 6)
        );
        assert_eq!(fixed.check(InPlaneBasis::Fixed), Ok(()));
        assert_eq!(free.check(InPlaneBasis::ShearFree), Ok(()));
        assert!(free.check(InPlaneBasis::Fixed).is_err());
    }

    #[test]
    fn bad_lists_are_refused_with_a_reason() {
        let message = |u: &[(u32, u32)], w: &[(u32, u32)]| {
            let set = ModeSet {
                u: modes(u),
                v: Vec::new(),
                w: modes(w),
            };
            set.check(InPlaneBasis::ShearFree)
                .map_err(|error| error.to_string())
        };
        let refused = |reason: &str| Err(format!("plate.modes: {reason}"));
        assert_eq!(message(&[(1, 0)], &[(1, 1)]), Ok(()));
        assert_eq!(
            message(&[], &[]),
            refused("w is empty; it needs at least one term, such as (1, 1)")
        );
        assert_eq!(
            message(&[], &[(1, 1), (3, 1), (1, 1)]),
            refused("w lists (1, 1) twice")
        );
        assert_eq!(
            message(&[(0, 2)], &[(1, 1)]),
            refused("u lists (0, 2); its half-wave numbers start at (1, 0)")
        );
        assert_eq!(
            message(&[], &[(1, 1001)]),
            refused("w lists (1, 1001); half-wave numbers end at 1000")
        );
        for (m, n) in [(0, 3), (u32::MAX, 1)] {
            assert!(
                ModeSet::complete(m, n, InPlaneBasis::Fixed)
                    .check(InPlaneBasis::Fixed)
                    .is_err()
            );
        }
    }
}
