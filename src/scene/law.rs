//! The laws of a soft contact, Eq. (8), and the change from one to another.

use crate::math;
use std::f64::consts::PI;

use super::encounter::undamped_shape;

/// The force of a soft contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Linear spring and dashpot, Eq. (5), by restitution and contact time.
    Hooke {
        /// Contact time t_c of a pair of equal beads, s, Eq. (6).
        contact_time: f64,
    },
    /// Powers of the overlap, Eq. (8).
    Power(PowerLaw),
}

/// f = K x^(1+β) + D_n m_ij x^γ ẋ with m_ij = 2 m_i m_j/(m_i + m_j), the nonlinear law of
/// Sec. IV B.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// β and γ, by name or free.
    pub exponents: Exponents,
    /// K/m, s⁻² m^−β, m being the reduced mass of a pair of mean beads, as the paper
    /// prints it.
    pub stiffness: f64,
    /// D_n, s⁻¹ m^−γ.
    pub damping: f64,
}

/// The exponents of a power law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exponents {
    /// β = ½, γ = 0.
    Hertz,
    /// β = γ = ½.
    HertzKuwabaraKono,
    /// β = ½, γ = ¼.
    Taguchi,
    /// Any.
    Free {
        /// Of the elastic force x^(1+β).
        beta: f64,
        /// Of the dissipative force x^γ ẋ.
        gamma: f64,
    },
}

impl Exponents {
    /// β.
    pub fn beta(self) -> f64 {
        match self {
            Self::Hertz | Self::HertzKuwabaraKono | Self::Taguchi => 0.5,
            Self::Free { beta, .. } => beta,
        }
    }

    /// γ.
    pub fn gamma(self) -> f64 {
        match self {
            Self::Hertz => 0.0,
            Self::HertzKuwabaraKono => 0.5,
            Self::Taguchi => 0.25,
            Self::Free { gamma, .. } => gamma,
        }
    }
}

/// The name of a law on the command line and in preset files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawName {
    /// β = γ = 0.
    Hooke,
    /// β = ½, γ = 0.
    Hertz,
    /// β = γ = ½.
    HertzKuwabaraKono,
    /// β = ½, γ = ¼.
    Taguchi,
    /// Free exponents.
    Power,
}

impl LawName {
    /// As they are typed, in the order in which they are shown.
    pub const WORDS: &[&str] = &["hooke", "hertz", "hertz-kuwabara-kono", "taguchi", "power"];

    /// As it is typed.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Hooke => "hooke",
            Self::Hertz => "hertz",
            Self::HertzKuwabaraKono => "hertz-kuwabara-kono",
            Self::Taguchi => "taguchi",
            Self::Power => "power",
        }
    }

    /// What it is, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Hooke => "linear spring and dashpot",
            Self::Hertz => "elastic force x^(3/2), linear dashpot",
            Self::HertzKuwabaraKono => "elastic force x^(3/2), dissipation x^(1/2) dx/dt",
            Self::Taguchi => "elastic force x^(3/2), dissipation x^(1/4) dx/dt",
            Self::Power => "elastic force x^(1+beta), dissipation x^gamma dx/dt",
        }
    }

    /// The law of that name.
    pub fn find(name: &str) -> Option<Self> {
        [
            Self::Hooke,
            Self::Hertz,
            Self::HertzKuwabaraKono,
            Self::Taguchi,
            Self::Power,
        ]
        .into_iter()
        .find(|law| law.as_str() == name)
    }
}

impl Law {
    /// Its name.
    pub fn name(&self) -> LawName {
        match self {
            Self::Hooke { .. } => LawName::Hooke,
            Self::Power(power) => match power.exponents {
                Exponents::Hertz => LawName::Hertz,
                Exponents::HertzKuwabaraKono => LawName::HertzKuwabaraKono,
                Exponents::Taguchi => LawName::Taguchi,
                Exponents::Free { .. } => LawName::Power,
            },
        }
    }
}

impl PowerLaw {
    /// The linear law of a pair with restitution ε and contact time t_c, s, as a power
    /// law: K/m = ω₀² and D_n = μ, Eqs. (5)–(7).
    pub fn linear(restitution: f64, contact_time: f64) -> Self {
        let (omega, mu) = (PI / contact_time, -math::ln(restitution) / contact_time);
        Self {
            exponents: Exponents::Free {
                beta: 0.0,
                gamma: 0.0,
            },
            stiffness: omega * omega + mu * mu,
            damping: mu,
        }
    }

