//! The laws of a soft contact, Eq. (8), and the change from one to another.

mod encounter;

pub use encounter::rebound;

use super::Solver;
use crate::math;
use crate::numerals::rounded;
use encounter::undamped_shape;
use std::f64::consts::PI;

/// Tolerance of the adaptive method where nobody says otherwise.
const COMMON_TOLERANCE: f64 = 1e-10;

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
    /// All laws, in the order in which they are shown.
    pub const ALL: [Self; 5] = [
        Self::Hooke,
        Self::Hertz,
        Self::HertzKuwabaraKono,
        Self::Taguchi,
        Self::Power,
    ];

    /// As they are typed, in that order.
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

    /// As it stands in a title; none of the linear law, which goes without saying.
    pub fn title(self) -> Option<&'static str> {
        match self {
            Self::Hooke => None,
            Self::Hertz => Some("Hertz"),
            Self::HertzKuwabaraKono => Some("Hertz-KK"),
            Self::Taguchi => Some("Taguchi"),
            Self::Power => Some("power law"),
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
        Self::ALL.into_iter().find(|law| law.as_str() == name)
    }
}

impl Law {
    /// The linear law, by the contact time t_c of a pair, s.
    pub fn linear(contact_time: f64) -> Self {
        Self::Hooke { contact_time }
    }

    /// Powers of the overlap.
    pub fn powers(power: PowerLaw) -> Self {
        Self::Power(power)
    }

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

    /// Whether restitution and contact time follow from the law, and depend on the speed at
    /// which a pair meets. Otherwise they are given, and the same at every speed.
    pub fn depends_on_speed(&self) -> bool {
        match self {
            Self::Hooke { .. } => false,
            Self::Power(_) => true,
        }
    }

    /// Contact time t_c, s, of a pair of mean beads that meets at `speed`, m/s; one that
    /// depends on the speed is that of an undamped pair, Eq. (A2).
    pub fn contact_time(&self, speed: f64) -> f64 {
        match self {
            Self::Hooke { contact_time } => *contact_time,
            Self::Power(power) => power.contact_time(speed),
        }
    }

    /// The contact time, s, where it is what the law is given by.
    pub fn given_contact_time(&mut self) -> Option<&mut f64> {
        match self {
            Self::Hooke { contact_time } => Some(contact_time),
            Self::Power(_) => None,
        }
    }

    /// Restitution of a pair of mean beads that meets at `speed`, m/s, where it follows from
    /// the law.
    pub fn rebound(&self, attraction: bool, speed: f64) -> Option<f64> {
        match self {
            Self::Hooke { .. } => None,
            Self::Power(power) => Some(rebound(power, attraction, speed)),
        }
    }

    /// The powers of the overlap, where the law is given by them.
    pub fn power(&self) -> Option<&PowerLaw> {
        match self {
            Self::Hooke { .. } => None,
            Self::Power(power) => Some(power),
        }
    }

    /// The same, to be changed.
    pub fn power_mut(&mut self) -> Option<&mut PowerLaw> {
        match self {
            Self::Hooke { .. } => None,
            Self::Power(power) => Some(power),
        }
    }

    /// The law in powers of the overlap; the linear one is that of β = γ = 0, which
    /// `restitution` completes.
    pub fn in_powers(&self, restitution: f64) -> PowerLaw {
        match self {
            Self::Hooke { contact_time } => PowerLaw::linear(restitution, *contact_time),
            Self::Power(power) => *power,
        }
    }

    /// Whether the solver can compute how contacts of this law move.
    pub fn allows(&self, solver: &Solver) -> bool {
        match (self, solver) {
            (_, Solver::Grid(_))
            | (Self::Hooke { .. }, Solver::Exact)
            | (Self::Power(_), Solver::Adaptive { .. }) => true,
            (Self::Hooke { .. }, Solver::Adaptive { .. }) | (Self::Power(_), Solver::Exact) => {
                false
            }
        }
    }

    /// The solver that locates the contact changes of this law.
    pub fn locating(&self) -> Solver {
        match self {
            Self::Hooke { .. } => Solver::Exact,
            Self::Power(_) => Solver::Adaptive {
                tolerance: COMMON_TOLERANCE,
            },
        }
    }

    /// The law of that name whose collisions at `speed`, m/s, are as alike as can be (see
    /// [`PowerLaw::like`]), and the restitution of hard beads that goes with it.
    #[must_use]
    pub fn turned(&self, name: LawName, restitution: f64, speed: f64) -> (Self, f64) {
        let before = self.in_powers(restitution);
        let exponents = match name {
            LawName::Hooke => {
                let (restitution, contact_time) = before.hooke(speed);
                return (Self::Hooke { contact_time }, restitution);
            }
            LawName::Hertz => Exponents::Hertz,
            LawName::HertzKuwabaraKono => Exponents::HertzKuwabaraKono,
            LawName::Taguchi => Exponents::Taguchi,
            LawName::Power => Exponents::Free {
                beta: before.exponents.beta(),
                gamma: before.exponents.gamma(),
            },
        };
        (Self::Power(before.like(exponents, speed)), restitution)
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
            stiffness: rounded(
                (1.0 + 0.5 * beta) * (rate * rate) * math::powf(depth, -beta),
                THERE_AND_BACK,
            ),
            damping: rounded(
                self.damping * math::powf(0.5 * depth, self.exponents.gamma() - gamma),
                THERE_AND_BACK,
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
            rounded(math::exp(-mu * contact_time), THERE_AND_BACK),
            rounded(contact_time, THERE_AND_BACK),
        )
    }
}

/// Digits of constants that a change of law gives: with them a change there and back gives
/// the number that one started with.
const THERE_AND_BACK: usize = 12;

/// Least restitution that a change to the linear law gives.
const FEEBLEST: f64 = 1e-6;

#[cfg(test)]
mod tests;
