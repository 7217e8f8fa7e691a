//! x^p by tables, in plain arithmetic of IEEE 754 without fused multiply-adds: laws of free
//! exponents ask for two of these at each step of each contact.
//!
//! x is 2^k z with z near some 1/i of 128, and ln x = k ln 2 − ln i + ln(iz) is summed to 68
//! digits (Tang, ACM Trans. Math. Softw. 16, 378, 1990); its p-fold goes back through a table
//! of 2^(j/128). Both tables are worked out when the program is built.

use super::twice::{SHIFT, Twice, leading, whole};

/// 2^7 entries for an octave.
const BITS: u32 = 7;
const SIZE: usize = 1 << BITS;
/// What one of them spans, in a number's last digits.
const SPAN: u64 = 1 << (52 - BITS);
/// The lowest z, about 0.7: such that the entry that holds 1 reaches as far below it as
/// above, where numbers are half as dense.
const LOWEST: u64 = (1023 << 52) - 75 * SPAN - 2 * SPAN / 3;
const LN_2: Twice = Twice::ln(2.0);
/// Of the logarithm as whole multiples of 2^-42: ten digits before the point, 42 behind it.
const SUMMED_GRAIN: f64 = 1.0 / (1_u64 << 42) as f64;
const LN_2_SUMMED: (f64, f64) = LN_2.grained(SUMMED_GRAIN);
/// ln 2/128 as a whole multiple of 2^-43, any 2^17 of which are exact.
const LN_2_PART: (f64, f64) = Twice::grained(
    LN_2.times(Twice::new(1.0 / SIZE as f64)),
    0.5 * SUMMED_GRAIN,
);

/// Of the z of one entry.
#[derive(Clone, Copy)]
struct Near {
    /// i ≈ 1/z, of eleven digits, so that products with 21 more are exact.
    inverse: f64,
    /// −ln i as a whole multiple of 2^-42.
    ln: f64,
    /// What that lacks.
    rest: f64,
}

/// 2^(j/128).
#[derive(Clone, Copy)]
struct Root {
    /// Its bits, less j entries' span.
    bits: u64,
    /// What it lacks, as a part of it.
    rest: f64,
}

static NEAR: [Near; SIZE] = near();
static ROOTS: [Root; SIZE] = roots();

const fn near() -> [Near; SIZE] {
    let one = Near {
        inverse: 1.0,
        ln: 0.0,
        rest: 0.0,
    };
    let mut all = [one; SIZE];
    let mut k = 0;
    while k < SIZE {
        let lowest = LOWEST + k as u64 * SPAN;
        let (first, last) = (f64::from_bits(lowest), f64::from_bits(lowest + SPAN));
        // Next to 1 the logarithm is all digits behind it: nothing may be added.
        if first > 1.0 || last < 1.0 {
            let inverse = whole(1024.0 * 2.0 / (first + last)) / 1024.0;
            let (ln, rest) = Twice::ln(inverse).grained(SUMMED_GRAIN);
            all[k] = Near {
                inverse,
                ln: -ln,
                rest: -rest,
            };
        }
        k += 1;
    }
    all
}

const fn roots() -> [Root; SIZE] {
    let mut all = [Root { bits: 0, rest: 0.0 }; SIZE];
    let mut j = 0;
    while j < SIZE {
        let root = Twice::exp(LN_2.times(Twice::new(j as f64 / SIZE as f64)));
        all[j] = Root {
            bits: root.high.to_bits() - j as u64 * SPAN,
            rest: root.low / root.high,
        };
        j += 1;
    }
    all
}

/// The powers of x where neither they nor x are far from 1: x > 0 has all its digits, and
/// |p ln x| < 700; none elsewhere. Within 0.51 units in the last place.
#[inline]
pub fn of_usual_size<const COUNT: usize>(x: f64, powers: [f64; COUNT]) -> Option<[f64; COUNT]> {
    let bits = x.to_bits();
    if !(1..0x7ff).contains(&(bits >> 52)) {
        return None;
    }
    let (ln, ln_rest) = ln(bits);
    let ln_leading = leading(ln);
    let mut usual = true;
    let all = powers.map(|p| {
        let p_leading = leading(p);
        let product = p_leading * ln_leading;
        let rest = (p - p_leading) * ln_leading + p * (ln - ln_leading + ln_rest);
        // Not so either where p is not a number.
        usual &= product.abs() < 700.0;
        exp(product, rest)
    });
    usual.then_some(all)
}

