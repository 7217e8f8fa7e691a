//! The linear spring–dashpot law, Eqs. (2), (3), (5)–(7).

use std::f64::consts::PI;

use crate::math;

/// The linear law of a pair of mean beads, from its restitution and contact time.
///
/// Masses are in units of the mean bead's, so the pair's reduced mass is ½.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearLaw {
    mu: f64,
    omega: f64,
}

impl LinearLaw {
    /// The law with restitution ε ∈ (0, 1] and contact time t_c > 0, s:
    /// ω = π/t_c, μ = −ln ε/t_c (Eqs. 6, 7).
    pub fn new(restitution: f64, contact_time: f64) -> Self {
        Self {
            mu: -math::ln(restitution) / contact_time,
            omega: PI / contact_time,
        }
    }

    /// The law with stiffness K and dissipation D_n = μ, 1/s: the inverse map.
    /// None when the contact is overdamped and never ends.
    pub fn from_stiffness(stiffness: f64, dissipation: f64) -> Option<Self> {
        let omega_squared = 2.0 * stiffness - dissipation * dissipation;
        (omega_squared > 0.0).then(|| Self {
            mu: dissipation,
            omega: omega_squared.sqrt(),
        })
    }

    /// μ = D_n, 1/s, Eq. (5).
    pub fn mu(&self) -> f64 {
        self.mu
    }

    /// ω₀² = ω² + μ², 1/s².
    pub fn omega0_squared(&self) -> f64 {
        self.omega * self.omega + self.mu * self.mu
    }

    /// Spring constant K = ½ω₀² of a pair, 1/s² (mean bead masses).
    pub fn stiffness(&self) -> f64 {
        0.5 * self.omega0_squared()
    }

    /// Contact time t_c = π/ω, s, Eq. (6).
    pub fn contact_time(&self) -> f64 {
        PI / self.omega
    }

    /// Restitution ε = exp(−μ t_c) of a pair, Eq. (7).
    pub fn restitution(&self) -> f64 {
        math::exp(-self.mu * self.contact_time())
    }

    /// Restitution ε_w = exp(−πμ/√(2ω₀² − μ²)) of a bead on a floor with the
    /// same spring and dashpot.
    pub fn floor_restitution(&self) -> f64 {
        same_spring_floor(self.restitution(), 1.0)
    }
}

/// Restitution of two beads of reduced mass `reduced` (in mean bead masses) that
/// share K and D_n with a mean pair of restitution `mean`; 0 when overdamped.
///
/// With r = μ/ω and s = r²/(1 + r²) everything stays finite as ε → 0.
pub(crate) fn pair_restitution(mean: f64, reduced: f64) -> f64 {
    damped_rebound(mean, 1.0, reduced)
}

/// Restitution of a bead of mass `mass` on the floor with the same K and
/// c = D_n m: the paper's "μ = D_n/2 for a particle with a wall".
pub(crate) fn same_spring_floor(mean: f64, mass: f64) -> f64 {
    damped_rebound(mean, 0.5, mass)
}

fn damped_rebound(mean: f64, share_of_mu: f64, reduced: f64) -> f64 {
    if mean >= 1.0 {
        return 1.0;
    }
    let r = -math::ln(mean) / PI;
    // 1/(1 + 1/r²) is s, and 1 at r = ∞ (ε = 0).
    let s = 1.0 / (1.0 + 1.0 / (r * r));
    let discriminant = 0.5 / reduced - share_of_mu * share_of_mu * s;
    // Rounding must not turn the equal pair at ε = 0, exactly overdamped, into a rebound.
    if discriminant <= f64::EPSILON {
        return 0.0;
    }
    math::exp(-PI * share_of_mu * (s / discriminant).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn map_and_its_inverse_agree() {
        for restitution in [0.05, 0.341, 0.6, 0.9, 0.999, 1.0] {
            for contact_time in [1e-9, 0.7e-5, 1e-2] {
                let law = LinearLaw::new(restitution, contact_time);
                let back =
                    LinearLaw::from_stiffness(law.stiffness(), law.mu()).expect("underdamped");
                assert!((back.restitution() - restitution).abs() < 1e-14);
                assert!((back.contact_time() / contact_time - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn floor_of_the_paper() {
        // 0.928226 for ε = 0.9; the direct form of the same formula.
        let law = LinearLaw::new(0.9, 0.7e-5);
        let direct =
            (-PI * law.mu() / (2.0 * law.omega0_squared() - law.mu().powi(2)).sqrt()).exp();
        assert!((law.floor_restitution() - direct).abs() < 1e-14);
        assert!((law.floor_restitution() - 0.928_226).abs() < 5e-7);
        // ε → 0: e^{−π}, also exactly at 0.
        assert!((same_spring_floor(0.0, 1.0) - (-PI).exp()).abs() < 1e-15);
        assert!((same_spring_floor(1e-300, 1.0) - (-PI).exp()).abs() < 1e-4);
    }

    #[test]
    fn unequal_pairs_follow_the_shared_spring() {
        assert!((pair_restitution(0.9, 0.5) - 0.9).abs() < 1e-15);
        assert!(pair_restitution(0.0, 0.5).abs() < f64::MIN_POSITIVE);
        assert!((pair_restitution(1.0, 7.0) - 1.0).abs() < f64::MIN_POSITIVE);
        // A pair of reduced mass ρ has ω₀² = K/ρ and the same μ.
        let (law, reduced) = (LinearLaw::new(0.7, 1.0), 0.8);
        let omega = (law.stiffness() / reduced - law.mu().powi(2)).sqrt();
        assert!((pair_restitution(0.7, reduced) - (-PI * law.mu() / omega).exp()).abs() < 1e-14);
    }
}
