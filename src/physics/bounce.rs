//! The bounces of the whole column off its floor: ε_eff, and how dense it lands.

use std::collections::VecDeque;

/// The bounce now and the last one.
///
/// Energies are those in the floor's frame, in two parts. The centre of mass's is taken when
/// the floor lets go, since gravity changes it later. E_r is taken when it is asked for, since
/// contacts in flight go on losing it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Bounce {
    arriving: Option<f64>,
    leaving: Option<(f64, f64)>,
    last: Option<f64>,
    arrivals: u64,
    landings: LandingLog,
}

/// Plate periods for which a landing is remembered. Dense and loose landings alternate over
/// a few periods.
const MEMORY: f64 = 10.0;
/// Landings remembered at most.
const MOST: usize = 64;

/// The last landings: when, and mean separation over speed, s. A landing that a denser one
/// has followed is not kept, so the first of them is the densest.
#[derive(Debug, Clone, Default, PartialEq)]
struct LandingLog {
    last: Option<f64>,
    densest: VecDeque<(f64, f64)>,
}

impl LandingLog {
    fn add(&mut self, time: f64, crossing: f64) {
        self.last = Some(crossing);
        while self
            .densest
            .back()
            .is_some_and(|&(_, denser)| denser >= crossing)
        {
            self.densest.pop_back();
        }
        if self.densest.len() < MOST {
            self.densest.push_back((time, crossing));
        }
    }

    fn densest_since(&self, time: f64) -> Option<f64> {
        let recent = self.densest.iter().find(|&&(when, _)| when >= time);
        recent.map(|&(_, crossing)| crossing)
    }

    fn forget_before(&mut self, time: f64) {
        while self.densest.front().is_some_and(|&(when, _)| when < time) {
            self.densest.pop_front();
        }
    }
}

/// The column as it arrives at its floor, in the floor's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arrival {
    /// When, s.
    pub time: f64,
    /// Period of the plate, s; infinite for a fixed floor.
    pub period: f64,
    /// ½M u|u| of the centre of mass's velocity u.
    pub translation: f64,
    /// E_r.
    pub relative: f64,
    /// Mean separation of the beads over |u|, s: σ times t_c.
    pub crossing: Option<f64>,
}

impl Bounce {
    /// The floor's contact begins (`closed`) or ends, with the column as it is then.
    pub fn turn(&mut self, closed: bool, arrival: Arrival) {
        if closed {
            self.begin(arrival);
        } else {
            self.end(arrival.translation);
        }
    }

    /// Whether the column has arrived since it last left. Further contacts with the floor are
    /// then part of the same bounce, and need no [`Arrival`].
    pub fn has_arrived(&self) -> bool {
        self.arriving.is_some()
    }

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
        self.arrivals += 1;
        if let Some(crossing) = arrival.crossing {
            self.landings
                .forget_before(arrival.time - MEMORY * arrival.period);
            self.landings.add(arrival.time, crossing);
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

    /// How often the column has arrived at its floor.
    pub fn arrivals(&self) -> u64 {
        self.arrivals
    }

    /// Mean separation over speed when the column last arrived, s.
    pub fn crossing(&self) -> Option<f64> {
        self.landings.last
    }

    /// The smallest such time of the last ten plate periods, s; on a fixed floor, of all.
    pub fn densest(&self, time: f64, period: f64) -> Option<f64> {
        self.landings.densest_since(time - MEMORY * period)
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

    fn arrival(time: f64, translation: f64, crossing: f64) -> Arrival {
        Arrival {
            time,
            period: 1.0,
            translation,
            relative: 0.0,
            crossing: Some(crossing),
        }
    }

    #[test]
    fn a_bead_that_comes_back_belongs_to_the_same_bounce() {
        let mut bounce = Bounce::default();
        bounce.begin(arrival(0.0, -1.0, 0.5));
        bounce.end(0.5);
        bounce.begin(arrival(0.1, 0.5, 0.1));
        bounce.end(0.25);
        assert_eq!(bounce.restitution(0.0), Some(0.5));
        assert_eq!(bounce.crossing(), Some(0.5));
        bounce.begin(arrival(1.0, -2.0, 3.0));
        bounce.rest();
        assert_eq!(bounce.restitution(0.0), Some(0.0));
        assert_eq!(bounce.crossing(), Some(3.0));
        // The denser landing counts for ten periods, then the later one, then none.
        for (time, densest) in [(9.9, Some(0.5)), (10.5, Some(3.0)), (11.5, None)] {
            assert_eq!(bounce.densest(time, 1.0), densest, "at {time}");
        }
    }
}
