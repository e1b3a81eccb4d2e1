//! The first place on [0, 1] at which a polynomial falls through zero, without missing a root.
//!
//! In Bernstein form a polynomial lies within the hull of its coefficients and has at most as many
//! roots as they have sign changes (Descartes). Halving the interval until each piece has none or
//! one finds every root, a touch between two samples included; a piece that stays undecided down to the
//! rounding of the interval is a tangency. See Mourrain, Rouillier & Roy (2005).

/// Highest degree handled.
pub(crate) const MAX_DEGREE: usize = 30;

/// The answer of [`first_descent`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Descent {
    /// The first place in (0, 1] at which it falls through zero.
    pub(crate) at: Option<f64>,
    /// Tangencies before that: places where it touches zero, to rounding, and stays positive.
    pub(crate) touches: u32,
    /// The last of them.
    pub(crate) touch_at: f64,
}

/// Rounding of the Bernstein coefficients, relative to the largest: a dip below zero that is not
/// deeper is a tangency.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// A step of Newton's method, relative to the root, after which the root is exact to rounding.
const CONVERGED: f64 = 1e-10;

/// Degree up to which a polynomial is looked at first: higher terms of a series that converges are
/// small, and bounded by their absolute values.
pub(crate) const HEAD: usize = 7;

/// Tangencies closer than this part of a step are one: the polynomial is flat there to rounding.
const SAME_TOUCH: f64 = 1e-6;

/// Weights w[j][k] = C(j, k)/C(p, k) that turn power coefficients into Bernstein coefficients.
#[derive(Clone, Debug)]
pub(crate) struct BernsteinTable {
    degree: usize,
    /// Ordered by k, then j from k on.
    columns: Vec<f64>,
    /// The table for the head of a longer polynomial.
    pub(crate) head: Option<Box<Self>>,
}

impl BernsteinTable {
    pub(crate) fn new(degree: usize) -> Self {
        let mut columns = Vec::with_capacity((degree + 1) * (degree + 2) / 2);
        for k in 0..=degree {
            for j in k..=degree {
                let factor = |i: usize| (j - i) as f64 / (degree - i) as f64;
                columns.push((0..k).map(factor).product());
            }
        }
        Self {
            degree,
            columns,
            head: (degree > HEAD).then(|| Box::new(Self::new(HEAD))),
        }
    }

    /// Weights of power coefficient k in the Bernstein coefficients k..=degree.
    #[inline(always)]
    pub(crate) fn column(&self, k: usize) -> &[f64] {
        let begin = k * (2 * self.degree + 3 - k) / 2;
        &self.columns[begin..begin + self.degree + 1 - k]
    }

    /// Whether the polynomial is positive on [0, 1], as far as its head and a bound on the rest tell.
    fn clears(&self, power: &[f64]) -> bool {
        let Some(table) = &self.head else {
            return false;
        };
        let (head, rest) = power.split_at(HEAD + 1);
        let mut b = [0.0; HEAD + 1];
        table.convert(head, &mut b);
        let lowest = b.iter().fold(f64::INFINITY, |m, &v| m.min(v));
        let highest = b.iter().fold(0.0, |m: f64, &v| m.max(v));
        lowest > rest.iter().map(|a| a.abs()).sum::<f64>() + 2.0 * NOISE * highest
    }

    fn convert(&self, power: &[f64], bernstein: &mut [f64]) {
        bernstein.fill(power[0]);
        for (k, a) in power.iter().enumerate().skip(1) {
            for (out, w) in bernstein[k..].iter_mut().zip(self.column(k)) {
                *out += w * a;
            }
        }
    }
}

/// p(x) and p'(x) by Horner's scheme in x^2 for the even and the odd part, which need not wait for each
/// other.
fn value_and_slope(power: &[f64], x: f64) -> (f64, f64) {
    let u = x * x;
    let (mut even, mut even_rate, mut odd, mut odd_rate) = (0.0, 0.0, 0.0, 0.0);
    let (pairs, last) = power.as_chunks::<2>();
    if let [last] = last {
        even = *last;
    }
    for [a, b] in pairs.iter().rev() {
        even_rate = even_rate * u + even;
        odd_rate = odd_rate * u + odd;
        even = even * u + a;
        odd = odd * u + b;
    }
    (even + x * odd, odd + 2.0 * x * (even_rate + x * odd_rate))
}

