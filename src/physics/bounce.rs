//! ε_eff of the bounces of the whole column off its floor.

/// The bounce now and the last one. Energies in the floor's frame, the centre of
/// mass's part apart from E_r: after take-off the first is taken as it was when the
/// floor let go (gravity changes it later), the second goes on being lost in flight.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Bounce {
    arriving: Option<f64>,
    leaving: Option<(f64, f64)>,
    last: Option<f64>,
    landings: Landings,
}

/// Landings that are remembered: a shaken column is dense in one of a few.
const REMEMBERED: usize = 6;

/// The last landings, newest last: mean separation over speed, s.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Landings([f64; REMEMBERED]);

impl Default for Landings {
    fn default() -> Self {
        Self([f64::INFINITY; REMEMBERED])
    }
}

impl Landings {
    fn add(&mut self, crossing: f64) {
        self.0.rotate_left(1);
        self.0[REMEMBERED - 1] = crossing;
    }
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
        // A bead that comes back while the column rises is part of the same bounce.
        if arrival.translation >= 0.0 || self.arriving.is_some() {
            return;
        }
        if let Some((arrived, left)) = self.leaving.take() {
            self.last = Some(((left + arrival.relative) / arrived).sqrt());
        }
        self.arriving = Some(arrival.relative - arrival.translation);
        if let Some(crossing) = arrival.crossing {
            self.landings.add(crossing);
        }
    }

    /// The floor contact ends; `translation` as in [`Arrival`].
    pub fn end(&mut self, translation: f64) {
        if translation <= 0.0 {
            return;
        }
        let arrived = self
            .arriving
            .take()
            .or(self.leaving.map(|(arrived, _)| arrived));
        self.leaving = arrived.map(|arrived| (arrived, translation));
    }

    /// The column has come to rest on the floor.
    pub fn rest(&mut self) {
        if self.arriving.take().is_some() {
            (self.leaving, self.last) = (None, Some(0.0));
        }
    }

    /// Mean separation over speed when the column last arrived, s.
    pub fn crossing(&self) -> Option<f64> {
        let last = self.landings.0[REMEMBERED - 1];
        last.is_finite().then_some(last)
    }

    /// The smallest of the last few.
    pub fn densest(&self) -> Option<f64> {
        let least = self.landings.0.into_iter().fold(f64::INFINITY, f64::min);
        least.is_finite().then_some(least)
    }

    /// √(E_f/E_0) of the last bounce, E_r being `relative` now.
    pub fn restitution(&self, relative: f64) -> Option<f64> {
        match self.leaving {
            Some((arrived, left)) => Some(((left + relative) / arrived).sqrt()),
            None => self.last,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arrival(translation: f64, crossing: f64) -> Arrival {
        Arrival {
            translation,
            relative: 0.0,
            crossing: Some(crossing),
        }
    }

    #[test]
    fn a_bead_that_comes_back_belongs_to_the_same_bounce() {
        let mut bounce = Bounce::default();
        bounce.begin(arrival(-1.0, 0.5));
        bounce.end(0.5);
        bounce.begin(arrival(0.5, 0.1));
        bounce.end(0.25);
        assert_eq!(bounce.restitution(0.0), Some(0.5));
        assert_eq!(bounce.crossing(), Some(0.5));
        bounce.begin(arrival(-2.0, 3.0));
        bounce.rest();
        assert_eq!(bounce.restitution(0.0), Some(0.0));
        assert_eq!(
            (bounce.crossing(), bounce.densest()),
            (Some(3.0), Some(0.5))
        );
    }
}
