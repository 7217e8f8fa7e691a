//! Numbers of twice the digits, for tables that are worked out when the program is built.

/// A number as the sum of two, the second below the first one's last digit (Dekker, Numer.
/// Math. 18, 224, 1971).
#[derive(Clone, Copy)]
pub struct Twice {
    /// The number, rounded.
    pub high: f64,
    /// What it lacks.
    pub low: f64,
}

impl Twice {
    /// x exactly.
    pub const fn new(x: f64) -> Self {
        Self { high: x, low: 0.0 }
    }

    /// The sum of any two numbers, exactly.
    const fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        let low = (a - (high - part)) + (b - part);
        Self { high, low }
    }

    /// The product of two numbers, exactly.
    const fn product(a: f64, b: f64) -> Self {
        let (a_high, b_high) = (leading(a), leading(b));
        let (a_low, b_low) = (a - a_high, b - b_high);
        let high = a * b;
        let low = a_high * b_high - high + a_high * b_low + a_low * b_high + a_low * b_low;
        Self { high, low }
    }

    const fn plus(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::sum(sum.high, sum.low + (self.low + other.low))
    }

    /// The product.
    pub const fn times(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let low = self.high * other.low + self.low * other.high;
        Self::sum(product.high, product.low + low)
    }

    const fn over(self, divisor: Self) -> Self {
        let first = self.high / divisor.high;
        let left = self.plus(divisor.times(Self::new(-first)));
        Self::sum(first, left.high / divisor.high)
    }

    /// ln x of ½ < x < 4: 2 artanh((x − 1)/(x + 1)) by its series.
    pub const fn ln(x: f64) -> Self {
        let s = Self::sum(x, -1.0).over(Self::sum(x, 1.0));
        let square = s.times(s);
        let (mut power, mut sum) = (s, s);
        let mut k = 3.0;
        while k < 140.0 {
            power = power.times(square);
            sum = sum.plus(power.over(Self::new(k)));
            k += 2.0;
        }
        sum.plus(sum)
    }

    /// e^x of |x| < 1, by its series.
    pub const fn exp(x: Self) -> Self {
        let (mut term, mut sum) = (Self::new(1.0), Self::new(1.0));
        let mut k = 1.0;
        while k < 30.0 {
            term = term.times(x).over(Self::new(k));
            sum = sum.plus(term);
            k += 1.0;
        }
        sum
    }

    /// The next whole multiple of `grain`, a power of two, and the rest.
    pub const fn grained(self, grain: f64) -> (f64, f64) {
        let whole = whole(self.high / grain) * grain;
        (whole, self.high - whole + self.low)
    }
}

/// Next to this large number are whole numbers only.
pub const SHIFT: f64 = 1.5 * (1_u64 << 52) as f64;

/// The whole number next to x, |x| < 2^50.
pub const fn whole(x: f64) -> f64 {
    x + SHIFT - SHIFT
}

/// The number of x's leading 26 digits.
pub const fn leading(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & (u64::MAX << 27))
}
