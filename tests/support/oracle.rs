//! The soft column of DESIGN §1 once more: slow, simple, and in numbers of 32 digits, to
//! judge the exact engine by. Nothing here is the engine's.
//!
//! One clock for all gaps. While anything accelerates, all move in short common steps (an
//! eighth of a contact time), those that accelerate by as many Taylor terms as 32 digits
//! need, the others on straight lines. Contact changes are looked for in 16 samples of
//! value and slope a step, every minimum between two samples included, and bisected in
//! full precision.
#![allow(dead_code, reason = "every test uses its own part of this")]

use super::double_double::Double;
use super::sampled_roots::{first_below_zero, value_and_slope};
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

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.time.hi
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

    /// Taylor coefficients of these gaps in s = τ/h.
    fn expand(&self, accelerated: &[usize], h: Double) -> Vec<Vec<Double>> {
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
    fn change_in_a_series(&self, i: usize, gap: &[Double], h: Double) -> Option<(Double, Contact)> {
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

type Change = Option<(Double, Contact)>;

fn earlier(a: Change, b: Change) -> Change {
    match (a, b) {
        (Some(x), Some(y)) => Some(if y.0 < x.0 { y } else { x }),
        (a, b) => a.or(b),
    }
}
