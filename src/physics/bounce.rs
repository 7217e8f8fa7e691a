//! ε_eff of the bounces of the whole column off its floor.

/// The bounce now and the last one. Energies in the floor's frame, the centre of
/// mass's part apart from E_r: after take-off the first is taken as it was when the
/// floor let go (gravity changes it later), the second goes on being lost in flight.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Bounce {
    arriving: Option<f64>,
    leaving: Option<(f64, f64)>,
    last: Option<f64>,
    crossing: Option<f64>,
}

/// The column as it arrives at its floor, in the floor's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arrival {
    /// ½M u|u| of the centre of mass's velocity u.
    pub translation: f64,
    /// E_r.
    pub relative: f64,
    /// Mean separation of the beads over |u|, s: σ times t_c.
    pub crossing: Option<f64>,
}

impl Bounce {
    /// The floor contact begins.
    pub fn begin(&mut self, arrival: Arrival) {
        if let Some((arrived, left)) = self.leaving.take() {
            self.last = Some(((left + arrival.relative) / arrived).sqrt());
        }
        if arrival.translation < 0.0 && self.arriving.is_none() {
            self.arriving = Some(arrival.relative - arrival.translation);
            self.crossing = arrival.crossing;
        }
    }

    /// The floor contact ends; `translation` as in [`Arrival`].
    pub fn end(&mut self, translation: f64) {
        if translation > 0.0
            && let Some(arrived) = self.arriving.take()
        {
            self.leaving = Some((arrived, translation));
        }
    }

    /// The column has come to rest on the floor.
    pub fn rest(&mut self) {
        if self.arriving.take().is_some() {
            (self.leaving, self.last) = (None, Some(0.0));
        }
    }

    /// Mean separation over speed when the column last arrived, s.
    pub fn crossing(&self) -> Option<f64> {
        self.crossing
    }

    /// √(E_f/E_0) of the last bounce, E_r being `relative` now.
    pub fn restitution(&self, relative: f64) -> Option<f64> {
        match self.leaving {
            Some((arrived, left)) => Some(((left + relative) / arrived).sqrt()),
            None => self.last,
        }
    }
}
