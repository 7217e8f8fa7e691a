//! Where a polynomial on [0, 1] first falls below zero. No root is missed, not even one
//! where it only grazes zero.
//!
//! The sign of a polynomial is sure where its partial sums Q_k = Σ_{j≤k} q_j are all ≥ 0: by
//! Abel's summation q(s) = (1 − s) Σ_k Q_k s^k + q(1) s^{P+1}, which is ≥ 0 on [0, 1].
//! So an interval holds no root where that is so of q. It holds at most one where it is so
//! of −q' or −q'', and Newton's method, bracketed, finds it. All other intervals are bisected.

/// Number of coefficients of a polynomial: those of a Taylor series.
pub(super) const ROWS: usize = 25;

/// Bisections after which an interval is a point. A polynomial that is below zero at its end
/// crosses zero there.
const DEEPEST: u32 = 44;

/// Coefficients below this part of the largest one are left out.
const NOTHING: f64 = 1e-20;

/// √ε of a double: a Newton step of this part of the root is the last.
const HALF_THE_DIGITS: f64 = 1.5e-8;

/// A polynomial on [0, 1].
pub(super) type Polynomial = [f64; ROWS];

/// The first s in [0, 1] at which `q`, which is not below zero at 0, falls below zero; None
/// if it does not. A polynomial that is zero at 0 and falls from there does so at 0.
pub(super) fn first_below_zero(q: &Polynomial) -> Option<f64> {
    match q.iter().find(|&&c| c != 0.0) {
        None => None,
        // At zero the first coefficient that is not says where it goes.
        Some(&leading) if q[0] <= 0.0 && leading < 0.0 => Some(0.0),
        Some(_) => search(q, 0.0, 1.0, DEEPEST),
    }
}

/// The first fall of `q`, which is a polynomial on the interval of this width from `from` on.
fn search(q: &Polynomial, from: f64, width: f64, depth: u32) -> Option<f64> {
    let q = &q[..significant(q)];
    if sums_stay_above_zero(q.iter().copied()) {
        return None;
    }
    if q[0] < 0.0 {
        return Some(from);
    }
    if falls(q) || is_concave(q) {
        return root(q).map(|s| from + width * s);
    }
    if depth == 0 {
        return (q.iter().sum::<f64>() < 0.0).then_some(from);
    }
    let (left, right) = halves(q);
    let half = 0.5 * width;
    search(&left, from, half, depth - 1).or_else(|| search(&right, from + half, half, depth - 1))
}

/// How many coefficients are left when negligible last ones are left out.
fn significant(q: &Polynomial) -> usize {
    let largest = q.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let matters = |c: &f64| c.abs() > NOTHING * largest;
    q.iter().rposition(matters).map_or(1, |k| k + 1)
}

/// Whether all partial sums of these coefficients are ≥ 0.
fn sums_stay_above_zero(coefficients: impl Iterator<Item = f64>) -> bool {
    let mut sum = 0.0;
    for c in coefficients {
        sum += c;
        if sum < 0.0 {
            return false;
        }
    }
    true
}

/// Whether q' ≤ 0 on [0, 1] for sure. Then q has at most one root there.
fn falls(q: &[f64]) -> bool {
    let slope = q.iter().enumerate().skip(1);
    sums_stay_above_zero(slope.map(|(k, c)| -(k as f64) * c))
}

/// Whether q'' ≤ 0 on [0, 1] for sure. Then q, which starts above zero, has at most one root.
fn is_concave(q: &[f64]) -> bool {
    let curvature = q.iter().enumerate().skip(2);
    sums_stay_above_zero(curvature.map(|(k, c)| -((k * (k - 1)) as f64) * c))
}

/// q(s/2) and q((1 + s)/2): the two halves, each on [0, 1].
fn halves(q: &[f64]) -> (Polynomial, Polynomial) {
    let (mut left, mut right) = ([0.0; ROWS], [0.0; ROWS]);
    let mut scale = 1.0;
    for (j, c) in q.iter().enumerate() {
        let c = c * scale;
        scale *= 0.5;
        left[j] = c;
        for (r, binomial) in right[..=j].iter_mut().zip(&BINOMIAL[j]) {
            *r += binomial * c;
        }
    }
    (left, right)
}

