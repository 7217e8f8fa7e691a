//! Seeded random numbers for tests.
#![allow(dead_code, reason = "every room uses its own part of this")]

/// Numbers in [0, 1), the same in every run.
pub struct Dice(pub u64);

impl Dice {
    pub fn roll(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below `count`, which is small.
    pub fn below(&mut self, count: u32) -> usize {
        let roll = self.roll() * f64::from(count);
        (1..count).filter(|&k| f64::from(k) <= roll).count()
    }

    pub fn chance(&mut self, p: f64) -> bool {
        self.roll() < p
    }

    pub fn decades(&mut self, from: f64, to: f64) -> f64 {
        10_f64.powf(from + (to - from) * self.roll())
    }
}