/// Newton within a bracket, p(lo) > 0 > p(hi) or p(hi) = 0, halving where Newton leaves it; `x` is the
/// first guess.
fn refine(power: &[f64], mut lo: f64, mut hi: f64, mut x: f64) -> f64 {
    for _ in 0..100 {
        let (p, dp) = value_and_slope(power, x);
        if p == 0.0 {
            return x;
        }
        if p > 0.0 {
            lo = x;
        } else {
            hi = x;
        }
        let newton = x - p / dp;
        let next = if newton >= lo && newton <= hi {
            newton
        } else {
            0.5 * (lo + hi)
        };
        // Newton squares its error: after so small a step the next one is below rounding.
        if (next - x).abs() <= CONVERGED * x {
            return next;
        }
        x = next;
    }
    x
}

/// One piece [lo, hi] of the search, in Bernstein form.
#[derive(Clone, Copy)]
struct Piece {
    lo: f64,
    hi: f64,
    b: [f64; MAX_DEGREE + 1],
}

/// Splits in the middle by de Casteljau's algorithm.
fn halve(piece: &Piece, degree: usize) -> (Piece, Piece) {
    let middle = 0.5 * (piece.lo + piece.hi);
    let (mut left, mut right) = (*piece, *piece);
    left.hi = middle;
    right.lo = middle;
    for level in 1..=degree {
        left.b[level - 1] = right.b[0];
        for i in 0..=degree - level {
            right.b[i] = 0.5 * (right.b[i] + right.b[i + 1]);
        }
    }
    left.b[degree] = right.b[0];
    (left, right)
}

/// First root in (0, 1] at which the polynomial, positive just after 0, turns negative (or where it
/// vanishes at 1 itself). `power` are its coefficients and `table` fits its length.
pub(crate) fn first_descent(power: &[f64], table: &BernsteinTable) -> Descent {
    let degree = table.degree;
    debug_assert_eq!(power.len(), degree + 1);
    let mut touched = Vec::new();
    if table.clears(power) {
        return Descent::new(None, touched);
    }
    let mut root = Piece {
        lo: 0.0,
        hi: 1.0,
        b: [0.0; MAX_DEGREE + 1],
    };
    table.convert(power, &mut root.b[..=degree]);
    let noise = NOISE
        * root.b[..=degree]
            .iter()
            .fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut stack = Vec::new();
    let mut next = Some(root);
    while let Some(piece) = next {
        next = stack.pop();
        let b = &piece.b[..=degree];
        let lowest = b.iter().fold(f64::INFINITY, |m, &v| m.min(v));
        // The hull of a piece may reach zero where the polynomial itself does not: halve until an
        // end, which is a value, does.
        let decided = lowest > noise || b[0] <= noise || b[degree] <= noise;
        let narrow = (piece.hi - piece.lo).abs() < f64::EPSILON;
        if lowest >= -noise && (decided || narrow) {
            if piece.hi == 1.0 && b[degree] == 0.0 && b[degree - 1] > 0.0 {
                return Descent::new(Some(1.0), touched);
            }
            // A touch at its other end was one at the end of the piece before.
            if b[degree] <= noise {
                note_touch(&mut touched, piece.hi);
            }
            continue;
        }
        let changes = sign_changes(b);
        if changes == 1 && b[0] > 0.0 && b[degree] < 0.0 {
            let chord = b[0] / (b[0] - b[degree]);
            let guess = piece.lo + chord * (piece.hi - piece.lo);
            return Descent::new(Some(refine(power, piece.lo, piece.hi, guess)), touched);
        }
        if changes == 0 && piece.lo > 0.0 {
            // Wholly negative: the crossing sat on the edge between two pieces.
            return Descent::new(Some(piece.lo), touched);
        }
        if narrow {
            continue; // rounding of the coefficients, not a root
        }
        let (left, right) = halve(&piece, degree);
        stack.extend(next.take());
        stack.push(right);
        next = Some(left);
    }
    Descent::new(None, touched)
}

