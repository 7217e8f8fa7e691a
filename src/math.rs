//! Elementary functions whose bits do not depend on the machine.
//!
//! The standard library's `f64::sin`, `exp`, `powf` and so on are the system's, whose last
//! bit depends on its version and on whether the processor has fused multiply-adds. A
//! chaotic column turns that bit into another motion. These are in plain arithmetic of
//! IEEE 754, the same on every machine, and within one unit in the last place; `clippy.toml`
//! keeps the program from the system's. Operations that IEEE 754 rounds correctly (`+`, `×`,
//! `/`, `sqrt`, `mul_add`, `floor`, `%`) are the same everywhere as they are. Angles are in
//! radians.

mod power;
mod twice;

use nalgebra::Complex;

/// sin x.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// cos x.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// sin x and cos x, the bits of [`sin`] and [`cos`].
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// arcsin x, in [−π/2, π/2]; not a number beyond |x| = 1.
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// arctan x, in [−π/2, π/2].
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// sinh x.
pub fn sinh(x: f64) -> f64 {
    libm::sinh(x)
}

/// cosh x.
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// e^x.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// 2^x, exact for whole x.
pub fn exp2(x: f64) -> f64 {
    libm::exp2(x)
}

/// The natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The logarithm to base 2.
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// The logarithm to base 10.
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// x^p for any p; not a number for x < 0, unless p is whole.
pub fn powf(x: f64, p: f64) -> f64 {
    power::of_usual_size(x, [p]).map_or_else(|| libm::pow(x, p), |[power]| power)
}

/// x^p for each p, the bits of [`powf`]; two cost little more than one.
#[inline]
pub fn powers<const COUNT: usize>(x: f64, powers: [f64; COUNT]) -> [f64; COUNT] {
    power::of_usual_size(x, powers).unwrap_or_else(|| powers.map(|p| powf(x, p)))
}

/// x^n by repeated squares: the product of the squares that n's binary digits ask for, the
/// lowest first; for n < 0 its inverse.
#[inline]
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut product, mut square, mut digits) = (1.0, x, n.unsigned_abs());
    loop {
        if digits & 1 == 1 {
            product *= square;
        }
        digits >>= 1;
        if digits == 0 {
            break;
        }
        square *= square;
    }
    if n < 0 { 1.0 / product } else { product }
}

/// √(x² + y²), without overflow on the way.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// e^(ix).
pub fn cis(x: f64) -> Complex<f64> {
    let (sin, cos) = sin_cos(x);
    Complex::new(cos, sin)
}

/// e^z.
pub fn complex_exp(z: Complex<f64>) -> Complex<f64> {
    cis(z.im) * exp(z.re)
}

/// Modulus of z, and its argument in [−π, π].
pub fn polar(z: Complex<f64>) -> (f64, f64) {
    (hypot(z.re, z.im), libm::atan2(z.im, z.re))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both libraries are right to one unit in the last place, so that they are at most two
    /// apart.
    #[test]
    fn functions_are_the_system_s_to_the_last_places() {
        let close = |name: &str, x: f64, here: f64, system: f64| {
            let apart = (here - system).abs();
            let allowed = 2.0 * f64::EPSILON * system.abs();
            assert!(apart <= allowed, "{name}({x:e}): {here:e} {system:e}");
        };
        for k in -4000..4000 {
            let x = 0.0213 * f64::from(k);
            let size = (0.01 * f64::from(k)).exp();
            let part = f64::from(k) / 4000.0;
            close("sin", x, sin(x), x.sin());
            close("cos", x, cos(x), x.cos());
            close("atan", x, atan(x), x.atan());
            close("asin", part, asin(part), part.asin());
            close("sinh", x, sinh(x), x.sinh());
            close("cosh", x, cosh(x), x.cosh());
            close("exp", x, exp(x), x.exp());
            close("exp2", x, exp2(x), x.exp2());
            close("ln", size, ln(size), size.ln());
            close("log2", size, log2(size), size.log2());
            close("log10", size, log10(size), size.log10());
            close("powf", size, powf(size, part), size.powf(part));
            close("hypot", x, hypot(x, part), x.hypot(part));
            assert_eq!(sin_cos(x), (sin(x), cos(x)));
            assert_eq!(powers(size, [part, x]), [powf(size, part), powf(size, x)]);
            let turned = polar(cis(part * 3.1));
            assert!((turned.0 - 1.0).abs() < 4e-16 && (turned.1 - part * 3.1).abs() < 1e-15);
        }
    }

    /// Times are snapped to powers of two, and axes to powers of ten.
    #[test]
    fn whole_powers_are_exact() {
        for k in -1000..=1000 {
            let x = f64::from_bits(u64::try_from(1023 + k).expect("positive") << 52);
            assert_eq!(exp2(f64::from(k)), x);
            assert_eq!(log2(x), f64::from(k));
            assert_eq!(powi(2.0, k), x);
        }
        for k in 0..=22 {
            let x: f64 = format!("1e{k}").parse().expect("a number");
            assert_eq!(powi(10.0, k), x);
            assert_eq!(powf(10.0, f64::from(k)), x);
            assert_eq!(log10(x), f64::from(k));
        }
        for k in -300..0 {
            let x: f64 = format!("1e{k}").parse().expect("a number");
            assert_eq!(log10(x), f64::from(k));
        }
    }

    #[test]
    fn powi_multiplies_squares_from_the_lowest_digit() {
        let x = 1.1_f64;
        assert_eq!(powi(x, 0), 1.0);
        assert_eq!(powi(x, 3), x * (x * x));
        assert_eq!(
            powi(x, 13),
            x * (x * x * (x * x)) * (x * x * (x * x) * (x * x * (x * x)))
        );
        assert_eq!(powi(x, -2), 1.0 / (x * x));
        assert_eq!(powi(1e-200, -2), f64::INFINITY);
        assert_eq!(powi(2.0, i32::MIN), 0.0);
    }
}
