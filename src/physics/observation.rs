//! What can be seen of a column at one moment.

/// Energies per mean bead mass, m²/s².
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy E.
    pub kinetic: f64,
    /// Kinetic energy relative to the centre of mass, E_r ("granular temperature").
    pub relative: f64,
    /// Gravitational energy over the resting, just touching column on z = 0.
    pub potential: f64,
    /// Energy in the contact springs.
    pub elastic: f64,
    /// Energy lost in contacts since the start.
    pub lost: f64,
    /// Work done by the plate since the start.
    pub plate_work: f64,
    /// Relative drift of the ledger: what E_kin + E_pot + E_elastic + E_lost −
    /// W_plate has changed by, over the largest of its terms.
    pub drift: f64,
}

/// Integrals over time since an engine was built.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Integrals {
    /// Of the centre's reduced height, m s.
    pub height: f64,
    /// Those that give E's, for engines that have them too.
    pub energies: Option<Energies>,
}

impl Integrals {
    /// Both together, of stretches of time one after the other.
    pub(crate) fn and(self, later: Self) -> Self {
        let energies = self.energies.zip(later.energies);
        Self {
            height: self.height + later.height,
            energies: energies.map(|(first, then)| Energies {
                squares: first.squares + then.squares,
                relative: first.relative + then.relative,
            }),
        }
    }
}

/// Integrals over time of what E consists of, E = ½Mv² + E_r.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Energies {
    /// Of the square of the centre's velocity v, m²/s.
    pub squares: f64,
    /// Of E_r, m²/s.
    pub relative: f64,
}

/// What can be seen of a column, or of a lattice, at one moment.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Observation {
    /// Simulated time, s.
    pub time: f64,
    /// Height of the floor z₀, m.
    pub floor: f64,
    /// Velocity of the floor, m/s.
    pub floor_velocity: f64,
    /// Reduced heights z_i, m: zero for every bead of a column that just touches on z = 0.
    pub reduced: Vec<f64>,
    /// Velocities upwards, m/s.
    pub velocities: Vec<f64>,
    /// Gaps g_i of a column, m; negative is overlap. `gaps[0]` is between floor and bead 1.
    pub gaps: Vec<f64>,
    /// Which of them are contacts now.
    pub contacts: Vec<bool>,
    /// Mean reduced height of the centre of mass, m.
    pub centre: f64,
    /// Its velocity, m/s.
    pub centre_velocity: f64,
    /// Their integrals over time, for engines that have them in closed form.
    pub integrals: Option<Integrals>,
    /// Energies and the ledger.
    pub energy: Energy,
    /// Mean free flight between successive contacts of the same pair, s: over the
    /// contacts begun in the last plate period (fixed floor: since the start).
    /// Divided by t_c it is the live σ. None before the first flight.
    pub free_flight: Option<f64>,
    /// The same as it was when the last contact ended: of a collision that is over.
    pub settled_flight: Option<f64>,
    /// ε_eff of the last bounce off the floor, in the floor's frame: √(E_f/E_0).
    pub bounce: Option<f64>,
    /// When the column last arrived at its floor: mean separation of its beads over its
    /// speed, s. Divided by t_c it is the σ of that landing, as σ₀ = s₀/(|v₀| t_c) is
    /// of a launched column. None for a single bead.
    pub crossing: Option<f64>,
    /// The smallest of that over the landings of the last ten plate periods (fixed
    /// floor: since the start), s.
    pub densest: Option<f64>,
    /// When bead 1 first touched the floor, s.
    pub floor_touched: Option<f64>,
    /// When bead 1 last left the floor, s. The time between is the paper's t_k, "the
    /// total time of the interaction of the whole column of beads with the wall".
    pub floor_left: Option<f64>,
    /// The deepest overlap seen so far, m, of soft contacts.
    pub deepest: f64,
    /// Steps done (MD).
    pub steps: u64,
    /// Collisions done (ED).
    pub events: u64,
    /// How often a contact has begun or ended, and two hard beads have collided, so far.
    pub changes: u64,
    /// How often the column has landed on its floor.
    pub landings: u64,
    /// Collapses of hard beads that were closed: see the limits in the README.
    pub closed: u64,
    /// Where the beads of a lattice are in their plane; of a lattice only.
    pub discs: Option<Discs>,
}

impl Observation {
    /// The paper's t_k, s, once bead 1 has left the floor.
    pub fn floor_contact(&self) -> Option<f64> {
        let both = self.floor_left.zip(self.floor_touched);
        both.map(|(left, touched)| left - touched)
    }
}

/// The beads of a lattice in their plane, which repeats itself across.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Discs {
    /// Beads in a row: bead i stood in row i / columns.
    pub columns: usize,
    /// Width L after which everything repeats, m.
    pub period: f64,
    /// Diameter of all beads, m.
    pub diameter: f64,
    /// Places of the centres across, m; beads that leave on one side are not brought back
    /// in on the other: where they are in a period is the remainder by it.
    pub x: Vec<f64>,
    /// Heights of the centres over the floor at 0, m.
    pub heights: Vec<f64>,
    /// Which beads touch another or the floor.
    pub touching: Vec<bool>,
    /// Pairs of beads that touch, the lower number first.
    pub contacts: Vec<[usize; 2]>,
}
