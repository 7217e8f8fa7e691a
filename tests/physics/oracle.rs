//! The soft column of Eqs. (1) to (3) once more: slow, simple, and in numbers of 32 digits, to
//! judge the exact engine by. Nothing here is the engine's.
//!
//! One clock for all gaps. While anything accelerates, all move in short common steps (an
//! eighth of a contact time), those that accelerate by as many Taylor terms as 32 digits
//! need, the others on straight lines. Contact changes are looked for in 16 samples of
//! value and slope a step, every minimum between two samples included, and bisected in
//! full precision.

mod series;

use crate::double_double::Double;
use crate::sampled_roots::value_and_slope;
use beadlab::physics::State;
use beadlab::scene::{Floor, FloorContact, Law, Method, Scene, Shake, Soft, angular, diameters};

/// Most Taylor terms a step.
const TERMS: usize = 64;
/// Part of the motion that a term left out may be.
const NEGLIGIBLE: f64 = 1e-34;
/// Rounding of a difference, over its terms.
const ROUNDING: f64 = 1e-28;
/// Velocities, over the largest, that no longer matter at the end of a collision: what
/// they could still change of the energy is the square.
const SETTLED: f64 = 1e-14;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Contact {
    Open,
    Acting,
    /// Overlapping, its attraction cut off.
    Slack,
}

/// A soft column under linear contacts.
pub struct Oracle {
    masses: Vec<Double>,
    stiffness: Vec<Double>,
    dashpot: Vec<Double>,
    attraction: bool,
    gravity: Double,
    /// A₀ and 2πf of a moving floor, which starts at phase 0.
    plate: Option<(Double, Double)>,
    /// Longest step.
    longest: Double,
    /// Rate at which overlaps are velocities.
    omega: f64,
    time: Double,
    gaps: Vec<Double>,
    rates: Vec<Double>,
    contacts: Vec<Contact>,
    /// Contact changes so far.
    pub changes: u64,
    /// Steps so far.
    pub steps: u64,
    /// Series of a gap so far: what the time goes into.
    pub work: u64,
    /// Shortest contact that was seen to begin and end, s.
    pub shortest_contact: f64,
    began: Vec<Double>,
}

impl Oracle {
    /// The scene at its start, whose gaps and rates are given by `start`.
    pub fn new(scene: &Scene, start: &State) -> Self {
        let Method::Soft(Soft {
            law: Law::Hooke { contact_time },
            attraction,
            ..
        }) = scene.method
        else {
            panic!("the reference is of linear contacts");
        };
        let n = scene.n;
        let ratio = |d: &f64| Double::from(*d) / scene.diameter;
        let cube = |x: Double| x * x * x;
        let masses: Vec<_> = diameters(scene).iter().map(ratio).map(cube).collect();
        // Eqs. (5)–(7): ω = π/t_c, μ = −ln ε/t_c; K = (m/2)(ω² + μ²), c = μm for equal beads.
        let mu = -Double::from(scene.restitution).ln() / contact_time;
        let omega = Double::PI / contact_time;
        let omega0_squared = omega * omega + mu * mu;
        let mut stiffness = vec![omega0_squared * 0.5; n];
        let mut dashpot = vec![mu * masses[0]; n];
        for i in 1..n {
            let (below, above) = (masses[i - 1], masses[i]);
            dashpot[i] = mu * 2.0 * (below * above / (below + above));
        }
        if scene.floor_contact == FloorContact::SameRestitution {
            // m g̈ = −K g − c ġ with frequency ω and decay μ.
            stiffness[0] = masses[0] * omega0_squared;
            dashpot[0] = masses[0] * mu * 2.0;
        }
        let plate = match scene.floor {
            Floor::Fixed => None,
            Floor::Vibrating(Shake {
                amplitude,
                frequency,
            }) => Some((amplitude.into(), Double::PI * 2.0 * frequency)),
        };
        // Steps short against everything that moves: contacts of the lightest bead, the plate.
        let lightest = masses.iter().map(|m| m.hi).fold(1.0, f64::min);
        let most = stiffness.iter().map(|k| k.hi).fold(0.0, f64::max);
        let spring = (4.0 * most / lightest).sqrt();
        let driven = match scene.floor {
            Floor::Fixed => 0.0,
            Floor::Vibrating(Shake { frequency, .. }) => angular(frequency),
        };
        let longest = (contact_time / 8.0).min(0.8 / spring).min(0.5 / driven);
        let gaps: Vec<_> = start.gaps.iter().copied().map(Double::from).collect();
        let rates: Vec<_> = start.rates.iter().copied().map(Double::from).collect();
        let mut oracle = Self {
            masses,
            stiffness,
            dashpot,
            attraction,
            gravity: scene.gravity.unwrap_or(0.0).into(),
            plate,
            longest: longest.into(),
            omega: omega0_squared.hi.sqrt(),
            time: start.time.into(),
            contacts: vec![Contact::Open; n],
            gaps,
            rates,
            changes: 0,
            steps: 0,
            work: 0,
            shortest_contact: f64::INFINITY,
            began: vec![start.time.into(); n],
        };
        for i in 0..n {
            if oracle.gaps[i] <= Double::ZERO {
                let pulls = oracle.pull(i, oracle.gaps[i], oracle.rates[i]) > Double::ZERO;
                let slack = pulls && !attraction;
                oracle.contacts[i] = if slack {
                    Contact::Slack
                } else {
                    Contact::Acting
                };
            }
        }
        oracle
    }

