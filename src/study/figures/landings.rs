//! The landings of a shaken column: how dense each is, and in which order they come.

use super::Claim;
use crate::physics::Observation;
use crate::study::fit::median;

/// A landing of the column on the plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Landing {
    /// When it was seen, s.
    pub time: f64,
    /// Mean gap over the speed and t_c.
    pub sigma: f64,
    /// Mean E_r over mean E from here to the next landing.
    pub after: Option<f64>,
}

impl Landing {
    /// Whether gaps are crossed in less than a contact lasts.
    pub fn is_dense(&self) -> bool {
        self.sigma < 1.0
    }
}

/// Collects landings from looks at a column: its crossing time stays until the next one.
#[derive(Debug, Clone)]
pub(super) struct Landings {
    contact_time: f64,
    crossing: Option<f64>,
    all: Vec<Landing>,
    relative: f64,
    kinetic: f64,
}

impl Landings {
    /// Of a column with that t_c, s.
    pub fn new(contact_time: f64) -> Self {
        Self {
            contact_time,
            crossing: None,
            all: Vec::new(),
            relative: 0.0,
            kinetic: 0.0,
        }
    }

    /// One look.
    pub fn look(&mut self, seen: &Observation) {
        if seen.crossing != self.crossing {
            if let Some(last) = self.all.last_mut() {
                last.after = (self.kinetic > 0.0).then(|| self.relative / self.kinetic);
            }
            (self.relative, self.kinetic) = (0.0, 0.0);
            self.crossing = seen.crossing;
            self.all.extend(self.crossing.map(|crossing| Landing {
                time: seen.time,
                sigma: crossing / self.contact_time,
                after: None,
            }));
        }
        self.relative += seen.energy.relative;
        self.kinetic += seen.energy.kinetic;
    }

    /// All so far, in their order; what comes after the last is not seen to its end.
    pub fn all(&self) -> &[Landing] {
        &self.all
    }
}

/// Part of the landings that is dense.
pub(super) fn dense_share(landings: &[Landing]) -> f64 {
    landings.iter().filter(|l| l.is_dense()).count() as f64 / landings.len() as f64
}

/// By what E_r/E changes at dense landings and at loose ones: medians.
pub(super) fn changes(landings: &[Landing]) -> (f64, f64) {
    let of = |dense: bool| {
        let pairs = landings.windows(2);
        let some = pairs.filter(|pair| pair[1].is_dense() == dense);
        median(
            &some
                .filter_map(|pair| Some(pair[1].after? / pair[0].after?))
                .collect::<Vec<_>>(),
        )
    };
    (of(true), of(false))
}

/// Times between dense landings, in periods of the plate, and how many landings later
/// each comes. One that comes right after another belongs to the same burst, and is left
/// out.
fn apart(landings: &[Landing], period: f64) -> Vec<(usize, f64)> {
    let dense = landings.iter().enumerate().filter(|(_, l)| l.is_dense());
    let dense: Vec<(usize, f64)> = dense.map(|(k, l)| (k, l.time / period)).collect();
    let apart = dense.windows(2).map(|d| (d[1].0 - d[0].0, d[1].1 - d[0].1));
    apart.filter(|(landings, _)| *landings > 1).collect()
}

/// Median of those times, in periods.
pub(super) fn return_time(landings: &[Landing], period: f64) -> f64 {
    let times = apart(landings, period);
    median(
        &times
            .iter()
            .map(|(_, periods)| *periods)
            .collect::<Vec<_>>(),
    )
}

/// What a number of periods may be off a whole one: some looks.
const WHOLE: f64 = 0.02;

/// Landings from a dense one to the next: fewer do not close the column.
const LATER: std::ops::RangeInclusive<usize> = 4..=11;

/// "A pattern which alternates", and its "periodic change": dense landings come some
/// landings after another, and, since a column that has come to rest takes off at the same
/// phase of the plate each time, whole periods after it. Landings in any other order meet
/// neither.
pub(super) fn alternation(landings: &[Landing], period: f64) -> [Claim; 2] {
    let times = apart(landings, period);
    let part = |is: &dyn Fn(&(usize, f64)) -> bool| {
        times.iter().filter(|time| is(time)).count() as f64 / times.len() as f64
    };
    [
        Claim::between(
            "dense again 4 to 11 landings on",
            "alternating",
            part(&|(landings, _)| LATER.contains(landings)),
            (0.75, 1.0),
        ),
        Claim::between(
            "dense again whole periods on",
            "periodic",
            part(&|(_, periods)| (periods - periods.round()).abs() < WHOLE),
            (0.75, 1.0),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::MethodName;
    use crate::study::figures::runs::{looks, preset};

    #[test]
    fn shuffled_landings_do_not_alternate() {
        let scene = preset("fig5b", Some(MethodName::Exact), &[]).expect("a preset");
        let period = scene.period().expect("a plate");
        let mut landings = Landings::new(scene.contact_time().expect("soft"));
        looks(&scene, 240.0 * period, 48_000, |seen| landings.look(seen)).expect("a sound run");
        let mut landings = landings.all().to_vec();
        assert!(landings.len() > 200);
        assert!(alternation(&landings, period).iter().all(|c| c.within));
        // Times stay, what lands is dealt out anew: 1000 times, by Knuth's generator.
        let mut state = 1_u64;
        let mut below = |n: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            usize::try_from((u128::from(state) * n as u128) >> 64).expect("below n")
        };
        let mut met = [0; 2];
        for _ in 0..1000 {
            for k in (1..landings.len()).rev() {
                let other = below(k + 1);
                let (a, b) = (landings[k].sigma, landings[other].sigma);
                (landings[k].sigma, landings[other].sigma) = (b, a);
            }
            for (met, claim) in met.iter_mut().zip(alternation(&landings, period)) {
                *met += u32::from(claim.within);
            }
        }
        // Chance puts 0.55 of the dense landings 4 to 11 apart and 0.15 on whole periods,
        // which scatter by 0.065 and less with 60 of them: 0.75 is three times that away,
        // and more than ten times.
        assert!(met[0] < 20 && met[1] == 0, "{met:?}");
    }
}
