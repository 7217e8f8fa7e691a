//! When the stack on the floor is taken as resting, and what it does then.

use std::collections::BTreeMap;

use super::rest::{LARGEST, Rest, Stack};
use super::{Exact, Gap, Mode};
use crate::physics::flight::Ground;
use crate::physics::ledger::Ledger;

/// Series without a change after which a stack may be at rest.
const QUIET: u32 = 16;

/// What is known of stacks on the floor.
#[derive(Debug)]
pub(super) struct Repose {
    /// Stacks by their number of beads, made when they first may rest; of those too
    /// large for a transient the last one only, so that memory stays O(N).
    stacks: BTreeMap<usize, Stack>,
    /// The rest that goes on, if one does.
    rest: Option<Rest>,
    /// Beads in the stack that rests.
    resting: usize,
    /// Plans since the floor's cluster last changed.
    quiet: u32,
}

impl Repose {
    pub fn new() -> Self {
        Self {
            stacks: BTreeMap::new(),
            rest: None,
            resting: 0,
            // What starts at rest is at rest at once.
            quiet: QUIET,
        }
    }

    /// Something changes on the floor.
    pub fn disturb(&mut self) {
        self.quiet = 0;
    }
}

impl<G: Ground> Exact<G> {
    /// Until when the floor's cluster rests for sure, if it does: a stack of pushing
    /// contacts, and perhaps a bead that falls onto it.
    pub(super) fn plan_rest(&mut self, low: usize, high: usize) -> Option<f64> {
        if !G::PULLS || low > 0 {
            return None;
        }
        self.repose.quiet += 1;
        if self.repose.quiet <= QUIET {
            return None;
        }
        // Looked for again only after some more series.
        self.repose.quiet = 0;
        let pushing = |mode: &&Mode| **mode == Mode::Pushing;
        let m = self.modes[..high].iter().take_while(pushing).count();
        let alone = m == high || (m + 1 == high && self.modes[m] == Mode::Open);
        if m == 0 || !alone {
            return None;
        }
        let t = self.gaps[0].t;
        let most = if m < high {
            let (g, w) = self.over_stack(m);
            // It cannot hit the stack before it would hit the plate below.
            if g <= 0.0 {
                return None;
            }
            self.ground.hit(t, g, w) - t
        } else {
            f64::INFINITY
        };
        let plate = self.ground.plate(t);
        let stacks = &mut self.repose.stacks;
        stacks.retain(|&beads, _| beads <= LARGEST || beads == m);
        let stack = stacks.entry(m).or_insert_with(|| {
            Stack::new(&self.springs[..m], &self.masses[..m], self.gravity, plate)
        });
        let (gaps, rates): (Vec<_>, Vec<_>) =
            self.gaps[..m].iter().map(|gap| (gap.g, gap.w)).unzip();
        let rest = stack.rest(&gaps, &rates, plate.phase, most)?;
        let until = t + rest.lasts;
        (self.repose.rest, self.repose.resting) = (Some(rest), m);
        self.repose.quiet = QUIET;
        Some(until)
    }

    /// Reduced height over the floor and relative velocity of the bead over a stack of
    /// `m`, at the time of the floor's cluster.
    fn over_stack(&self, m: usize) -> (f64, f64) {
        let add = |(g, w), gap: &Gap| (g + gap.g, w + gap.w);
        self.gaps[..=m].iter().fold((0.0, 0.0), add)
    }

    /// Beads in the stack that rests.
    pub(super) fn beads_at_rest(&self) -> usize {
        self.repose.resting
    }

    /// The stack that rests, and its rest.
    fn resting(&self) -> (usize, &Stack, &Rest) {
        let m = self.repose.resting;
        match (self.repose.stacks.get(&m), &self.repose.rest) {
            (Some(stack), Some(rest)) => (m, stack, rest),
            _ => unreachable!("a rest is planned with its stack"),
        }
    }

    /// Gaps and rates of the floor's cluster at `t`, while it rests.
    pub(super) fn at_rest(&self, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let (m, stack, rest) = self.resting();
        let t0 = self.gaps[0].t;
        let tau = (t - t0).min(rest.lasts);
        stack.at(rest, tau, &stack.later(rest, tau), gaps, rates);
        if m < self.end[0] {
            let (g, w) = self.over_stack(m);
            let (height, speed) = self.ground.fall(t0, g, w, t);
            gaps[m] = height - gaps[..m].iter().sum::<f64>();
            rates[m] = speed - rates[..m].iter().sum::<f64>();
        }
    }

    /// Books what the resting stack has lost, and as the plate's work what its energy
    /// has grown by with that.
    pub(super) fn account_rest(&self, t: f64, ledger: &mut Ledger) {
        let (m, stack, rest) = self.resting();
        let t0 = self.gaps[0].t;
        let tau = (t - t0).min(rest.lasts);
        let now = stack.later(rest, tau);
        let lost = stack.lost(rest, tau, &now);
        let (before, before_rates): (Vec<_>, Vec<_>) =
            self.gaps[..m].iter().map(|gap| (gap.g, gap.w)).unzip();
        let (mut after, mut after_rates) = (vec![0.0; m], vec![0.0; m]);
        stack.at(rest, tau, &now, &mut after, &mut after_rates);
        let energy = |gaps: &[f64], rates: &[f64], t: f64| {
            let mut moment = self.moment(gaps, rates, t);
            moment.masses = &self.masses[..m];
            let energy = moment.energy();
            energy.kinetic + energy.potential + energy.elastic
        };
        ledger.lost.add(lost);
        if G::MOVES {
            let grown = energy(&after, &after_rates, t) - energy(&before, &before_rates, t0);
            ledger.plate_work.add(grown + lost);
        }
    }
}
