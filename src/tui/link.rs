//! When the next frame may be drawn: smoothly on a fast link, and on a slow one
//! without a queue of old frames between the program and the eye.
//!
//! A terminal never says how many bytes wait for it; a write only blocks when
//! the queue is full, and that may be ten seconds' worth. Some queues let the
//! writer go on as soon as there is room, others when they are empty. So the rate
//! is the lower one of what passed since the last full queue and what passed
//! lately, and the queue is reckoned from what was written since.

use std::collections::VecDeque;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The shortest time between two frames.
const FRAME: Duration = Duration::from_millis(33);
/// Two writes in turn that take longer have waited for the link; one alone may be the
/// machine doing something else.
const BLOCKED: Duration = Duration::from_millis(50);
/// A single write that takes longer has.
const STUCK: Duration = Duration::from_millis(500);
/// The part of a slow link's rate that is used.
const SHARE: f64 = 0.8;
/// A slow link may have this much of the future in its queue, s.
const AHEAD: f64 = 0.25;
/// No link is taken to be slower than this, bytes per second.
const SLOWEST: f64 = 300.0;
/// A link that bears this much is not slow, bytes per second.
const FAST: f64 = 50_000.0;
/// How fast a slow link is trusted with more while nothing blocks, per second.
const TRUST: f64 = 0.002;
/// Queues that were full longer apart say nothing about the rate.
const CYCLE: Duration = Duration::from_secs(10);
/// What was written in this time passed lately.
const LATELY: Duration = Duration::from_secs(20);
/// Frames are never further apart.
const LONGEST: Duration = Duration::from_secs(10);
/// What was written longer ago has long been read.
const MEMORY: Duration = Duration::from_secs(60);

/// A writer that counts its bytes.
#[derive(Debug)]
pub struct Metered<W> {
    writer: W,
    bytes: Arc<AtomicU64>,
}

impl<W: Write> Write for Metered<W> {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        let written = self.writer.write(buffer)?;
        self.bytes.fetch_add(written as u64, Ordering::Relaxed);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// The link to the eye.
#[derive(Debug)]
pub struct Link {
    bytes: Arc<AtomicU64>,
    told: u64,
    took: Duration,
    written: VecDeque<(Instant, f64)>,
    /// When a write last found the queue full, and the bytes written until then.
    full: Option<(Instant, f64)>,
    /// Bytes per second of a slow link; none for a fast one.
    rate: Option<f64>,
    soonest: Instant,
    next: Instant,
}

impl Link {
    /// A link taken to be fast, and its byte-counting writer.
    pub fn new<W: Write>(writer: W, now: Instant) -> (Link, Metered<W>) {
        let bytes = Arc::new(AtomicU64::new(0));
        let link = Link {
            bytes: Arc::clone(&bytes),
            told: 0,
            took: Duration::ZERO,
            written: VecDeque::new(),
            full: None,
            rate: None,
            soonest: now,
            next: now,
        };
        (link, Metered { writer, bytes })
    }

    /// When the next frame may be drawn.
    pub fn next(&self) -> Instant {
        self.next
    }

    /// Somebody waits for an answer: the next frame is drawn as soon as may be.
    pub fn hurry(&mut self) {
        self.next = self.next.min(self.soonest);
    }

    /// Takes the link to be fast again, until it proves slow.
    pub fn forget(&mut self) {
        self.rate = None;
        self.full = None;
        self.written.clear();
    }

    /// A frame was drawn from `start` to `end`.
    pub fn drawn(&mut self, start: Instant, end: Instant) {
        let total = self.bytes.load(Ordering::Relaxed);
        let bytes = (total - std::mem::replace(&mut self.told, total)) as f64;
        if bytes > 0.0 {
            self.judge(bytes, end.duration_since(start), end);
        }
        (self.soonest, self.next) = (end + FRAME, end + FRAME);
        if let Some(rate) = self.rate {
            let drained = (self.queued(rate, end) / rate - AHEAD).max(0.0);
            let delay = |seconds: f64| end + Duration::from_secs_f64(seconds).clamp(FRAME, LONGEST);
            self.soonest = delay(bytes / rate);
            self.next = delay(drained.max(bytes / (SHARE * rate)));
        }
    }

