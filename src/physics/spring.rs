//! Spring and dashpot of a contact under any law: powers of the overlap, Eq. (8). The linear
//! law is the case β = γ = 0.

use crate::math;

/// Spring and dashpot of one contact: at overlap x = −g > 0 the force is
/// K x^(1+β) + c x^γ ẋ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spring {
    /// K, s⁻² m^−β (mean bead masses).
    pub stiffness: f64,
    /// c, s⁻¹ m^−γ (mean bead masses).
    pub dashpot: f64,
    /// β.
    pub beta: f64,
    /// γ.
    pub gamma: f64,
}

/// x^p for x ≥ 0 where the named laws have it by square roots, which every machine rounds
/// alike.
fn by_roots(x: f64, p: f64) -> Option<f64> {
    if p == 0.0 {
        Some(1.0)
    } else if p == 0.5 {
        Some(x.sqrt())
    } else if p == 0.25 {
        Some(x.sqrt().sqrt())
    } else {
        None
    }
}

impl Spring {
    /// K x^(1+β) at overlap `x` ≥ 0.
    pub fn elastic(&self, x: f64) -> f64 {
        let power = by_roots(x, self.beta).unwrap_or_else(|| math::powf(x, self.beta));
        self.stiffness * x * power
    }

    /// K x^(1+β), and c x^γ by which the rate ẋ is multiplied, at overlap `x` ≥ 0.
    #[inline]
    pub fn elastic_and_dashpot(&self, x: f64) -> (f64, f64) {
        let (beta, gamma) = match (by_roots(x, self.beta), by_roots(x, self.gamma)) {
            (Some(beta), Some(gamma)) => (beta, gamma),
            // A contact that is about to end is tried out at no overlap.
            _ if x == 0.0 => return (0.0, if self.gamma == 0.0 { self.dashpot } else { 0.0 }),
            _ => math::powers(x, [self.beta, self.gamma]).into(),
        };
        (self.stiffness * x * beta, self.dashpot * gamma)
    }

    /// Energy K x^(2+β)/(2+β) of the overlap `x` ≥ 0, m²/s².
    pub fn energy(&self, x: f64) -> f64 {
        self.elastic(x) * x / (2.0 + self.beta)
    }

    /// The overlap that carries the load `force` ≥ 0, m.
    pub fn overlap_under(&self, force: f64) -> f64 {
        math::powf(force / self.stiffness, 1.0 / (1.0 + self.beta))
    }

    /// The overlap that stores `energy` ≥ 0, m.
    fn overlap_storing(&self, energy: f64) -> f64 {
        math::powf(
            energy * (2.0 + self.beta) / self.stiffness,
            1.0 / (2.0 + self.beta),
        )
    }

    /// The overlap with which this contact goes on from another's overlap `x` ≥ 0.
    ///
    /// A stiffer one keeps the force, a softer one the overlap, and none stores more
    /// energy than there was: no edit stores up energy. A column at rest stays so under
    /// the first and settles a little deeper under the others.
    pub fn takes_over(&self, from: &Self, x: f64) -> f64 {
        if self.stiffness == from.stiffness && self.beta == from.beta {
            return x;
        }
        if self.beta == from.beta && self.beta == 0.0 {
            return x * (from.stiffness / self.stiffness).min(1.0);
        }
        x.min(self.overlap_under(from.elastic(x)))
            .min(self.overlap_storing(from.energy(x)))
    }
}

#[cfg(test)]
impl Spring {
    /// A linear spring and dashpot.
    pub fn linear(stiffness: f64, dashpot: f64) -> Self {
        Self {
            stiffness,
            dashpot,
            beta: 0.0,
            gamma: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_law_stores_up_no_energy_and_no_force() {
        let spring = |stiffness, beta| Spring {
            stiffness,
            dashpot: 0.0,
            beta,
            gamma: 0.0,
        };
        let laws = [
            spring(1e9, 0.0),
            spring(3e9, 0.0),
            spring(1e12, 0.5),
            spring(5e12, 0.5),
            spring(1e17, 1.5),
        ];
        for from in laws {
            for to in laws {
                for x in [1e-12, 1e-9, 1e-6, 1e-3] {
                    let taken = to.takes_over(&from, x);
                    // A rounding more than before, at most.
                    let more = 1.0 + 1e-14;
                    assert!(taken > 0.0 && taken <= x);
                    assert!(to.energy(taken) <= from.energy(x) * more, "{from:?} {to:?}");
                    assert!(to.elastic(taken) <= from.elastic(x) * more);
                }
            }
        }
    }

    #[test]
    fn energy_is_the_integral_of_the_force() {
        let spring = Spring {
            stiffness: 2e12,
            dashpot: 0.0,
            beta: 0.5,
            gamma: 0.0,
        };
        // Simpson's rule over a short stretch, exact to the fourth order in it.
        let (a, b) = (1e-7, 1.01e-7);
        let middle = spring.elastic(0.5 * (a + b));
        let work = (b - a) / 6.0 * (spring.elastic(a) + 4.0 * middle + spring.elastic(b));
        assert!((work / (spring.energy(b) - spring.energy(a)) - 1.0).abs() < 1e-10);
        assert!((spring.overlap_under(spring.elastic(a)) / a - 1.0).abs() < 1e-14);
    }
}
