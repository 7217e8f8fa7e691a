//! When the next frame may be drawn: smoothly on a fast link however long, and on a slow one
//! without a queue of old frames between the program and the eye.
//!
//! A terminal's receipts tell when it has read a frame. The time that one takes beyond the
//! shortest way there and back was spent in queues. While that is short more frames may be
//! on their way at once, up to all that a long link holds; when it grows, fewer, down to a
//! single one. No rate need be known, and no queue between here and the terminal, such as the
//! megabyte that sshd takes at once, can hide the eye's end of the link.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use super::outbox::Outbox;

/// The shortest time between two frames.
const FRAME: Duration = Duration::from_millis(25);
/// A receipt may take this much longer than the shortest way there and back, or a quarter of
/// it, before frames are taken to wait for each other. Ordinary links differ by less from frame
/// to frame.
const QUEUED: Duration = Duration::from_millis(60);

/// When a receipt shows a queue.
fn is_queued(took: Duration, way: Duration) -> bool {
    took > way + QUEUED.max(way / 4)
}

/// Bytes in flight at most: frames for a way of a second.
const MOST: f64 = 300_000.0;
/// A shortest way that was last met so long ago may no longer be one.
const STALE: Duration = Duration::from_secs(20);
/// A receipt is lost that takes so long. The first frame of a large screen takes many
/// seconds on the slowest links.
const LOST: Duration = Duration::from_secs(12);
/// The first question has nothing before it.
const FIRST: Duration = Duration::from_secs(2);
/// So many lost receipts in turn are a terminal that gives none.
const LOST_IN_TURN: u32 = 2;
/// A terminal that gives no receipts gets this much, bytes per second: all links bear it.
const CAREFUL: f64 = 900.0;

/// What a terminal has been heard to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Receipts {
    /// Nothing yet.
    Expected,
    /// It gives them.
    Given,
    /// It does not.
    Missing,
}

/// The link to the eye.
#[derive(Debug)]
pub struct Link {
    outbox: Outbox,
    /// Bytes told of.
    told: u64,
    receipts: Receipts,
    /// When the frames in flight were sent, and their bytes, the oldest first.
    in_flight: VecDeque<(Instant, f64)>,
    /// So many bytes may be in flight before another frame. One alone always may.
    window: f64,
    /// The shortest way there and back, and when it was last as short.
    way: Option<(Duration, Instant)>,
    lost: u32,
    /// Somebody waits for an answer: one more may be.
    hurried: bool,
    /// The screen's shortest time between two frames; on a careful link, when the last one
    /// will have passed.
    next: Instant,
}

impl Link {
    /// The link that an outbox leads to.
    pub fn new(outbox: Outbox, now: Instant) -> Link {
        let mut link = Link {
            outbox,
            told: 0,
            receipts: Receipts::Expected,
            in_flight: VecDeque::new(),
            window: 0.0,
            way: None,
            lost: 0,
            // The first picture need not wait for the way to be measured.
            hurried: true,
            next: now,
        };
        link.ask(now);
        link
    }

    /// When the next frame may be drawn, if nothing is heard before.
    pub fn next(&self, now: Instant) -> Instant {
        match self.in_flight.front() {
            Some((oldest, _)) if self.is_full(now) => *oldest + self.patience(),
            // Without receipts the nearest queue must at least have taken all.
            _ if self.receipts == Receipts::Missing && !self.outbox.is_written() => {
                self.next.max(now + FRAME)
            }
            _ => self.next,
        }
    }

    /// Whether the next frame would wait behind those in flight.
    fn is_full(&self, now: Instant) -> bool {
        let Some((oldest, _)) = self.in_flight.front() else {
            return false;
        };
        let late = |(way, _)| is_queued(now.duration_since(*oldest), way);
        let full = self.bytes_in_flight() >= self.window || self.way.is_some_and(late);
        let excused = self.hurried && self.in_flight.len() == 1;
        self.receipts != Receipts::Missing && full && !excused
    }

    fn bytes_in_flight(&self) -> f64 {
        self.in_flight.iter().map(|(_, bytes)| bytes).sum()
    }

    /// How long the oldest receipt is waited for.
    fn patience(&self) -> Duration {
        if self.receipts == Receipts::Expected {
            FIRST
        } else {
            LOST
        }
    }