    /// Gaps, m.
    pub fn gaps(&self) -> Vec<f64> {
        self.gaps.iter().map(|g| g.hi).collect()
    }

    /// Rates of the gaps, m/s.
    pub fn rates(&self) -> Vec<f64> {
        self.rates.iter().map(|w| w.hi).collect()
    }

    /// Moves on to `until`, s.
    pub fn advance(&mut self, until: f64) {
        let until = Double::from(until);
        while self.time < until {
            self.step(until);
        }
    }

    /// Moves on until a floor collision without gravity is over; √(E_f/E_0) and E_r/E_f,
    /// or where it stood when it had taken `most` series of a gap.
    pub fn rebound(&mut self, most: u64) -> Result<(f64, f64), String> {
        let (before, _) = self.energies();
        while !self.is_over() {
            if self.work > most {
                return Err(format!(
                    "the reference gives up at t = {:e} s, after {} steps and {} contact changes",
                    self.time.hi, self.steps, self.changes
                ));
            }
            self.step(f64::MAX.into());
        }
        let (after, relative) = self.energies();
        Ok(((after / before).sqrt().hi, (relative / after).hi))
    }

    /// Kinetic energy over a floor at rest, and that relative to the centre of mass.
    fn energies(&self) -> (Double, Double) {
        let (mut mass, mut momentum, mut v) = (Double::ZERO, Double::ZERO, Double::ZERO);
        let mut velocities = Vec::new();
        for (w, m) in self.rates.iter().zip(&self.masses) {
            v += *w;
            mass += *m;
            momentum += *m * v;
            velocities.push(v);
        }
        let centre = momentum / mass;
        let mut energies = (Double::ZERO, Double::ZERO);
        for (v, m) in velocities.into_iter().zip(&self.masses) {
            energies.0 += *m * v * v * 0.5;
            energies.1 += *m * (v - centre) * (v - centre) * 0.5;
        }
        energies
    }

    fn is_over(&self) -> bool {
        let mut v = 0.0;
        let speeds = self.rates.iter().map(|w| {
            v += w.hi;
            f64::abs(v)
        });
        let small = SETTLED * speeds.fold(0.0, f64::max);
        (0..self.gaps.len()).all(|i| match self.contacts[i] {
            Contact::Open => self.rates[i].hi >= -small,
            // Overdamped contacts of heavy pairs never open.
            _ => self.rates[i].hi.abs() <= small && self.gaps[i].hi.abs() * self.omega <= small,
        })
    }

