//! The verdict on soft contacts: whether they give what hard spheres give.
//!
//! It is the scene's, not a run's, so that it neither waits for a run nor changes with
//! its length, its grid or its chance: the scene's soft column, moved by the exact method,
//! and the same column of hard spheres are followed from the start until what they give is
//! known well enough, or for about a second each of counted work.
//!
//! What is compared is ε_eff of a floor collision without gravity, and the part of its
//! energy that is lost (near ε_eff = 1 the first hardly shows it); of a column that falls
//! on a floor at rest ε_eff of its last bounce, when both have come to rest (its beads
//! touch then, and σ → 0 at any t_c: soft beads hardly lose what is left); on a plate
//! mean E_r over mean E (the measure of the effect: a column that loses too little is
//! torn apart), and the mean rise of the centre of mass. With the difference
//! δ = |a − b|/max(a, b, least), `least` being below what a person would see:
//!
//! - *agreement*: δ ≤ 0.05, the tolerance of `advise` on a plate;
//! - *detachment*: δ > 0.5 of any of them;
//! - *crossover*: between.
//!
//! Means on a plate count with two standard errors (`decide`). The rise fluctuates
//! much more than E_r/E, so it may refuse agreement but need not prove it. Where no
//! comparison can be had the σ of the landings decides alone, σ₀ of a launched column:
//! below 0.3 detachment, above 3 agreement; on a plate detachment where one landing in
//! twenty or more has σ < 1.

mod column;
#[cfg(test)]
mod tests;
mod twins;

use super::means::Mean;
use crate::math;
use crate::numerals::significant;
use crate::scene::Scene;

pub use twins::verdict;

/// Parts of a scale: what agrees differs by less, what is detached by more.
const AGREES: f64 = 0.05;
const DETACHED: f64 = 0.5;

/// ε_eff and E_r/E are compared with no less: differences of 0.01 are not seen.
const LEAST_SHARE: f64 = 0.2;

/// Standard errors by which a difference must be clear of a limit; and when all the work
/// is spent.
const SURE: f64 = 2.0;
const LIKELY: f64 = 1.0;

/// σ below which a launched column is detached, above which it agrees.
const CROSSOVER: (f64, f64) = (0.3, 3.0);

/// Part of the landings that must be dense for detachment where σ decides alone, and how
/// many landings say something.
const DENSE_SHARE: f64 = 0.05;
const LANDINGS: u64 = 20;

/// The verdict in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// Soft contacts lose far too little: they are not to be trusted.
    Detachment,
    /// The two begin to differ.
    Crossover,
    /// Soft contacts give what hard spheres give.
    Agreement,
}

impl Word {
    /// As it is printed.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Detachment => "detachment",
            Self::Crossover => "crossover",
            Self::Agreement => "agreement",
        }
    }
}

/// A quantity of both columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compared {
    /// Its name.
    name: &'static str,
    /// Its symbol.
    pub symbol: &'static str,
    unit: &'static str,
    /// Of soft contacts.
    pub soft: f64,
    /// Of hard spheres.
    pub hard: f64,
    /// Standard error of the difference.
    error: f64,
    /// The least scale of the difference.
    least: f64,
    /// Whether agreement must be proved by it.
    main: bool,
}

/// A verdict, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// In a word; none where there is nothing to judge, or where it is not decided.
    pub word: Option<Word>,
    /// Why, in a sentence with the numbers.
    pub because: String,
    /// What parts the columns most, for sure, where they were compared in motion.
    pub decisive: Option<Compared>,
}

impl Compared {
    /// ε_eff of soft contacts and of hard spheres.
    fn eps_eff(name: &'static str, both: [f64; 2]) -> Self {
        Self::share(name, "ε_eff", both)
    }

    /// The part of its energy that the column loses, 1 − ε_eff², of both.
    fn loss(eps_eff: [f64; 2]) -> Self {
        Self::share("part lost of E", "lost", eps_eff.map(|eps| 1.0 - eps * eps))
    }