    /// Largest overlap of an undamped pair that meets at `speed`, m, Eq. (A1).
    pub fn penetration(&self, speed: f64) -> f64 {
        let beta = self.exponents.beta();
        math::powf(
            (1.0 + 0.5 * beta) * (speed * speed / self.stiffness),
            1.0 / (2.0 + beta),
        )
    }

    /// Contact time of an undamped pair that meets at `speed`, s, Eq. (A2).
    pub fn contact_time(&self, speed: f64) -> f64 {
        undamped_shape(self.exponents.beta()) * (self.penetration(speed) / speed)
    }

    /// The law with other exponents whose collisions at `speed` are as alike as can be:
    /// an undamped pair penetrates as deep, and at half that depth the dashpot is as
    /// strong. What is not given yet (NaN) stays so.
    #[must_use]
    pub fn like(&self, exponents: Exponents, speed: f64) -> Self {
        let depth = self.penetration(speed);
        let (beta, gamma) = (exponents.beta(), exponents.gamma());
        let rate = speed / depth;
        Self {
            exponents,
            stiffness: rounded((1.0 + 0.5 * beta) * (rate * rate) * math::powf(depth, -beta)),
            damping: rounded(
                self.damping * math::powf(0.5 * depth, self.exponents.gamma() - gamma),
            ),
        }
    }

    /// Restitution and contact time of the linear law whose collisions at `speed` are as
    /// alike as can be, in the sense of [`PowerLaw::like`]. One so damped that it would
    /// never let go gets [`FEEBLEST`].
    pub(super) fn hooke(&self, speed: f64) -> (f64, f64) {
        let linear = self.like(
            Exponents::Free {
                beta: 0.0,
                gamma: 0.0,
            },
            speed,
        );
        let strongest = {
            let r = -math::ln(FEEBLEST) / PI;
            (r * r / (1.0 + r * r)).sqrt() * linear.stiffness.sqrt()
        };
        let mu = if linear.damping > strongest {
            strongest
        } else {
            linear.damping
        };
        let contact_time = PI / (linear.stiffness - mu * mu).sqrt();
        (
            rounded(math::exp(-mu * contact_time)),
            rounded(contact_time),
        )
    }
}

/// Least restitution that a change to the linear law gives.
const FEEBLEST: f64 = 1e-6;

/// To twelve digits, so that there and back gives the number one started with.
fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_linear_constants() {
        // Sec. IV B: K/m = 2e9 and D_n = 3.17e3 are ε = 0.800 and t_c = 7.0e-5 s.
        let law = PowerLaw {
            exponents: Exponents::Free {
                beta: 0.0,
                gamma: 0.0,
            },
            stiffness: 2e9,
            damping: 3.17e3,
        };
        let (restitution, contact_time) = law.hooke(0.05);
        assert!((restitution - 0.800).abs() < 5e-4, "{restitution}");
        assert!((contact_time - 7.0e-5).abs() < 5e-7, "{contact_time}");
    }

    #[test]
    fn a_change_of_law_and_back_is_none() {
        for (restitution, contact_time) in [(0.9, 7e-6), (0.6, 0.7e-3), (0.05, 1e-9)] {
            let linear = PowerLaw::linear(restitution, contact_time);
            for exponents in [
                Exponents::Hertz,
                Exponents::HertzKuwabaraKono,
                Exponents::Taguchi,
                Exponents::Free {
                    beta: 1.5,
                    gamma: 2.0,
                },
            ] {
                let there = linear.like(exponents, 0.2);
                let depth = there.penetration(0.2) / linear.penetration(0.2);
                assert!((depth - 1.0).abs() < 1e-10, "{depth}");
                // Twelve digits survive, less the conditioning of ε ≪ 1.
                let (e, t) = there.hooke(0.2);
                assert!((e / restitution - 1.0).abs() < 1e-10, "{e}");
                assert!((t / contact_time - 1.0).abs() < 1e-10, "{t}");
            }
        }
    }

    #[test]
    fn too_much_damping_for_a_rebound_becomes_the_least_one() {
        let law = PowerLaw {
            exponents: Exponents::Hertz,
            stiffness: 2e12,
            damping: 1e9,
        };
        let (restitution, contact_time) = law.hooke(0.05);
        assert!((restitution / FEEBLEST - 1.0).abs() < 1e-9);
        assert!(contact_time > 0.0 && contact_time.is_finite());
    }
}