/// Pieces that [`minima`] looks at.
const PIECES: usize = 8;

/// Places in (0, 1] where the polynomial falls and then rises, and its values there: as many as show between
/// [`PIECES`] equal pieces.
pub(crate) fn minima(power: &[f64]) -> impl Iterator<Item = (f64, f64)> {
    let mut fall = [0.0; MAX_DEGREE + 1];
    for (k, a) in power.iter().enumerate().skip(1) {
        fall[k - 1] = -(k as f64) * a;
    }
    (0..PIECES).filter_map(move |piece| {
        let end = |piece: usize| piece as f64 / PIECES as f64;
        let (lo, hi) = (end(piece), end(piece + 1));
        let [first, last] = [lo, hi].map(|x| value_and_slope(&fall, x).0);
        (first > 0.0 && last <= 0.0).then(|| {
            let at = refine(&fall, lo, hi, lo + (hi - lo) * first / (first - last));
            (at, value_and_slope(power, at).0)
        })
    })
}

impl Descent {
    /// Drops the touch that a crossing at the edge of a piece seemed to be, seen from the left.
    fn new(at: Option<f64>, mut touched: Vec<f64>) -> Self {
        if let Some(at) = at {
            touched.retain(|touch| (at - touch).abs() >= SAME_TOUCH);
        }
        Self {
            at,
            touches: touched.len() as u32,
            touch_at: touched.last().copied().unwrap_or(0.0),
        }
    }
}

/// Counts a tangency inside the step, once.
fn note_touch(touched: &mut Vec<f64>, at: f64) {
    let again = touched
        .last()
        .is_some_and(|touch| (at - touch).abs() < SAME_TOUCH);
    if at > 0.0 && at < 1.0 && !again {
        touched.push(at);
    }
}

