//! Which gaps are contacts, when contacts begin and end, and the free flights between.

/// Parts of a plate period in which flights are counted together.
const BUCKETS: i64 = 64;

/// The contacts of a column so far.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ContactLog {
    closed: Vec<bool>,
    open_count: usize,
    /// Contacts begun and ended so far; collisions, which do both at once, not counted.
    changes: u64,
    /// When each gap's last contact ended; NaN-free: None before the first.
    ended: Vec<Option<f64>>,
    last: Option<f64>,
    floor: (Option<f64>, Option<f64>),
    flights: Flights,
}

/// Sum and number of the flights that ended in the last plate period, or since the
/// start. In buckets, so that memory is bounded however many collisions a period has.
#[derive(Debug, Clone, PartialEq)]
struct Flights {
    /// The plate's, s; infinite without one, so that all flights are counted alike.
    period: f64,
    buckets: Vec<(i64, f64, u64)>,
}

impl Flights {
    fn new(period: f64) -> Self {
        let len = if period.is_finite() { BUCKETS } else { 1 };
        let buckets = (0..len).map(|_| (0, 0.0, 0)).collect();
        Self { period, buckets }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "a count of 64ths of a period"
    )]
    fn serial(&self, time: f64) -> i64 {
        (time / self.period * BUCKETS as f64) as i64
    }

    fn add(&mut self, time: f64, flight: f64) {
        let serial = self.serial(time);
        // Without a period every serial is 0.
        let slot = usize::try_from(serial % BUCKETS).expect("below 64");
        let bucket = &mut self.buckets[slot];
        if bucket.0 != serial {
            *bucket = (serial, 0.0, 0);
        }
        bucket.1 += flight;
        bucket.2 += 1;
    }

    fn sum(&self, time: f64) -> (f64, u64) {
        let serial = self.serial(time);
        self.buckets
            .iter()
            .filter(|bucket| bucket.0 + BUCKETS > serial)
            .fold((0.0, 0), |(sum, count), bucket| {
                (sum + bucket.1, count + bucket.2)
            })
    }
}

impl ContactLog {
    /// A log of a column whose gaps are `closed` at the start, `period` s being the
    /// plate's.
    pub fn new(closed: Vec<bool>, time: f64, period: Option<f64>) -> Self {
        Self {
            open_count: closed.iter().filter(|&&closed| !closed).count(),
            ended: vec![None; closed.len()],
            floor: (closed[0].then_some(time), None),
            closed,
            changes: 0,
            last: None,
            flights: Flights::new(period.unwrap_or(f64::INFINITY)),
        }
    }

    /// One more contact, open and never closed so far; its number.
    pub fn add(&mut self) -> usize {
        self.closed.push(false);
        self.ended.push(None);
        self.open_count += 1;
        self.closed.len() - 1
    }

    /// Goes on with another plate period.
    pub fn set_period(&mut self, period: Option<f64>) {
        let period = period.unwrap_or(f64::INFINITY);
        if self.flights.period != period {
            self.flights = Flights::new(period);
        }
    }

    /// Notes whether gap `i` is a contact now.
    pub fn note(&mut self, i: usize, closed: bool, time: f64) {
        if self.closed[i] == closed {
            return;
        }
        self.closed[i] = closed;
        self.changes += 1;
        if closed {
            self.open_count -= 1;
            self.begins(i, time);
        } else {
            self.open_count += 1;
            self.ends(i, time);
        }
    }

    /// Notes a collision that begins and ends at once.
    pub fn touch(&mut self, i: usize, time: f64) {
        if self.closed[i] {
            self.note(i, false, time);
        } else {
            self.begins(i, time);
            self.ends(i, time);
        }
    }

    /// The same of gap `i` above the floor's, when those beside it are no contacts.
    #[inline]
    pub fn touch_alone(&mut self, i: usize, time: f64) {
        if !self.all_open() {
            self.note(i - 1, false, time);
            self.note(i, false, time);
            if i + 1 < self.closed.len() {
                self.note(i + 1, false, time);
            }
        }
        self.begins(i, time);
        self.ends(i, time);
    }

    fn begins(&mut self, i: usize, time: f64) {
        if i == 0 {
            self.floor.0.get_or_insert(time);
        }
        if let Some(ended) = self.ended[i] {
            self.flights.add(time, time - ended);
        }
    }

    fn ends(&mut self, i: usize, time: f64) {
        self.ended[i] = Some(time);
        self.last = Some(time);
        if i == 0 {
            self.floor.1 = Some(time);
        }
    }

    /// How many contacts have begun or ended so far, collisions not counted.
    pub fn changes(&self) -> u64 {
        self.changes
    }

    /// Which gaps are contacts.
    pub fn closed(&self) -> &[bool] {
        &self.closed
    }

    /// Whether no gap is a contact.
    pub fn all_open(&self) -> bool {
        self.open_count == self.closed.len()
    }

    /// When the floor contact first began and when it last ended, s.
    pub fn floor(&self) -> (Option<f64>, Option<f64>) {
        self.floor
    }

    /// When the last contact that ended did so, s.
    pub fn last(&self) -> Option<f64> {
        self.last
    }

    /// [`ContactLog::free_flight`] when the last contact ended.
    pub fn settled_flight(&self) -> Option<f64> {
        self.free_flight(self.last?)
    }

    /// Mean free flight between successive contacts of the same pair, s. A pair that flies
    /// now counts once it has flown longer than the mean.
    pub fn free_flight(&self, time: f64) -> Option<f64> {
        let (sum, count) = self.flights.sum(time);
        let mean = if count == 0 { 0.0 } else { sum / count as f64 };
        let flying = self
            .closed
            .iter()
            .zip(&self.ended)
            .filter(|&(closed, _)| !closed)
            .filter_map(|(_, ended)| ended.map(|ended| time - ended))
            .filter(|&flown| flown > mean);
        let (sum, count) =
            flying.fold((sum, count), |(sum, count), flown| (sum + flown, count + 1));
        (count > 0).then(|| sum / count as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flights_of_the_last_period_only() {
        let mut log = ContactLog::new(vec![true], 0.0, Some(1.0));
        log.note(0, false, 0.0);
        log.note(0, true, 0.25); // a flight of 0.25
        log.note(0, false, 0.5);
        assert_eq!(log.free_flight(0.5), Some(0.25));
        log.note(0, true, 2.0); // a flight of 1.5; the first is more than a period old
        assert_eq!(log.free_flight(2.0), Some(1.5));
        assert_eq!(
            (log.floor(), log.last()),
            ((Some(0.0), Some(0.5)), Some(0.5))
        );
    }

    #[test]
    fn a_flying_pair_counts_once_it_flew_longer_than_the_mean() {
        let mut log = ContactLog::new(vec![true, false], 0.0, None);
        log.note(0, false, 1.0);
        log.note(0, true, 2.0);
        log.note(0, false, 3.0);
        assert_eq!(log.free_flight(3.5), Some(1.0));
        assert_eq!(log.free_flight(5.0), Some(1.5));
    }
}