    /// Somebody waits for an answer: the next frame goes although the last may still be on
    /// its way.
    pub fn hurry(&mut self) {
        self.hurried = true;
    }

    /// How many receipts are to come, as far as one can tell.
    pub fn owed(&self) -> usize {
        if self.receipts == Receipts::Missing {
            0
        } else {
            self.in_flight.len()
        }
    }

    /// How long those may take.
    pub fn longest_wait(&self) -> Duration {
        const LONGEST: Duration = Duration::from_secs(2);
        self.way
            .map_or(QUEUED, |(way, _)| 2 * way + 4 * QUEUED)
            .min(LONGEST)
    }

    /// Nothing is known of the terminal any more: it may be another one.
    pub fn forget(&mut self, now: Instant) {
        *self = Link {
            told: self.told,
            ..Link::new(self.outbox.clone(), now)
        };
    }

    /// A frame was drawn, which may have changed nothing.
    pub fn drawn(&mut self, now: Instant) {
        let sent = self.outbox.sent();
        let bytes = (sent - std::mem::replace(&mut self.told, sent)) as f64;
        self.next = now + FRAME;
        if bytes == 0.0 {
            return;
        }
        self.give_up_lost(now);
        self.hurried = false;
        self.in_flight.push_back((now, bytes));
        if self.receipts == Receipts::Missing {
            self.next = now + Duration::from_secs_f64(bytes / CAREFUL).max(FRAME);
            // Should a receipt come after all, it is that of the last.
            self.in_flight.drain(..self.in_flight.len() - 1);
        }
    }

    /// Counts receipts that will not come.
    fn give_up_lost(&mut self, now: Instant) {
        let patience = self.patience();
        let is_late = |(sent, _): &(Instant, f64)| now.duration_since(*sent) >= patience;
        if self.in_flight.front().is_some_and(is_late) {
            self.in_flight.clear();
            self.window = 0.0;
            self.lost += 1;
            if self.receipts == Receipts::Expected || self.lost >= LOST_IN_TURN {
                self.receipts = Receipts::Missing;
            }
        }
    }

    /// The terminal has read what the oldest question came after.
    pub fn receipt(&mut self, now: Instant) {
        self.receipts = Receipts::Given;
        self.lost = 0;
        let in_flight = self.bytes_in_flight();
        let Some((sent, bytes)) = self.in_flight.pop_front() else {
            return;
        };
        let took = now.duration_since(sent);
        match self.way {
            Some((shortest, _)) if is_queued(took, shortest) => self.window /= 2.0,
            Some((shortest, _)) => {
                self.way = Some((shortest.min(took), now));
                // A window that is not used proves nothing.
                if 2.0 * in_flight >= self.window {
                    self.window = (self.window + bytes).min(MOST);
                }
            }
            None => self.way = Some((took, now)),
        }
        self.measure_again(now);
    }

    /// Frames that always take longer than the way may be on a way that has become longer:
    /// a question without a frame tells.
    fn measure_again(&mut self, now: Instant) {
        let is_old = |(_, when): &(Duration, Instant)| now.duration_since(*when) > STALE;
        if self.in_flight.is_empty() && self.way.as_ref().is_some_and(is_old) {
            self.way = None;
            self.ask(now);
        }
    }

    fn ask(&mut self, now: Instant) {
        self.outbox.ask();
        self.told = self.outbox.sent();
        self.in_flight.push_back((now, 0.0));
    }
}

#[cfg(test)]
mod tests {
    use super::super::outbox::StatusRequest;
    use super::*;
    use std::io::Write;

    const MILLISECOND: Duration = Duration::from_millis(1);

