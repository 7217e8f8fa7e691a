//! The plate's course after an edit of its amplitude or frequency.
//!
//! The plate passes from the old motion to the new one in one swing, which begins and ends in
//! its middle and takes about a period. Place, velocity and acceleration go on without a jump.
//! The plate never accelerates faster than the faster of both motions, so that what rests goes
//! on resting unless one of them throws it. Soft contacts do not ring either, where a quarter of
//! a swing is long against the column's own oscillations. After the swing the plate moves as its
//! formula has it, about height 0. The phase goes on all the time; an edit of the amplitude
//! alone does not shift it.

use std::collections::VecDeque;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::plate::Plate;

/// Amplitude below which a plate stands still, m.
const STILL: f64 = 1e-100;
/// A motion that is slower than another by this factor counts as none beside it.
const SLOW: f64 = 1e-9;

/// A time from which on the plate moves in another way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    /// When, s.
    pub time: f64,
    /// The plate then.
    pub plate: Plate,
    /// Whether what was edited begins to act here.
    begins: bool,
}

/// When the plate's motion last changed, and how it is going to. Columns that are edited
/// together turn at the same times, to the last bit, whatever engines they have.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Course {
    /// When it last changed, s, and the phase then.
    since: f64,
    phase: f64,
    ahead: VecDeque<Turn>,
}

impl Course {
    /// Whether the plate has moved as its formula has it since t = 0.
    pub fn is_untouched(&self) -> bool {
        *self == Self::default()
    }

    /// When the plate turns next, s.
    pub fn next(&self) -> Option<f64> {
        self.ahead.front().map(|turn| turn.time)
    }

    /// Takes the next turn.
    pub fn take(&mut self) -> Option<Turn> {
        let turn = self.ahead.pop_front()?;
        (self.since, self.phase) = (turn.time, turn.plate.phase);
        Some(turn)
    }

    /// Leads the plate, which moves as `now`, to the motion `to`. Nothing changes up to `after`,
    /// s, and edits that were to begin later are forgotten. Returns when the change is going to
    /// begin, s; none if the plate moves so already or is on its way to it.
    pub fn lead(&mut self, now: Plate, to: Plate, after: f64) -> Option<f64> {
        let later = |turn: &Turn| turn.begins && turn.time > after;
        let kept = self.ahead.iter().position(later);
        self.ahead.truncate(kept.unwrap_or(self.ahead.len()));
        let mut from = self.ahead.back().copied().unwrap_or(Turn {
            time: self.since,
            plate: Plate {
                phase: self.phase,
                ..now
            },
            begins: false,
        });
        if (from.plate.amplitude, from.plate.omega) == (to.amplitude, to.omega) {
            return None;
        }
        let after = after.max(from.time);
        if from.plate.amplitude < STILL {
            // A plate that stands still does so at any frequency.
            let still = from.plate;
            from = Turn {
                time: after,
                plate: Plate {
                    omega: to.omega,
                    ..still.later(after - from.time)
                },
                begins: true,
            };
            self.ahead.push_back(from);
            if to.amplitude < STILL {
                return Some(after);
            }
        }
        // The acceleration of a plate that starts or stops jumps at the lowest point. A growing
        // motion has it first, so it begins downwards; a shrinking one has it last.
        let grows = to.shake() > from.plate.shake();
        let start = from.passes(if grows { PI } else { 0.0 }, after);
        passage(from.plate, to, grows, start, &mut self.ahead);
        Some(start)
    }
}

impl Turn {
    /// The first time not before `after` at which the plate has this phase, s.
    fn passes(&self, phase: f64, after: f64) -> f64 {
        let period = self.plate.period();
        let first = ((phase - self.plate.phase) / TAU).rem_euclid(1.0);
        let passed = (after - self.time) / period;
        let whole = (passed - first).ceil().max(0.0);
        (self.time + (first + whole) * period).max(after)
    }
}

