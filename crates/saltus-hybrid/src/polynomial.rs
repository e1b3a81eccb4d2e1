//! Where a polynomial on [0, 1] first falls through zero, without missing a root.
//!
//! In Bernstein form a polynomial lies within the hull of its coefficients and has at most as many
//! roots as they have sign changes (Descartes). Halving the interval until each piece has none or
//! one finds every root, a touch between two samples included; what stays undecided down to the
//! rounding of the interval is a tangency. See Mourrain, Rouillier & Roy (2005).

/// Highest degree handled.
pub(crate) const MAX_DEGREE: usize = 30;

/// The answer of [`first_descent`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Descent {
    /// Where it falls through zero first, in (0, 1].
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
    /// By k, then j from k on.
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
    let mut out = Descent {
        at: None,
        touches: 0,
        touch_at: 0.0,
    };
    if table.clears(power) {
        return out;
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
                out.at = Some(1.0);
                return out;
            }
            if b[degree] <= noise {
                out.note_touch(piece.hi);
            } else if b[0] <= noise {
                out.note_touch(piece.lo);
            }
            continue;
        }
        let changes = sign_changes(b);
        if changes == 1 && b[0] > 0.0 && b[degree] < 0.0 {
            let chord = b[0] / (b[0] - b[degree]);
            let guess = piece.lo + chord * (piece.hi - piece.lo);
            out.at = Some(refine(power, piece.lo, piece.hi, guess));
            return out;
        }
        if changes == 0 && piece.lo > 0.0 {
            // Wholly negative: the crossing sat on the edge between two pieces.
            out.touches -= u32::from(out.touches > 0 && out.touch_at == piece.lo);
            out.at = Some(piece.lo);
            return out;
        }
        if narrow {
            continue; // rounding of the coefficients, not a root
        }
        let (left, right) = halve(&piece, degree);
        stack.extend(next.take());
        stack.push(right);
        next = Some(left);
    }
    out
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
    /// Counts a tangency inside the step, once.
    fn note_touch(&mut self, at: f64) {
        let again = self.touches > 0 && (at - self.touch_at).abs() < SAME_TOUCH;
        if at > 0.0 && at < 1.0 && !again {
            self.touches += 1;
            self.touch_at = at;
        }
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
    fn no_root_no_crossing() {
        assert_eq!(first(&[1.0, 0.5, -0.3]).at, None);
        assert_eq!(first(&with_roots(&[1.5, 2.0, -0.5], -1.0)).at, None);
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
        assert_eq!(minima(&[1.0, 1.0]).count(), 0);
        assert_eq!(minima(&[1.0, -1.0]).count(), 0);
    }
}