    /// A number between 0 and 1 that has no error.
    fn share(name: &'static str, symbol: &'static str, [soft, hard]: [f64; 2]) -> Self {
        Self {
            name,
            symbol,
            unit: "",
            soft,
            hard,
            error: 0.0,
            least: LEAST_SHARE,
            main: true,
        }
    }

    /// Mean E_r over mean E.
    fn energy_share(soft: Mean, hard: Mean) -> Self {
        Self {
            error: both_errors(soft, hard),
            ..Self::share("E_r/E", "E_r/E", [soft.value, hard.value])
        }
    }

    /// Mean rise of the centre of mass over the resting column, m, on a plate of that
    /// amplitude, m.
    fn rise(soft: Mean, hard: Mean, amplitude: f64) -> Self {
        Self {
            name: "rise of h_cm",
            symbol: "rise",
            unit: " m",
            soft: soft.value,
            hard: hard.value,
            error: both_errors(soft, hard),
            least: amplitude,
            main: false,
        }
    }

    /// δ and its standard error.
    fn off(&self) -> (f64, f64) {
        let scale = self.soft.abs().max(self.hard.abs()).max(self.least);
        ((self.soft - self.hard).abs() / scale, self.error / scale)
    }

    /// The least that δ is, by so many standard errors.
    fn at_least(&self, errors: f64) -> f64 {
        let (off, error) = self.off();
        off - errors * error
    }

    /// The most.
    fn at_most(&self, errors: f64) -> f64 {
        self.at_least(-errors)
    }

    /// Both values, to three digits.
    fn told(&self) -> String {
        let [soft, hard] = [self.soft, self.hard].map(|x| significant(x, 3));
        format!("{} {soft} against {hard}{}", self.name, self.unit)
    }

    fn agrees(&self, errors: f64) -> bool {
        if self.main {
            self.at_most(errors) <= AGREES
        } else {
            self.at_least(errors) <= AGREES && self.off().1 <= AGREES
        }
    }
}

/// The word on some quantities that is clear of all limits by so many standard errors.
fn decide(of: &[Compared], errors: f64) -> Option<Word> {
    if of.iter().any(|q| q.at_least(errors) > DETACHED) {
        return Some(Word::Detachment);
    }
    if of.iter().all(|q| q.agrees(errors)) {
        return Some(Word::Agreement);
    }
    let differs = of.iter().any(|q| q.at_least(errors) > AGREES);
    let both = differs && of.iter().all(|q| q.at_most(errors) <= DETACHED);
    both.then_some(Word::Crossover)
}

impl Verdict {
    /// No word, and why.
    pub fn none(because: impl Into<String>) -> Self {
        Self {
            word: None,
            because: because.into(),
            decisive: None,
        }
    }

    /// Of what both columns gave; `more` is to be said besides.
    fn of(quantities: &[Compared], word: Option<Word>, more: &str) -> Self {
        let told = quantities.iter().map(Compared::told).collect::<Vec<_>>();
        let head = if word.is_none() { "not decided: " } else { "" };
        let worst = quantities
            .iter()
            .max_by(|a, b| a.at_least(SURE).total_cmp(&b.at_least(SURE)));
        Self {
            word,
            because: format!("{head}{} of hard spheres{more}", told.join(", ")),
            decisive: worst.copied(),
        }
    }

    /// By σ₀ alone, because `why` there is no comparison.
    fn by_sigma0(scene: &Scene, why: &str) -> Self {
        let Some(sigma) = scene.sigma0() else {
            return Self::none(why);
        };
        let word = match sigma {
            sigma if sigma < CROSSOVER.0 => Word::Detachment,
            sigma if sigma <= CROSSOVER.1 => Word::Crossover,
            _ => Word::Agreement,
        };
        Self {
            word: Some(word),
            ..Self::none(format!("by {} alone, since {why}", sigma0(sigma)))
        }
    }
}

/// Standard error of a difference of means.
fn both_errors(soft: Mean, hard: Mean) -> f64 {
    math::hypot(soft.error.unwrap_or(0.0), hard.error.unwrap_or(0.0))
}

fn sigma0(sigma: f64) -> String {
    format!("sigma_0 = {}", significant(sigma, 3))
}