/// The turns of a passage that begins at `start`, s, as the plate passes its middle, `down`
/// or up.
///
/// It is made of four quarter swings. A quarter with the speed V in the middle and the
/// acceleration a at its end has the amplitude V²/a and ω = a/V. Two quarters that meet at
/// their ends share a; two that meet in the middle share V. So the four have (V₁, a), (V, a),
/// (V, b) and (V₂, b). They come back to the middle of both motions if
/// V² (1/a + 1/b) = V₁²/a + V₂²/b. The choice is a = ω₁²B and b = ω₂²B with
/// B = (A₁ + 2R + A₂)/4, R being the root mean square of A₁ and A₂: then an edit of A₀ takes
/// one period, and an edit of f goes no further than A₀.
fn passage(from: Plate, to: Plate, down: bool, start: f64, ahead: &mut VecDeque<Turn>) {
    let (old, new) = (from.amplitude, to.amplitude);
    let fastest = (old * from.omega).max(new * to.omega);
    let speed = |plate: Plate| match plate.amplitude * plate.omega {
        v if v < SLOW * fastest => 0.0,
        v => v,
    };
    let (first, last) = (speed(from), speed(to));
    // A plate at rest has no frequency of its own.
    let omega = if last == 0.0 { from.omega } else { to.omega };
    let square = 0.5 * (old * old + new * new);
    let middling = 0.25 * (old + 2.0 * square.sqrt() + new);
    let most = from.shake().max(to.shake());
    let a = (from.omega * from.omega * middling).min(most);
    let b = (omega * omega * middling).min(most);
    let middle = ((first * first / a + last * last / b) / (1.0 / a + 1.0 / b)).sqrt();
    let (sign, begun) = if down { (-1.0, PI) } else { (1.0, 0.0) };
    let centre = sign * (first * first - middle * middle) / a;
    let quarters = [
        (first, a, 0.0),
        (middle, a, centre),
        (middle, b, centre),
        (last, b, 0.0),
    ];
    let mut turn = Turn {
        time: start,
        plate: Plate {
            phase: begun,
            ..from
        },
        begins: true,
    };
    for (v, shake, centre) in quarters {
        if v > 0.0 {
            turn.plate = Plate {
                amplitude: v * v / shake,
                omega: shake / v,
                centre,
                ..turn.plate
            };
            ahead.push_back(turn);
            turn.time += FRAC_PI_2 * v / shake;
            turn.begins = false;
        }
        turn.plate.phase = (turn.plate.phase + FRAC_PI_2) % TAU;
    }
    turn.plate = Plate { phase: begun, ..to };
    ahead.push_back(turn);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plate(amplitude: f64, frequency: f64) -> Plate {
        Plate {
            amplitude,
            omega: TAU * frequency,
            ..Plate::default()
        }
    }

    /// The motions that a plate goes through, with the times at which they begin.
    fn motions(from: Plate, course: &Course) -> Vec<Turn> {
        let first = Turn {
            time: 0.0,
            plate: from,
            begins: false,
        };
        let mut course = course.clone();
        std::iter::once(first)
            .chain(std::iter::from_fn(|| course.take()))
            .collect()
    }

    const EDITS: [[(f64, f64); 2]; 8] = [
        [(1e-3, 20.0), (2e-3, 20.0)],
        [(2e-3, 20.0), (1e-5, 20.0)],
        [(1e-3, 20.0), (1e-3, 5.0)],
        [(1e-3, 5.0), (1e-3, 20.0)],
        [(1e-3, 10.0), (1e-5, 100.0)],
        [(0.0, 20.0), (1e-3, 30.0)],
        [(1e-3, 20.0), (0.0, 30.0)],
        [(1e-3, 20.0), (1e-3, 1e3)],
    ];

    #[test]
    fn place_and_velocity_go_on_and_no_acceleration_is_greater_than_both() {
        for [old, new] in EDITS {
            let (old, new) = (plate(old.0, old.1), plate(new.0, new.1));
            let mut course = Course::default();
            course.lead(old, new, 0.123).expect("another motion");
            let motions = motions(old, &course);
            let size = old.amplitude.max(new.amplitude);
            let speed = (old.amplitude * old.omega).max(new.amplitude * new.omega);
            for pair in motions.windows(2) {
                let [before, after] = pair else { continue };
                let was = before.plate.later(after.time - before.time);
                assert!((was.position() - after.plate.position()).abs() < 1e-13 * size);
                // 2⁻⁵³ of a phase of some hundred.
                assert!((was.velocity() - after.plate.velocity()).abs() < 1e-12 * speed);
                assert!(after.plate.shake() <= old.shake().max(new.shake()) * (1.0 + 1e-15));
                let jump = was.acceleration() - after.plate.acceleration();
                if old.amplitude > 0.0 && new.amplitude > 0.0 {
                    assert!(jump.abs() < 1e-12 * speed * old.omega.max(new.omega));
                } else if jump.abs() > 1e-9 {
                    assert_eq!(
                        after.plate.acceleration().max(was.acceleration()),
                        jump.abs()
                    );
                }
            }
            let last = motions.last().expect("a course").plate;
            assert_eq!((last.amplitude, last.omega), (new.amplitude, new.omega));
            assert_eq!(last.centre, 0.0);
        }
    }

    #[test]
    fn an_edit_of_the_amplitude_leaves_the_phase_alone() {
        for (old, new) in [(1e-3, 2e-3), (2e-3, 1e-5), (0.0, 1e-3), (1e-3, 0.0)] {
            let (old, new) = (plate(old, 20.0), plate(new, 20.0));
            let mut course = Course::default();
            let start = course.lead(old, new, 0.123).expect("another motion");
            assert!((0.123..=0.123 + 0.05).contains(&start));
            let motions = motions(old, &course);
            let last = motions.last().expect("a course");
            assert!((last.time - start - 0.05).abs() < 1e-15, "in one period");
            let phase = new.later(last.time).phase;
            assert!((phase - last.plate.phase).abs() < 1e-12);
        }
    }

    #[test]
    fn the_last_edit_counts_and_what_has_begun_is_ended() {
        let motions = [1.0, 2.0, 3.0].map(|amplitude| plate(amplitude, 1.0));
        let [one, two, three] = motions;
        let mut course = Course::default();
        assert_eq!(course.lead(one, two, 0.1), Some(0.5));
        // Taken back before it began.
        assert_eq!(course.lead(one, one, 0.2), None);
        assert!(course.is_untouched());
        course.lead(one, two, 0.3);
        assert_eq!(course.lead(one, three, 0.4), Some(0.5));
        assert_eq!(course.ahead.len(), 5);
        // On the way, and in another column that lags behind.
        let mut ahead = course.clone();
        let rising = ahead.take().expect("it begins").plate;
        for (course, now) in [(&mut course, one), (&mut ahead, rising)] {
            let start = course.lead(now, one, 0.6).expect("another motion");
            assert!((start - 2.0).abs() < 1e-15);
            assert_eq!(
                course.ahead.back().map(|turn| turn.plate.amplitude),
                Some(1.0)
            );
        }
        course.take();
        assert_eq!(course, ahead);
    }
}
