//! Gaps that accelerate, as series of Taylor, and where they change.

use super::{Contact, NEGLIGIBLE, Oracle, ROUNDING, TERMS, earlier};
use crate::double_double::Double;
use crate::sampled_roots::first_below_zero;

impl Oracle {
    /// Taylor coefficients of these gaps in s = τ/h.
    pub(super) fn expand(&self, accelerated: &[usize], h: Double) -> Vec<Vec<Double>> {
        let n = self.gaps.len();
        let mut series = vec![Vec::new(); n];
        let mut inverse = vec![Double::ZERO; n];
        let mut scale = 0.0_f64;
        for &i in accelerated {
            series[i].extend([self.gaps[i], self.rates[i] * h]);
            inverse[i] = Double::ONE / self.masses[i];
            if i > 0 {
                inverse[i - 1] = Double::ONE / self.masses[i - 1];
            }
            scale = scale
                .max(self.gaps[i].hi.abs())
                .max((self.rates[i] * h).hi.abs());
        }
        let (floor, phase) = self.floor_pull();
        let mut wave = Double::ONE;
        for k in 0..TERMS {
            let order = (k + 1) as f64;
            // Force that pushes the beads at gap i apart, k-th coefficient.
            let force: Vec<Double> = (0..=n)
                .map(|i| {
                    if self.acting(i) {
                        let slope = series[i][k + 1] * order / h;
                        -self.pull(i, series[i][k], slope)
                    } else {
                        Double::ZERO
                    }
                })
                .collect();
            let mut largest = 0.0_f64;
            for &i in accelerated {
                let mut a = (force[i] - force[i + 1]) * inverse[i];
                if i > 0 {
                    a = a - (force[i - 1] - force[i]) * inverse[i - 1];
                } else {
                    a += floor[k % 4] * wave;
                    if k == 0 {
                        a = a - self.gravity;
                    }
                }
                let next = a * (h * h) / (order * (order + 1.0));
                largest = largest.max(next.hi.abs());
                series[i].push(next);
            }
            wave = wave * phase * h / order;
            scale = scale.max(largest);
            let before = accelerated.iter().map(|&i| series[i][k + 1].hi.abs());
            if k > 3 && largest.max(before.fold(0.0, f64::max)) <= NEGLIGIBLE * scale {
                break;
            }
            assert!(k + 1 < TERMS, "the step is too long for its series");
        }
        accelerated
            .iter()
            .map(|&i| std::mem::take(&mut series[i]))
            .collect()
    }

    /// −z̈₀ and its derivatives over powers of 2πf, and 2πf.
    fn floor_pull(&self) -> ([Double; 4], Double) {
        let Some((amplitude, omega)) = self.plate else {
            return ([Double::ZERO; 4], Double::ZERO);
        };
        let (sin, cos) = (omega * self.time).sin_cos();
        let a = amplitude * omega * omega;
        ([a * sin, a * cos, -a * sin, -a * cos], omega)
    }

    /// Where gap `i` first changes in its series, and to what.
    pub(super) fn change_in_a_series(
        &self,
        i: usize,
        gap: &[Double],
        h: Double,
    ) -> Option<(Double, Contact)> {
        let negative = |series: &[Double]| series.iter().map(|c| -*c).collect::<Vec<_>>();
        // A dashpot of 0 never pulls while there is overlap.
        let pull = || -> Option<Vec<Double>> {
            let cut = !self.attraction && self.dashpot[i].hi > 0.0;
            let slope = |k: usize| {
                gap.get(k + 1)
                    .map_or(Double::ZERO, |c| *c * (k + 1) as f64 / h)
            };
            cut.then(|| {
                let mut pull: Vec<_> = (0..gap.len())
                    .map(|k| self.pull(i, gap[k], slope(k)))
                    .collect();
                // A force that has just come to zero is zero but for rounding: were its sign
                // believed, the contact would turn back and forth without end.
                if pull[0].hi.abs() <= ROUNDING * (self.stiffness[i] * gap[0]).hi.abs() {
                    pull[0] = Double::ZERO;
                }
                pull
            })
        };
        let parts = || first_below_zero(&negative(gap)).map(|s| (s, Contact::Open));
        match self.contacts[i] {
            Contact::Open => first_below_zero(gap).map(|s| (s, Contact::Acting)),
            Contact::Acting => {
                let slack = pull().and_then(|pull| first_below_zero(&negative(&pull)));
                earlier(parts(), slack.map(|s| (s, Contact::Slack)))
            }
            Contact::Slack => {
                let acts = pull().and_then(|pull| first_below_zero(&pull));
                earlier(parts(), acts.map(|s| (s, Contact::Acting)))
            }
        }
    }
}
