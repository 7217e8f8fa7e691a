//! The energy ledger: E_kin + E_pot + E_elastic + E_lost − W_plate stays constant.

use super::observation::Energy;

/// A running sum that carries its rounding error along (Knuth's two-sum), since a
/// run adds millions of small losses to a large one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Sum {
    value: f64,
    carry: f64,
}

impl Sum {
    pub fn add(&mut self, x: f64) {
        let sum = self.value + x;
        let added = sum - self.value;
        self.carry += (self.value - (sum - added)) + (x - added);
        self.value = sum;
    }

    pub fn total(&self) -> f64 {
        self.value + self.carry
    }

    /// What [`Self::total`] would be with `x` added.
    pub fn with(self, x: f64) -> f64 {
        let mut more = self;
        more.add(x);
        more.total()
    }

    /// What is missing to `goal`.
    pub fn until(&self, goal: f64) -> f64 {
        (goal - self.value) - self.carry
    }
}

/// What a run has lost and been given, and what its sum should be.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Ledger {
    /// Energy lost in contacts.
    pub lost: Sum,
    /// Work done by the plate.
    pub plate_work: Sum,
    /// What the sum was at the start, edits taken into account.
    balance: f64,
    /// How wrong the sum was when another engine handed it over, m²/s².
    inherited: f64,
    /// Largest stored energy seen, the scale of the drift.
    scale: f64,
}

impl Ledger {
    /// The energies now, with the ledger's entries and the drift.
    pub fn closed(&self, stored: Energy) -> Energy {
        let energy = self.entered(stored);
        let scale = self
            .scale
            .max(stored_size(&energy))
            .max(energy.lost.abs())
            .max(energy.plate_work.abs());
        let error = sum(&energy) - self.balance;
        Energy {
            drift: if scale > 0.0 { error / scale } else { 0.0 },
            ..energy
        }
    }

    /// Opens the ledger on the energies now: at the start, or after an edit, which
    /// may change the stored energy by what it likes but not the error made so far.
    pub fn open(&mut self, stored: Energy) {
        self.balance = sum(&self.entered(stored)) - self.inherited;
        self.scale = self.scale.max(stored_size(&stored));
    }

    /// For an engine that goes on from the energies now.
    pub fn handed_over(self, stored: Energy) -> Self {
        Self {
            inherited: self.error(stored),
            ..self
        }
    }

    /// Whether the error exceeds all the energy that there ever was, `least` being a
    /// scale for columns that start without any: such a run has left physics behind.
    /// So has one whose energy is not a number.
    pub fn is_broken(&self, stored: Energy, least: f64) -> bool {
        let scale = self.scale.max(least) + self.plate_work.total().abs();
        let within = self.error(stored).abs() <= scale;
        !within
    }

    /// The error so far, m²/s², of the energies now.
    fn error(&self, stored: Energy) -> f64 {
        sum(&self.entered(stored)) - self.balance
    }

    fn entered(&self, stored: Energy) -> Energy {
        Energy {
            lost: self.lost.total(),
            plate_work: self.plate_work.total(),
            ..stored
        }
    }
}

fn sum(energy: &Energy) -> f64 {
    energy.kinetic + energy.potential + energy.elastic + energy.lost - energy.plate_work
}

fn stored_size(energy: &Energy) -> f64 {
    energy.kinetic + energy.potential.abs() + energy.elastic
}
