//! The epoch that an engine counts its times from. It moves on, so that times keep their
//! digits.

/// An epoch that moves on by whole ticks. Those are powers of two, and a move changes no bit
/// of an absolute time.
#[derive(Debug, Clone)]
pub(crate) struct Epoch {
    /// Simulated time at which the engine started, s.
    origin: f64,
    /// Time from there to the epoch, s.
    passed: f64,
}

impl Epoch {
    /// At the start of an engine, s.
    pub fn new(origin: f64) -> Self {
        let passed = 0.0;
        Self { origin, passed }
    }

    /// Time from the start to the epoch, s.
    pub fn passed(&self) -> f64 {
        self.passed
    }

    /// The simulated time, s, that lies `t` s after the epoch.
    pub fn absolute(&self, t: f64) -> f64 {
        self.origin + (self.passed + t)
    }

    /// How many seconds after the epoch the simulated time `time`, s, lies.
    pub fn since(&self, time: f64) -> f64 {
        (time - self.origin) - self.passed
    }

    /// Moves on by ticks of so many seconds in all.
    pub fn move_on(&mut self, by: f64) {
        self.passed += by;
    }
}