/// Binomial coefficients (j over k).
const BINOMIAL: [[f64; ROWS]; ROWS] = {
    let mut table = [[0.0; ROWS]; ROWS];
    let mut j = 0;
    while j < ROWS {
        table[j][0] = 1.0;
        let mut k = 1;
        while k <= j {
            table[j][k] = table[j - 1][k - 1] + table[j - 1][k];
            k += 1;
        }
        j += 1;
    }
    table
};

/// q and q' at s.
fn at(q: &[f64], s: f64) -> (f64, f64) {
    q.iter().rev().fold((0.0, 0.0), |(value, slope), c| {
        (value * s + c, slope * s + value)
    })
}

/// The root on [0, 1] of a polynomial that starts above zero and has at most one there:
/// Newton's method, safeguarded by bisection of the bracket.
fn root(q: &[f64]) -> Option<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = 1.0;
    let (mut value, mut slope) = at(q, s);
    if value >= 0.0 {
        return None;
    }
    for _ in 0..100 {
        let newton = s - value / slope;
        // Convergence is quadratic: after half the digits the next step gives the rest.
        if (newton - s).abs() <= HALF_THE_DIGITS * s {
            return Some(newton);
        }
        // Where the slope is zero `newton` is not a number, and this is false.
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        s = next;
        (value, slope) = at(q, s);
        if value >= 0.0 {
            low = s;
        } else {
            high = s;
        }
    }
    Some(s)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(head: &[f64]) -> Polynomial {
        let mut q = [0.0; ROWS];
        q[..head.len()].copy_from_slice(head);
        q
    }

    #[test]
    fn roots_of_known_polynomials() {
        // (s − a)(s − b), positive at 0.
        for (a, b) in [(0.3, 0.6), (0.999, 2.0), (1e-9, 0.5), (0.5, 0.500_001)] {
            let found = first_below_zero(&polynomial(&[a * b, -(a + b), 1.0])).expect("a root");
            // Conditioned by the distance of the roots; rounding of the coefficients.
            let allowed = 4.0 * f64::EPSILON * (a * b + a + b) / (b - a);
            assert!((found - a).abs() <= allowed, "{a} {b}: {found}");
        }
        assert_eq!(first_below_zero(&polynomial(&[0.1, -0.5, 1.0])), None);
        // The second root lies in reach, the first behind.
        assert_eq!(first_below_zero(&polynomial(&[0.0, 0.2, 1.0])), None);
    }

    #[test]
    fn what_starts_at_zero_goes_where_it_is_led() {
        assert_eq!(first_below_zero(&polynomial(&[0.0, 0.0, -1.0])), Some(0.0));
        assert_eq!(first_below_zero(&polynomial(&[0.0, 0.0, 1.0])), None);
        let found = first_below_zero(&polynomial(&[0.0, 0.0, 0.25, -1.0])).expect("a root");
        assert!((found - 0.25).abs() < 1e-15);
        assert_eq!(first_below_zero(&[0.0; ROWS]), None);
    }

    #[test]
    fn a_graze_is_found_when_it_crosses_and_only_then() {
        for gap in [1e-3_f64, 1e-5, 1e-7] {
            // (s − 0.4)² ∓ gap²
            let above = polynomial(&[0.16 + gap * gap, -0.8, 1.0]);
            assert_eq!(first_below_zero(&above), None, "{gap}");
        }
        for gap in [1e-3_f64, 1e-6] {
            let below = polynomial(&[0.16 - gap * gap, -0.8, 1.0]);
            let found = first_below_zero(&below).expect("it crosses");
            // The coefficients' rounding of 1e-17 moves the root by that over 2·gap.
            assert!((found - (0.4 - gap)).abs() < 1e-16 / gap, "{gap}: {found}");
        }
    }
}