fn sign_changes(b: &[f64]) -> usize {
    let mut last = 0.0_f64;
    let mut changes = 0;
    for &v in b.iter().filter(|&&v| v != 0.0) {
        if last * v < 0.0 {
            changes += 1;
        }
        last = v.signum();
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Power coefficients of the product of (root - x), times `sign`.
    fn with_roots(roots: &[f64], sign: f64) -> Vec<f64> {
        let mut p = vec![sign];
        for &r in roots {
            let mut next = vec![0.0; p.len() + 1];
            for (i, &a) in p.iter().enumerate() {
                next[i] += a * r;
                next[i + 1] -= a;
            }
            p = next;
        }
        p
    }

    fn first(power: &[f64]) -> Descent {
        first_descent(power, &BernsteinTable::new(power.len() - 1))
    }

    #[test]
    fn finds_a_single_root_to_rounding() {
        let at = first(&with_roots(&[0.3], 1.0)).at.expect("crosses");
        assert!((at - 0.3).abs() < 1e-15);
    }

    #[test]
    fn finds_the_first_of_three_roots() {
        // positive, then down at .2, up at .5, down at .9
        let at = first(&with_roots(&[0.2, 0.5, 0.9], 1.0))
            .at
            .expect("crosses");
        assert!((at - 0.2).abs() < 1e-14, "{at}");
    }

    #[test]
    fn finds_a_shallow_dip_between_the_ends() {
        let at = first(&with_roots(&[0.5, 0.5 + 1e-6], 1.0))
            .at
            .expect("dips");
        // a root pair 1e-6 apart moves by rounding/separation
        assert!((at - 0.5).abs() < 1e-9, "{at}");
    }

    #[test]
    fn a_double_root_is_a_touch_and_no_crossing() {
        let d = first(&with_roots(&[0.37, 0.37], 1.0));
        assert!(d.at.is_none() || (d.at.expect("some") - 0.37).abs() < 1e-7);
        let lifted = [0.37 * 0.37 + 1e-12, -0.74, 1.0];
        assert_eq!(first(&lifted).at, None);
        let exact = first(&[0.25, -1.0, 1.0]); // (x - 1/2)^2, exact in binary
        assert_eq!((exact.at, exact.touches), (None, 1));
    }

    #[test]
    fn a_root_at_the_end_counts() {
        assert_eq!(first(&[1.0, -1.0]).at, Some(1.0));
    }

    #[test]
    fn what_begins_below_zero_falls_at_once() {
        // The least place there is, since 0 itself is not in the step.
        for power in [&[-1.0, 0.5][..], &[-1.0, -0.5], &[-1e-3, 1.0, 1.0]] {
            let at = first(power).at.expect("is below");
            assert!(at > 0.0 && at <= f64::EPSILON, "{power:?} {at}");
        }
    }

    #[test]
    fn no_root_no_crossing() {
        assert_eq!(first(&[1.0, 0.5, -0.3]).at, None);
        assert_eq!(first(&with_roots(&[1.5, 2.0, -0.5], -1.0)).at, None);
    }

    /// C(n, k).
    fn binomial(n: usize, k: usize) -> f64 {
        (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64)
    }

    #[test]
    fn weights_are_ratios_of_binomials() {
        for degree in [1, 3, 7, 16, 30] {
            let table = BernsteinTable::new(degree);
            for k in 0..=degree {
                let column = table.column(k);
                assert_eq!(column.len(), degree + 1 - k);
                for (j, w) in (k..).zip(column) {
                    let exact = binomial(j, k) / binomial(degree, k);
                    assert!((w - exact).abs() <= 1e-14 * exact, "{degree} {k} {j}");
                }
            }
        }
    }

    #[test]
    fn a_root_on_the_edge_between_two_pieces_is_found_and_is_no_touch() {
        // 1/2, 1/4 and 3/4 are edges of pieces, the roots beyond force them to be made; all is exact in binary.
        for (roots, expected) in [
            (&[0.5, 0.75, 0.875][..], 0.5),
            (&[0.25, 0.375, 0.4375, 2.0, 3.0], 0.25),
            (&[0.75, 0.8125, 0.875], 0.75),
        ] {
            let d = first(&with_roots(roots, 1.0));
            assert_eq!(d.touches, 0, "{roots:?} {d:?}");
            // Rounding over the slope there, the product of the distances of the roots: at least 1/128.
            assert!(
                (d.at.expect("crosses") - expected).abs() < 3e-14,
                "{roots:?} {d:?}"
            );
        }
        // Positive just after a zero at 0.
        assert_eq!(first(&[0.0, 0.5, -1.0]).at, Some(0.5));
        // A touch at one edge stays one when it crosses at another.
        let d = first(&with_roots(&[0.25, 0.25, 0.5, 0.75, 0.875], 1.0));
        assert!((d.at.expect("crosses") - 0.5).abs() < 1e-14, "{d:?}");
        assert_eq!((d.touches, d.touch_at), (1, 0.25));
    }

    #[test]
    fn touches_are_counted_once_each_and_inside_only() {
        let touches = |roots: &[f64]| {
            let d = first(&with_roots(roots, 1.0));
            (d.at, d.touches, d.touch_at)
        };
        assert_eq!(touches(&[0.25, 0.25]), (None, 1, 0.25));
        assert_eq!(touches(&[0.25, 0.25, 0.75, 0.75]), (None, 2, 0.75));
        assert_eq!(touches(&[0.0, 0.0]), (None, 0, 0.0));
        // At its end it vanishes, but did not come down through zero.
        assert_eq!(touches(&[1.0, 1.0]), (None, 0, 0.0));
        assert_eq!(touches(&[0.5, 0.5, 1.0]), (Some(1.0), 1, 0.5));
        // Once more where it is not on an edge: a double root is known to the square root of rounding.
        let (at, count, place) = touches(&[1.0 / 3.0, 1.0 / 3.0, 2.0]);
        assert_eq!((at, count), (None, 1));
        assert!((place - 1.0 / 3.0).abs() < 1e-7, "{place}");
    }

    #[test]
    fn a_dip_is_a_crossing_if_it_is_deeper_than_rounding_and_a_touch_if_not() {
        // 1e-6 apart about r: depth 2.5e-13 beside values up to 0.5, 70 times the rounding allowed for; 1e-8 apart:
        // 2.5e-17.
        for r in [0.1, 0.3, 0.5, 0.62, 0.9] {
            let deep = first(&with_roots(&[r, r + 1e-6], 1.0));
            assert!((deep.at.expect("dips") - r).abs() < 1e-9, "{r} {deep:?}");
            let flat = first(&with_roots(&[r, r + 1e-8], 1.0));
            assert_eq!((flat.at, flat.touches), (None, 1), "{r}");
            assert!((flat.touch_at - r).abs() < 1e-7, "{r} {flat:?}");
            // The hull of its pieces reaches zero long before it does.
            let near = with_roots(&[r, r], 1.0);
            let lifted: Vec<f64> = near
                .iter()
                .enumerate()
                .map(|(k, a)| a + if k == 0 { 1e-13 } else { 0.0 })
                .collect();
            let d = first(&lifted);
            assert_eq!((d.at, d.touches), (None, 0), "{r}");
        }
    }

    #[test]
    fn the_end_of_the_step_belongs_to_it_and_what_lies_beyond_does_not() {
        let unit = f64::EPSILON;
        for (root, expected) in [(1.0, Some(1.0)), (1.0 + 64.0 * unit, None)] {
            assert_eq!(first(&[root, -1.0]).at, expected);
            assert_eq!(first(&with_roots(&[root, 2.0, 3.0], 1.0)).at, expected);
        }
        let at = first(&[1.0 - 64.0 * unit, -1.0]).at.expect("crosses");
        assert!((at - (1.0 - 64.0 * unit)).abs() <= unit);
        // It vanishes at the end from below: the crossing is the root before.
        let at = first(&with_roots(&[0.3, 1.0], 1.0)).at.expect("crosses");
        assert!((at - 0.3).abs() < 1e-15, "{at}");
    }

    proptest::proptest! {
        #[test]
        fn first_root_of_random_products(mut roots in proptest::collection::vec(-1.0..2.0_f64, 1..9)) {
            roots.sort_by(f64::total_cmp);
            // Rounding of the coefficients moves roots by the inverse of their separation.
            proptest::prop_assume!(roots.windows(2).all(|w| w[1] - w[0] > 0.02));
            proptest::prop_assume!(roots.iter().all(|r| r.abs() > 1e-3 && (r - 1.0).abs() > 1e-3));
            let below = roots.iter().filter(|&&r| r < 0.0).count();
            let sign = if below % 2 == 0 { 1.0 } else { -1.0 };
            let expected = roots.iter().copied().find(|&r| r > 0.0 && r < 1.0);
            let found = first(&with_roots(&roots, sign)).at;
            match (expected, found) {
                (None, None) => {}
                (Some(e), Some(f)) => proptest::prop_assert!((e - f).abs() < 1e-6, "{} {}", e, f),
                other => proptest::prop_assert!(false, "{:?}", other),
            }
        }
    }

    proptest::proptest! {
        #[test]
        fn value_and_slope_are_those_of_the_sum(
            power in proptest::collection::vec(-1.0..1.0_f64, 1..32), x in -1.0..1.0_f64,
        ) {
            let value: f64 = power.iter().enumerate().map(|(k, a)| a * x.powi(k as i32)).sum();
            let terms = power.iter().enumerate().skip(1);
            let slope: f64 = terms.map(|(k, a)| k as f64 * a * x.powi(k as i32 - 1)).sum();
            let (v, s) = value_and_slope(&power, x);
            // Rounding of 32 terms up to 1, and of as many up to 31.
            proptest::prop_assert!((v - value).abs() < 1e-14 && (s - slope).abs() < 2e-13);
        }

        #[test]
        fn a_root_is_refined_to_rounding_from_anywhere_in_its_bracket(
            root in 0.01..0.99_f64, guess in 0.0..1.0_f64, steep in 0.0..20.0_f64,
        ) {
            // (root - x) (1 + steep x^2), with slopes from 1 to 21.
            let power = [root, -1.0, steep * root, -steep];
            let found = refine(&power, 0.0, 1.0, guess);
            // Rounding of terms up to 20, over a slope of at least 1 + steep root^2.
            let rounding = 4.0 * f64::EPSILON * (1.0 + 2.0 * steep * root) / (1.0 + steep * root * root);
            proptest::prop_assert!((found - root).abs() <= rounding, "{} {}", found, root);
        }

        #[test]
        fn what_is_cleared_is_what_a_plain_bound_clears(
            power in proptest::collection::vec(-1.0..1.0_f64, HEAD + 2..24), lift in 0.0..12.0_f64,
        ) {
            let mut power = power;
            power[0] += lift;
            let coefficient = |j: usize| -> f64 {
                (0..=j).map(|k| binomial(j, k) / binomial(HEAD, k) * power[k]).sum()
            };
            let lowest = (0..=HEAD).map(coefficient).fold(f64::INFINITY, f64::min);
            let rest: f64 = power[HEAD + 1..].iter().map(|a| a.abs()).sum();
            let table = BernsteinTable::new(power.len() - 1);
            // Rounding and the margin for it are below 1e-12 of values up to 20.
            if (lowest - rest).abs() > 1e-12 {
                proptest::prop_assert_eq!(table.clears(&power), lowest > rest);
            }
            // A short polynomial is not looked at twice.
            proptest::prop_assert!(!BernsteinTable::new(HEAD).clears(&power[..=HEAD]));
        }

        #[test]
        fn what_is_cleared_has_no_root(
            power in proptest::collection::vec(-1.0..1.0_f64, HEAD + 2..24), lift in 0.0..6.0_f64,
        ) {
            let mut power = power;
            power[0] += lift;
            let table = BernsteinTable::new(power.len() - 1);
            if table.clears(&power) {
                for i in 0..=200 {
                    let (value, _) = value_and_slope(&power, f64::from(i) / 200.0);
                    proptest::prop_assert!(value > 0.0);
                }
                proptest::prop_assert_eq!(first_descent(&power, &table).at, None);
            }
        }
    }

    #[test]
    fn the_margin_of_what_is_cleared_covers_rounding() {
        // Touches zero at 1/2 in its head; lifted by less than the rounding of its coefficients.
        let table = BernsteinTable::new(HEAD + 1);
        let mut power = vec![0.0; HEAD + 2];
        power[..3].copy_from_slice(&[0.25 + 4.0 * f64::EPSILON, 0.0, 0.0]);
        assert!(table.clears(&power));
        power[HEAD + 1] = 0.25;
        assert!(
            !table.clears(&power),
            "the rest may be as large as the head"
        );
        power[HEAD + 1] = -0.25 + 1e-12;
        assert!(table.clears(&power));
    }

    #[test]
    fn minima_are_where_it_falls_and_then_rises() {
        // (x - 0.3)^2 (x - 0.8)^2 + 0.01: minima at both, a maximum between
        let squared = with_roots(&[0.3, 0.3, 0.8, 0.8], 1.0);
        let mut p = squared.clone();
        p[0] += 0.01;
        let found: Vec<_> = minima(&p).collect();
        assert_eq!(found.len(), 2);
        for ((at, value), expected) in found.into_iter().zip([0.3, 0.8]) {
            assert!((at - expected).abs() < 1e-7 && (value - 0.01).abs() < 1e-14);
        }
        // At the edge of a piece, (x - 1/2)^2 + 1/8, it is one and not two.
        let at_edge: Vec<_> = minima(&[0.375, -1.0, 1.0]).collect();
        assert_eq!(at_edge, [(0.5, 0.125)]);
        assert_eq!(minima(&[1.0, 1.0]).count(), 0);
        assert_eq!(minima(&[1.0, -1.0]).count(), 0);
    }
}
