//! What is simulated: physical facts only, checked once, in [`Scene::new`].
//!
//! What a scene lacks does not exist in its type: a fixed floor has no
//! amplitude, a scene without gravity has no weight, a hard-sphere scene has no
//! contact time. So no engine can pay for it and no panel can show it.

mod draft;
mod error;
pub mod lattice;
mod law;
mod method;
pub mod parameters;
mod parts;
pub mod preset;
mod start;
mod validate;
pub(crate) mod words;

pub use draft::Draft;
pub use error::SceneError;
pub use law::{Exponents, Law, LawName, PowerLaw, rebound};
pub use method::MethodName;
pub use parts::{GridSettings, Launch, Shake, Soft};
pub use preset::Preset;
pub use start::{diameters, initial_gaps};

use std::ops::Deref;

/// How the column starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// All beads move alike, apart from each other.
    Launched(Launch),
    /// At rest on the floor and moving with it, contacts in static equilibrium.
    Resting,
}

/// How the beads are arranged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Arrangement {
    /// One above the other.
    Column,
    /// Rows of a triangular lattice that is periodic across, in a plane (Sec. IV C).
    Lattice {
        /// Beads in a row: the width is so many lattice constants.
        columns: usize,
        /// Tangential dissipation constant D_t, 1/s, Eq. (4); mostly 0.
        tangential: f64,
    },
}

/// What the column stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Floor {
    /// A floor that never moves.
    Fixed,
    /// A plate that moves as z₀(t) = A₀ sin(2πft), Eq. (1).
    Vibrating(Shake),
}

/// What the contact of bead 1 with the floor shares with a contact of two beads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FloorContact {
    /// The same spring K and dashpot c against an infinite mass, as in the paper:
    /// the floor's restitution is then ε_w = exp(−πμ/√(2ω₀² − μ²)), not ε.
    SameSpring,
    /// K and c chosen so that the floor's restitution is ε and its contact lasts t_c.
    SameRestitution,
}

/// Fixed-step integrators of the soft-contact method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integrator {
    /// Gear's fifth-order predictor–corrector, the paper's method (Ref. 27 there).
    Gear,
    /// Velocity Verlet.
    Verlet,
}

/// How the motion of soft contacts is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solver {
    /// On a fixed grid of time steps.
    Grid(GridSettings),
    /// To rounding: contact changes are located, and between them the linear column is
    /// propagated as what it is, a linear system.
    Exact,
    /// By an adaptive method of high order, for power laws: contact changes are located,
    /// and steps are as long as the tolerance allows.
    Adaptive {
        /// Local error of a step, relative to the motion of each contact.
        tolerance: f64,
    },
}

/// How collisions that happen very soon after one another lose energy (ED).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CollisionRule {
    /// Largest relative velocity first at simultaneous contacts (Sec. II B).
    Lrv,
    /// LRV, and a collision within `contact_time` of the bead's last one loses
    /// nothing: the TC model of Luding & McNamara (1998), later work.
    Tc {
        /// Cut-off t_c, s.
        contact_time: f64,
    },
}

impl CollisionRule {
    /// As they are typed.
    pub const WORDS: &[&str] = &["lrv", "tc"];

    /// As it is typed.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Lrv => "lrv",
            Self::Tc { .. } => "tc",
        }
    }
}

/// How the column is moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Soft contacts, molecular dynamics.
    Soft(Soft),
    /// Hard collisions, event driven: which of them lose energy.
    Hard(CollisionRule),
}

/// The facts of a scene, before they are checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// How the beads are arranged.
    pub arrangement: Arrangement,
    /// Number of beads N, of a lattice whole rows.
    pub n: usize,
    /// Mean diameter d, m.
    pub diameter: f64,
    /// Width w of the uniform distribution of diameters, m; 0 for equal beads.
    pub width: f64,
    /// Seed of everything random in the scene.
    pub seed: u64,
    /// Restitution ε of a pair of mean beads. Under a power law it follows from the law:
    /// [`Scene::new`] replaces whatever stands here by the restitution of a pair that
    /// meets at the scene's own speed, so that a hard twin knows it.
    pub restitution: f64,
    /// The floor's contact law.
    pub floor_contact: FloorContact,
    /// How the column starts.
    pub start: Start,
    /// Gravitational acceleration g, m/s², where there is gravity.
    pub gravity: Option<f64>,
    /// What the column stands on.
    pub floor: Floor,
    /// How it is moved.
    pub method: Method,
    /// How long a run lasts, s; without it a run lasts until the floor collision is over.
    pub duration: Option<f64>,
}

/// A scene whose facts are consistent and in range.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene(Facts);

impl Deref for Scene {
    type Target = Facts;

    fn deref(&self) -> &Facts {
        &self.0
    }
}

impl Facts {
    /// Reduced acceleration α = A₀(2πf)²/g of a vibrating floor.
    pub fn alpha(&self) -> Option<f64> {
        Some(self.shake()?.acceleration() / self.gravity?)
    }

    /// Contact time t_c, s, of a scene that has one. Under a power law, where it depends
    /// on the speed: that of an undamped pair that meets at the scene's own speed,
    /// Eq. (A2), by which steps are counted and σ is taken.
    pub fn contact_time(&self) -> Option<f64> {
        match self.method {
            Method::Soft(soft) => Some(soft.law.contact_time(self.own_speed())),
            Method::Hard(CollisionRule::Tc { contact_time }) => Some(contact_time),
            Method::Hard(CollisionRule::Lrv) => None,
        }
    }

    /// The speed, m/s, at which the beads of this scene meet, roughly: |v₀| of a launched
    /// column, else the plate's largest speed, else that of a fall by a diameter, √(gd).
    pub fn own_speed(&self) -> f64 {
        let moving = |speed: &f64| *speed != 0.0;
        let launched = self.launch().map(|launch| launch.v0.abs());
        let shaken = || self.shake().map(Shake::speed);
        launched
            .filter(moving)
            .or_else(|| shaken().filter(moving))
            .unwrap_or_else(|| (self.gravity.unwrap_or(f64::NAN) * self.diameter).sqrt())
    }

    /// Nominal σ₀ = s₀/(|v₀| t_c) before a floor collision.
    pub fn sigma0(&self) -> Option<f64> {
        let Launch { s0, v0, .. } = self.launch().filter(|launch| launch.v0 != 0.0)?;
        Some(s0 / (v0.abs() * self.contact_time()?))
    }

    /// Beads above one another: all of a column, the rows of a lattice.
    pub fn layers(&self) -> usize {
        self.sites().map_or(self.n, |sites| sites.rows)
    }

    /// Period of the plate, s.
    pub fn period(&self) -> Option<f64> {
        self.shake().map(|shake| 1.0 / shake.frequency)
    }

    /// Whether restitution and contact time follow from the law of soft contacts, and
    /// depend on the speed ([`Law::depends_on_speed`]).
    pub fn depends_on_speed(&self) -> bool {
        self.law().is_some_and(|law| law.depends_on_speed())
    }

    /// Whether the beads move by soft contacts.
    pub fn is_md(&self) -> bool {
        self.soft().is_some()
    }
}

/// Angular frequency 2πf, 1/s.
pub fn angular(frequency: f64) -> f64 {
    std::f64::consts::TAU * frequency
}