    /// Frames of `bytes` for a minute on a link of `rate` bytes per second whose way there and
    /// back takes `way` ms; `answers` or not. Frames per second over the last half, and the
    /// longest that one took from being drawn to being read, beyond half the way and its own
    /// passage.
    fn load(rate: f64, way: u32, bytes: usize, answers: bool) -> (f64, f64) {
        let start = Instant::now();
        let (outbox, sent) = Outbox::new(StatusRequest::Plain);
        let mut screen = outbox.clone();
        let mut link = Link::new(outbox, start);
        let seconds = |time: Instant| time.duration_since(start).as_secs_f64();
        // When the line is free, and when receipts come back.
        let (mut free, mut back) = (0.0_f64, VecDeque::new());
        let (mut frames, mut longest) = (0, 0.0_f64);
        let mut now = start;
        while seconds(now) < 60.0 {
            while back.front().is_some_and(|when| *when <= seconds(now)) {
                back.pop_front();
                link.receipt(now);
            }
            if link.next(now) <= now {
                screen.write_all(&vec![0; bytes]).expect("memory takes it");
                screen.flush().expect("memory takes it");
                link.drawn(now);
                if seconds(now) > 30.0 {
                    frames += 1;
                }
            }
            for frame in sent.try_iter() {
                let passage = frame.len() as f64 / rate;
                screen.wrote(frame.len());
                let waits = (free - seconds(now)).max(0.0);
                free = seconds(now) + waits + passage;
                if seconds(now) > 30.0 {
                    longest = longest.max(waits);
                }
                if answers {
                    back.push_back(free + 1e-3 * f64::from(way));
                }
            }
            now += MILLISECOND;
        }
        (f64::from(frames) / 30.0, longest)
    }

    /// However long it is, a fast link gets every frame.
    #[test]
    fn a_fast_link_is_filled() {
        for way in [0, 1, 30, 300, 800] {
            let (rate, queue) = load(1e6, way, 1_000, true);
            assert!(rate > 36.0, "{rate} frames per second at {way} ms");
            assert!(queue < 0.01, "{queue} s in the queue at {way} ms");
        }
    }

    /// The next frame never waits for more than a part of the last.
    #[test]
    fn a_slow_link_is_used_and_has_no_queue() {
        for (rate, way, bytes) in [
            (2_000.0, 300, 600),
            (1_200.0, 600, 600),
            (9_600.0, 100, 800),
        ] {
            let passage = bytes as f64 / rate;
            let (frames, queue) = load(rate, way, bytes, true);
            let alone = 1.0 / (passage + 1e-3 * f64::from(way));
            assert!(frames > 0.8 * alone, "{frames} frames per second at {rate}");
            assert!(
                queue < 0.1 + 0.5 * passage,
                "{queue} s in the queue at {rate}"
            );
        }
    }

    /// Frames that become ten times larger find no room for as many of them as before.
    #[test]
    fn what_small_frames_have_proved_does_not_count_for_large_ones() {
        let now = Instant::now();
        let (outbox, _sent) = Outbox::new(StatusRequest::Plain);
        let mut screen = outbox.clone();
        let mut link = Link::new(outbox, now);
        let mut time = now;
        link.receipt(time);
        for _ in 0..200 {
            time += FRAME;
            screen.write_all(&[0; 60]).expect("memory takes it");
            screen.flush().expect("memory takes it");
            link.drawn(time);
            link.receipt(time + MILLISECOND);
        }
        assert!(link.window < 1_000.0, "{} bytes", link.window);
    }

    #[test]
    fn a_silent_terminal_gets_what_any_link_bears() {
        let (frames, _) = load(1e6, 0, 600, false);
        assert!((1.0..1.6).contains(&frames), "{frames} frames per second");
        let (frames, queue) = load(1_200.0, 600, 600, false);
        assert!(frames > 1.0 && queue < 0.1, "{frames} {queue}");
    }

    #[test]
    fn a_key_may_overtake_one_frame_and_no_more() {
        let now = Instant::now();
        let (outbox, _sent) = Outbox::new(StatusRequest::Plain);
        let mut screen = outbox.clone();
        let mut link = Link::new(outbox, now);
        let mut draw = |link: &mut Link, when| {
            screen.write_all(&[0; 600]).expect("memory takes it");
            screen.flush().expect("memory takes it");
            link.drawn(when);
        };
        link.receipt(now + MILLISECOND);
        let later = now + 2 * FRAME;
        draw(&mut link, later);
        let at = later + FRAME;
        assert!(link.next(at) > at);
        link.hurry();
        assert!(link.next(at) <= at);
        draw(&mut link, at);
        link.hurry();
        let at = at + FRAME;
        assert!(link.next(at) > at, "keys that repeat are not queued");
    }
}
