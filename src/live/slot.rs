//! A slot that holds the newest frame only.

use crossbeam_channel::{Receiver, Sender, TrySendError, bounded};

use super::Frame;

/// The end of the slot that frames go into.
#[derive(Debug)]
pub(super) struct Outlet {
    sender: Sender<Frame>,
    evict: Receiver<Frame>,
}

/// An empty slot.
pub(super) fn slot() -> (Outlet, Receiver<Frame>) {
    let (sender, receiver) = bounded(1);
    (
        Outlet {
            sender,
            evict: receiver.clone(),
        },
        receiver,
    )
}

impl Outlet {
    /// Puts `frame` into the slot. A frame that nobody fetched makes room, and its
    /// samples and notes go on in the new one.
    pub(super) fn publish(&self, mut frame: Frame) {
        loop {
            match self.sender.try_send(frame) {
                Ok(()) | Err(TrySendError::Disconnected(_)) => return,
                Err(TrySendError::Full(back)) => {
                    frame = match self.evict.try_recv() {
                        Ok(stale) => merge(stale, back),
                        // Fetched in this very moment.
                        Err(_) => back,
                    };
                }
            }
        }
    }
}

/// Sentences that wait for a screen that does not fetch them.
const NOTES: usize = 8;

/// The newer frame, with what the stale one still had to tell.
fn merge(stale: Frame, mut newer: Frame) -> Frame {
    if stale.generation == newer.generation {
        // A whole page needs nothing of what was before it.
        if !newer.whole {
            newer.whole = stale.whole;
            let fresh = std::mem::replace(&mut newer.history, stale.history);
            newer.history.set_capacity(fresh.capacity());
            newer.history.append(fresh);
        }
        let untold = stale.notes.into_iter();
        let untold: Vec<String> = untold.filter(|note| !newer.notes.contains(note)).collect();
        newer.notes.splice(0..0, untold);
        let surplus = newer.notes.len().saturating_sub(NOTES);
        newer.notes.drain(..surplus);
    }
    newer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::live::{History, Sample};

    fn frame(generation: u64, time: f64) -> Frame {
        let mut history = History::new(4);
        history.push(Sample {
            time,
            rows: Vec::new(),
        });
        Frame {
            generation,
            time,
            sides: Vec::new(),
            scenes: Vec::new(),
            end: time,
            recorded: None,
            history,
            whole: false,
            towards: None,
            notes: vec![format!("{time}")],
            paused: false,
            held: false,
            orders: 0,
            achieved: None,
        }
    }

    #[test]
    fn the_newest_frame_wins_and_keeps_the_samples_of_the_evicted() {
        let (outlet, receiver) = slot();
        for k in 0..10 {
            outlet.publish(frame(1, f64::from(k)));
        }
        let got = receiver.try_recv().expect("a frame waits");
        assert!(got.time > 8.5);
        let times: Vec<f64> = got.history.iter().map(|s| s.time).collect();
        assert_eq!(times, [6.0, 7.0, 8.0, 9.0]);
        assert_eq!(got.notes.len(), NOTES);
        assert!(receiver.try_recv().is_err());
    }

    #[test]
    fn a_frame_of_another_start_leaves_nothing_behind() {
        let (outlet, receiver) = slot();
        outlet.publish(frame(1, 5.0));
        outlet.publish(frame(2, 0.0));
        let got = receiver.try_recv().expect("a frame waits");
        assert_eq!(
            (got.generation, got.history.len(), got.notes.len()),
            (2, 1, 1)
        );
    }
}