    /// What a contact pulls with: K g + c ġ.
    fn pull(&self, i: usize, g: Double, w: Double) -> Double {
        self.stiffness[i] * g + self.dashpot[i] * w
    }

    fn acting(&self, i: usize) -> bool {
        self.contacts.get(i) == Some(&Contact::Acting)
    }

    /// Whether gap `i` accelerates.
    fn accelerates(&self, i: usize) -> bool {
        let falls = i == 0 && self.gravity.hi != 0.0;
        falls || self.acting(i) || self.acting(i + 1) || (i > 0 && self.acting(i - 1))
    }

    /// One step, to the next contact change or to `until` if that comes first.
    fn step(&mut self, until: Double) {
        self.steps += 1;
        let n = self.gaps.len();
        let accelerated: Vec<usize> = (0..n).filter(|&i| self.accelerates(i)).collect();
        let rest = until - self.time;
        let mut h = rest;
        if !accelerated.is_empty() {
            h = h.min(self.longest);
        }
        let mut change = None;
        for i in (0..n).filter(|&i| !self.accelerates(i)) {
            if let Some((t, to)) = self.change_on_a_line(i)
                && t < h
            {
                (h, change) = (t, Some((i, to)));
            }
        }
        if let (Some((i, to)), true) = (change, h <= Double::ZERO) {
            self.work += 1;
            self.carry_out(i, to);
            return;
        }
        self.work += 1 + accelerated.len() as u64;
        let series = self.expand(&accelerated, h);
        let mut end = Double::ONE;
        for (&i, series) in accelerated.iter().zip(&series) {
            if let Some((s, to)) = self.change_in_a_series(i, series, h)
                && s <= end
            {
                (end, change) = (s, Some((i, to)));
            }
        }
        let tau = h * end;
        for i in (0..n).filter(|i| !accelerated.contains(i)) {
            self.gaps[i] += self.rates[i] * tau;
        }
        for (&i, series) in accelerated.iter().zip(&series) {
            let (g, w) = value_and_slope(series, end);
            (self.gaps[i], self.rates[i]) = (g, w / h);
        }
        self.time = if tau == rest { until } else { self.time + tau };
        if let Some((i, to)) = change {
            self.carry_out(i, to);
        }
    }

    fn carry_out(&mut self, i: usize, to: Contact) {
        self.changes += 1;
        let from = self.contacts[i];
        self.contacts[i] = to;
        if from == Contact::Open {
            self.began[i] = self.time;
        } else if to == Contact::Open {
            let lasted = (self.time - self.began[i]).hi;
            self.shortest_contact = self.shortest_contact.min(lasted);
        } else {
            return;
        }
        self.gaps[i] = Double::ZERO;
    }

    /// When gap `i`, which does not accelerate, changes, s from now, and to what.
    fn change_on_a_line(&self, i: usize) -> Option<(Double, Contact)> {
        let (g, w) = (self.gaps[i], self.rates[i]);
        match self.contacts[i] {
            Contact::Open if w < Double::ZERO => Some((-g / w, Contact::Acting)),
            // A slack contact that pulls opens before it acts; one that parts, at g = 0.
            Contact::Slack if w > Double::ZERO => Some((-g / w, Contact::Open)),
            Contact::Slack if w < Double::ZERO => {
                let (k, c) = (self.stiffness[i], self.dashpot[i]);
                let t = -(k * g + c * w) / (k * w);
                Some((
                    if t < Double::ZERO { Double::ZERO } else { t },
                    Contact::Acting,
                ))
            }
            _ => None,
        }
    }
}

type Change = Option<(Double, Contact)>;

fn earlier(a: Change, b: Change) -> Change {
    match (a, b) {
        (Some(x), Some(y)) => Some(if y.0 < x.0 { y } else { x }),
        (a, b) => a.or(b),
    }
}
