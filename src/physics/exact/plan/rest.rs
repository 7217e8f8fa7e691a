//! A stack at rest on the floor, for as long as none of its contacts can open.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::centre_of_mass::Centre;
use super::super::cluster::Cluster;
use super::super::stack::{LARGEST, Stack, Transient};
use super::super::workspace::Workspace;
use super::{ClusterPlan, ContactMode};
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::matter::{Matter, Snapshot};

/// Plans in a row without a contact change on the floor, after which it is tried whether a
/// stack is at rest.
const QUIET: u32 = 16;

/// The stacks that have been at rest, and when to look for one again.
#[derive(Clone, Debug)]
pub(in super::super) struct Stacks {
    /// By their number of beads. Of those too large for a transient the last one only, so
    /// that memory stays O(N).
    made: BTreeMap<usize, Arc<Stack>>,
    /// Plans of the floor's cluster since a contact in it changed, or since the last try.
    quiet: u32,
}

impl Stacks {
    pub fn new() -> Self {
        Self {
            made: BTreeMap::new(),
            // A column that starts at rest is at rest at once.
            quiet: QUIET,
        }
    }

    /// A contact on the floor changes.
    pub fn disturb(&mut self) {
        self.quiet = 0;
    }

    /// Whether a stack may be at rest now that the floor's cluster is planned once more.
    fn may_rest(&mut self) -> bool {
        self.quiet += 1;
        let quiet = self.quiet > QUIET;
        if quiet {
            // The next try comes only after as many plans, if this one fails.
            self.quiet = 0;
        }
        quiet
    }
}

/// A stack at rest, and perhaps a bead that falls onto it.
#[derive(Clone, Debug)]
pub(in super::super) struct Rest {
    stack: Arc<Stack>,
    transient: Transient,
}

impl Rest {
    /// The rest that the floor's cluster is: pushing contacts from the floor up, and at most
    /// one open gap above them.
    pub fn plan<G: Ground>(cluster: &Cluster<G>, stacks: &mut Stacks) -> Option<Self> {
        if !G::PULLS || cluster.low > 0 || !stacks.may_rest() {
            return None;
        }
        let pushing = |mode: &&ContactMode| **mode == ContactMode::Pushing;
        let m = cluster.modes.iter().take_while(pushing).count();
        let alone = matches!(cluster.modes[m..], [] | [ContactMode::Open]);
        if m == 0 || !alone {
            return None;
        }
        let t = cluster.began();
        let most = if m < cluster.gaps.len() {
            let (g, w) = above_stack(cluster, m);
            // The bead cannot hit the stack before it would hit the plate below.
            if g <= 0.0 {
                return None;
            }
            cluster.ground.hit(t, g, w) - t
        } else {
            f64::INFINITY
        };
        let plate = cluster.ground.plate(t);
        let made = &mut stacks.made;
        made.retain(|&beads, _| beads <= LARGEST || beads == m);
        let stack = made.entry(m).or_insert_with(|| {
            let constants = cluster.constants;
            let (springs, masses) = (
                &constants.column.springs[..m],
                &constants.column.masses[..m],
            );
            Arc::new(Stack::new(springs, masses, constants.column.gravity, plate))
        });
        let (gaps, rates) = gaps_and_rates(cluster, m);
        let transient = Arc::make_mut(stack).rest(&gaps, &rates, plate.phase, most)?;
        let stack = Arc::clone(stack);
        stacks.quiet = QUIET;
        Some(Self { stack, transient })
    }

    /// Time between the beginning and `t`, s.
    fn elapsed<G: Ground>(&self, cluster: &Cluster<G>, t: f64) -> f64 {
        (t - cluster.began()).min(self.transient.lasts)
    }
}

/// Gaps and rates of the lowest `m` beads at the beginning.
fn gaps_and_rates<G: Ground>(cluster: &Cluster<G>, m: usize) -> (Vec<f64>, Vec<f64>) {
    cluster.gaps[..m].iter().map(|gap| (gap.g, gap.w)).unzip()
}

/// Height over the floor less the diameters below, m, and relative velocity, m/s, of the
/// bead over a stack of `m`, at the beginning.
fn above_stack<G: Ground>(cluster: &Cluster<G>, m: usize) -> (f64, f64) {
    let gaps = cluster.gaps[..=m].iter();
    gaps.fold((0.0, 0.0), |(g, w), gap| (g + gap.g, w + gap.w))
}

impl<G: Ground> ClusterPlan<G> for Rest {
    fn ends(&self, cluster: &Cluster<G>) -> f64 {
        cluster.began() + self.transient.lasts
    }

    fn change(&self, _: &Cluster<G>) -> Option<(usize, ContactMode)> {
        None
    }

    fn at(&self, cluster: &Cluster<G>, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let m = self.stack.beads();
        let tau = self.elapsed(cluster, t);
        let now = self.stack.later(&self.transient, tau);
        self.stack.at(&self.transient, tau, &now, gaps, rates);
        if m < cluster.gaps.len() {
            let (g, w) = above_stack(cluster, m);
            let (height, speed) = cluster.ground.fall(cluster.began(), g, w, t);
            gaps[m] = height - gaps[..m].iter().sum::<f64>();
            rates[m] = speed - rates[..m].iter().sum::<f64>();
        }
    }

    /// The work of the plate is what the stack's energy has grown by, and what it has lost.
    fn account(&self, cluster: &Cluster<G>, t: f64, ledger: &mut Ledger, _: &mut Workspace) {
        let m = self.stack.beads();
        let tau = self.elapsed(cluster, t);
        let now = self.stack.later(&self.transient, tau);
        let lost = self.stack.lost(&self.transient, tau, &now);
        let (before, before_rates) = gaps_and_rates(cluster, m);
        let (mut after, mut after_rates) = (vec![0.0; m], vec![0.0; m]);
        self.stack
            .at(&self.transient, tau, &now, &mut after, &mut after_rates);
        let energy = |gaps: Vec<f64>, rates: Vec<f64>, t: f64| {
            let stack = Snapshot {
                time: t,
                gaps,
                rates,
                plate: cluster.ground.plate(t),
            };
            let energy = cluster.constants.column.energy(&stack);
            energy.kinetic + energy.potential + energy.elastic
        };
        ledger.lost.add(lost);
        if G::MOVES {
            let began = energy(before, before_rates, cluster.began());
            let grown = energy(after, after_rates, t) - began;
            ledger.plate_work.add(grown + lost);
        }
    }

    fn pushed(
        &self,
        cluster: &Cluster<G>,
        centre: Centre,
        t: f64,
        gaps: &[f64],
        rates: &[f64],
    ) -> Centre {
        centre.carried(cluster, t, &gaps[..self.stack.beads()], rates)
    }
}
