//! The page that a trace fills from left to right before it starts over.

/// A page: how long it is, and when its dot columns are sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Simulated time at which the first page begins, s.
    pub origin: f64,
    /// Length of a page, s.
    pub span: f64,
    /// Dot columns, and so samples, of a page.
    pub columns: usize,
    /// Whether to stand still at the end of every page.
    pub hold: bool,
}

impl Sampling {
    /// Time between two samples, s.
    pub fn interval(&self) -> f64 {
        self.span / self.columns as f64
    }

    /// Number of the page that `time` belongs to; the first one is 0.
    pub fn page(&self, time: f64) -> f64 {
        ((time - self.origin) / self.span).floor().max(0.0)
    }

    /// When the page of `time` began, s.
    pub fn page_start(&self, time: f64) -> f64 {
        self.page(time).mul_add(self.span, self.origin)
    }

    /// Where on its page `time` lies, from 0 to 1.
    pub fn phase(&self, time: f64) -> f64 {
        ((time - self.page_start(time)) / self.span).clamp(0.0, 1.0)
    }

    /// Number of the first sample after `time`, when only every `stride`-th is taken, and
    /// the last one of a page.
    pub fn next_sample(&self, time: f64, stride: i64) -> i64 {
        let passed = ((time - self.origin) / self.interval()).floor();
        #[expect(
            clippy::cast_possible_truncation,
            reason = "as saturates, and no run lasts 2^63 samples"
        )]
        let next = self.sample_after(passed as i64, stride);
        // Rounding must not give the sample that was just taken.
        if self.sample_time(next) > time {
            next
        } else {
            self.sample_after(next, stride)
        }
    }

    fn sample_after(&self, number: i64, stride: i64) -> i64 {
        let pages = number.saturating_add(1).div_euclid(self.samples());
        let last = (pages + 1).saturating_mul(self.samples()) - 1;
        let next = (number.div_euclid(stride) + 1).saturating_mul(stride);
        next.min(last)
    }

    fn samples(&self) -> i64 {
        i64::try_from(self.columns).unwrap_or(i64::MAX).max(1)
    }

    /// When sample `number` is taken, s.
    pub fn sample_time(&self, number: i64) -> f64 {
        (number as f64).mul_add(self.interval(), self.origin)
    }

    /// Whether sample `number` is the last one of its page.
    pub fn ends_page(&self, number: i64) -> bool {
        number > 0 && (number + 1) % self.samples() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SWEEP: Sampling = Sampling {
        origin: 1.0,
        span: 0.5,
        columns: 50,
        hold: false,
    };

    #[test]
    fn pages_start_over() {
        assert!((SWEEP.page_start(1.2) - 1.0).abs() < 1e-12);
        assert!((SWEEP.page_start(1.7) - 1.5).abs() < 1e-12);
        assert!((SWEEP.phase(1.75) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn samples_march_on_a_grid() {
        let next = SWEEP.next_sample(1.0, 1);
        assert_eq!(next, 1);
        assert!((SWEEP.sample_time(next) - 1.01).abs() < 1e-12);
        assert!(SWEEP.ends_page(49) && SWEEP.ends_page(99) && !SWEEP.ends_page(50));
    }

    #[test]
    fn a_page_ends_with_its_last_sample_however_few_are_taken() {
        let (mut time, mut taken) = (SWEEP.origin, Vec::new());
        for _ in 0..6 {
            let next = SWEEP.next_sample(time, 32);
            taken.push((next, SWEEP.ends_page(next)));
            time = SWEEP.sample_time(next);
        }
        let ends = [
            (32, false),
            (49, true),
            (64, false),
            (96, false),
            (99, true),
            (128, false),
        ];
        assert_eq!(taken, ends);
    }

    #[test]
    fn every_sample_time_leads_to_the_next() {
        let sweep = Sampling {
            origin: 0.1,
            span: 0.3,
            columns: 61,
            hold: false,
        };
        for number in 0..100_000 {
            let next = sweep.next_sample(sweep.sample_time(number), 1);
            assert_eq!(next, number + 1);
        }
    }
}