/// ln x as a sum, by the bits of x.
#[inline]
fn ln(x: u64) -> (f64, f64) {
    let above = x.wrapping_sub(LOWEST);
    let k = (above.cast_signed() >> 52) as f64;
    let near = &NEAR[(above >> (52 - BITS)) as usize % SIZE];
    let z_bits = x.wrapping_sub(above & (0xfff << 52));
    let z = f64::from_bits(z_bits);
    // r = iz − 1, first of few digits and then of those left out.
    let z_leading = f64::from_bits((z_bits + (1 << 31)) & (u64::MAX << 32));
    let r_leading = z_leading * near.inverse - 1.0;
    let r_last = (z - z_leading) * near.inverse;
    let r = r_leading + r_last;
    // ln(1 + r) = r − r²/2 + … : the parts that matter in full, and what their sums lack.
    let start = k * LN_2_SUMMED.0 + near.ln;
    let straight = start + r;
    let half_square = 0.5 * r_leading * r_leading;
    let bent = straight - half_square;
    let lost = (r_leading - r + r_last)
        + (start - straight + r)
        + (straight - bent - half_square)
        + (k * LN_2_SUMMED.1 + near.rest)
        - 0.5 * r_last * (r + r_leading);
    let r2 = r * r;
    let series = (1.0 / 3.0 - 0.25 * r) + r2 * (0.2 - 1.0 / 6.0 * r + r2 * (1.0 / 7.0 - 0.125 * r));
    let rest = lost + r * r2 * series;
    let sum = bent + rest;
    (sum, bent - sum + rest)
}

/// e^(x + rest) for |x| < 700 and a rest below x's last digits.
#[inline]
fn exp(x: f64, rest: f64) -> f64 {
    let shifted = x * (SIZE as f64 / LN_2.high) + SHIFT;
    let parts = shifted - SHIFT;
    // The last bits of the shifted number are those of the whole one.
    let k = shifted.to_bits();
    let r = x - parts * LN_2_PART.0 + (rest - parts * LN_2_PART.1);
    let root = &ROOTS[(k << (64 - BITS) >> (64 - BITS)) as usize];
    let scale = f64::from_bits(root.bits.wrapping_add(k.wrapping_mul(SPAN)));
    let r2 = r * r;
    let more =
        root.rest + r + r2 * (0.5 + 1.0 / 6.0 * r) + r2 * r2 * (1.0 / 24.0 + 1.0 / 120.0 * r);
    scale + scale * more
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots and their squares, exactly rounded by IEEE 754, need no other library: √x is
    /// x^½ to half a unit, and this may be 0.01 beyond that, so that another number stands
    /// there only where a third is next to half-way. x^2 and x^3 of few digits are exact.
    #[test]
    fn powers_are_those_that_arithmetic_knows() {
        let (mut x, mut others) = (1e-300, 0);
        let mut count = 0;
        while x < 1e300 {
            let [root] = of_usual_size(x, [0.5]).expect("of usual size");
            others += u32::from(root != x.sqrt());
            assert!(root.to_bits().abs_diff(x.sqrt().to_bits()) <= 1, "{x:e}");
            let [inverse] = of_usual_size(x, [-1.0]).expect("of usual size");
            assert!(
                inverse.to_bits().abs_diff((1.0 / x).to_bits()) <= 1,
                "{x:e}"
            );
            (x, count) = (x * 1.01345, count + 1);
        }
        assert!(others * 50 < count, "{others} of {count}");
        for k in 1..2000_u32 {
            let x = f64::from(k) / 64.0;
            assert_eq!(of_usual_size(x, [2.0]), Some([x * x]));
            assert_eq!(of_usual_size(x, [3.0]), Some([x * x * x]));
            assert_eq!(of_usual_size(x * x, [0.5]), Some([x]));
        }
    }

    /// Near 1 the power is all in the logarithm's relative accuracy: (1 + d)^p is known from
    /// e^(p ln(1 + d)) with ln(1 + d) = d − d²/2 + … to d^4.
    #[test]
    fn large_powers_near_1_keep_their_digits() {
        for k in 1..200 {
            let d = f64::from(k) * 2f64.powi(-40);
            let (ln, p) = (d - d * d / 2.0 + d * d * d / 3.0, 1.0 / d);
            let expected = 1f64.exp() * (p * ln - 1.0).exp();
            let [power] = of_usual_size(1.0 + d, [p]).expect("of usual size");
            assert!((power / expected - 1.0).abs() < 3.0 * f64::EPSILON, "{k}");
        }
    }

    #[test]
    fn what_is_not_of_usual_size_is_left_to_others() {
        let cases = [
            (0.0, 0.3),
            (-1.0, 0.3),
            (1e-310, 0.3),
            (f64::INFINITY, 1.0),
            (f64::NAN, 1.0),
            (2.0, f64::NAN),
            (2.0, f64::INFINITY),
            (2.0, 1020.0),
        ];
        for (x, p) in cases {
            assert_eq!(of_usual_size(x, [p]), None, "{x} {p}");
        }
    }
}