    /// Learns from a write of so many bytes that took so long.
    fn judge(&mut self, bytes: f64, took: Duration, end: Instant) {
        let since = self
            .written
            .back()
            .map_or(Duration::ZERO, |(last, _)| end.duration_since(*last));
        self.written.push_back((end, bytes));
        while self
            .written
            .front()
            .is_some_and(|(when, _)| end.duration_since(*when) > MEMORY)
        {
            self.written.pop_front();
        }
        let before = std::mem::replace(&mut self.took, took);
        if took > STUCK || took.min(before) > BLOCKED {
            let lately = self.passed_lately(end);
            let cycle = self.passed_since_full(end);
            let rate = cycle.map_or(lately, |cycle| cycle.min(lately)).max(SLOWEST);
            self.rate = Some(rate).filter(|rate| *rate < FAST);
        } else {
            let trusted = |rate: f64| rate * (1.0 + TRUST * since.as_secs_f64());
            self.rate = self.rate.map(trusted).filter(|rate| *rate < FAST);
        }
    }

    /// Bytes per second over the last while, for a queue that is empty now.
    fn passed_lately(&self, end: Instant) -> f64 {
        let recent = self
            .written
            .iter()
            .skip_while(|(when, _)| end.duration_since(*when) > LATELY);
        let start = recent.clone().next().map_or(end, |(when, _)| *when);
        let bytes: f64 = recent.map(|(_, bytes)| bytes).sum();
        bytes
            / end
                .duration_since(start)
                .as_secs_f64()
                .max(BLOCKED.as_secs_f64())
    }

    /// Bytes per second since the queue was last found full, for one that is full now.
    fn passed_since_full(&mut self, end: Instant) -> Option<f64> {
        let total = self.told as f64;
        let (when, before) = self.full.replace((end, total))?;
        let since = end.duration_since(when);
        (since < CYCLE).then(|| (total - before) / since.as_secs_f64())
    }

    /// Bytes that wait in the queue of a link of that rate.
    fn queued(&self, rate: f64, now: Instant) -> f64 {
        let (mut queue, mut last) = (0.0f64, None::<Instant>);
        for &(when, bytes) in &self.written {
            let passed = last.map_or(0.0, |last| when.duration_since(last).as_secs_f64());
            queue = (queue - rate * passed).max(0.0) + bytes;
            last = Some(when);
        }
        let passed = last.map_or(0.0, |last| now.duration_since(last).as_secs_f64());
        (queue - rate * passed).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of 300 bytes on a link of `rate` whose queue has room for `room` bytes
    /// and, when full, lets the writer go on at a level of `low`: bytes per second
    /// over a minute, and the longest queue of its second half.
    fn load(rate: f64, room: f64, low: f64) -> (f64, f64) {
        let start = Instant::now();
        let mut now = start;
        let (mut link, mut writer) = Link::new(io::sink(), now);
        let (mut queued, mut longest, mut total) = (0.0f64, 0.0f64, 0.0);
        while now.duration_since(start) < Duration::from_secs(60) {
            let idle = link.next().saturating_duration_since(now);
            now += idle;
            queued = (queued - rate * idle.as_secs_f64()).max(0.0);
            writer
                .write_all(&[0; 300])
                .expect("a sink takes everything");
            queued += 300.0;
            let surplus = if queued > room { queued - low } else { 0.0 };
            let wait = Duration::from_secs_f64(surplus / rate);
            queued -= surplus;
            link.drawn(now, now + wait);
            now += wait;
            total += 300.0;
            if now.duration_since(start) > Duration::from_secs(30) {
                longest = longest.max(queued);
            }
        }
        (total / 60.0, longest)
    }

    #[test]
    fn a_fast_link_gets_every_frame() {
        assert!(load(1e7, 4096.0, 4096.0).0 > 8_000.0);
    }

    #[test]
    fn a_slow_link_is_used_and_its_queue_runs_empty() {
        for (room, low) in [(12_288.0, 12_288.0), (32_768.0, 0.0)] {
            let (used, queue) = load(2_000.0, room, low);
            assert!(
                (1_000.0..2_300.0).contains(&used),
                "{used} of 2000 bytes per second"
            );
            assert!(queue < 2_000.0, "{queue} bytes wait");
        }
    }

    #[test]
    fn a_hiccup_costs_little() {
        let mut now = Instant::now();
        let (mut link, mut writer) = Link::new(io::sink(), now);
        for k in 0..600 {
            writer
                .write_all(&[0; 300])
                .expect("a sink takes everything");
            let took = Duration::from_secs(if k == 500 { 3 } else { 0 });
            link.drawn(now, now + took);
            now = link.next();
        }
        writer
            .write_all(&[0; 300])
            .expect("a sink takes everything");
        link.drawn(now, now);
        assert!(link.next() - now < 2 * FRAME);
        link.forget();
        link.drawn(now, now);
        assert_eq!(link.next(), now + FRAME);
    }
}
