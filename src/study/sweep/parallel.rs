//! Many rows on many threads, handed over in their order.

use std::collections::BTreeMap;
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Calls `measure` for every row on `jobs` threads, and `on_row` on this thread with
/// what it gave, in the order of the rows: each as soon as it and all before it are
/// there.
///
/// Ends early when `stop` is set, when `measure` gives nothing, or when `on_row`
/// breaks, which sets `stop`. Rows already begun are awaited, so `measure` has to look
/// at `stop` too. Says how many rows were handed over.
pub fn run<R: Send>(
    rows: Range<usize>,
    jobs: usize,
    stop: &AtomicBool,
    measure: impl Fn(usize) -> Option<R> + Sync,
    mut on_row: impl FnMut(usize, R) -> ControlFlow<()>,
) -> usize {
    let next = AtomicUsize::new(rows.start);
    let (sender, receiver) = mpsc::channel();
    let work = |sender: mpsc::Sender<(usize, R)>| {
        while !stop.load(Ordering::Relaxed) {
            let row = next.fetch_add(1, Ordering::Relaxed);
            if row >= rows.end {
                return;
            }
            // Nobody listening, or nothing to tell: the sweep is over.
            let told = measure(row).and_then(|result| sender.send((row, result)).ok());
            if told.is_none() {
                return;
            }
        }
    };
    let mut expected = rows.start;
    thread::scope(|scope| {
        for _ in 0..jobs.clamp(1, rows.len().max(1)) {
            let sender = sender.clone();
            scope.spawn(|| work(sender));
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        for (row, result) in receiver {
            waiting.insert(row, result);
            while let Some(result) = waiting.remove(&expected) {
                if on_row(expected, result).is_break() {
                    stop.store(true, Ordering::Relaxed);
                    return;
                }
                expected += 1;
            }
        }
    });
    expected - rows.start
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_in_order_whatever_finishes_first() {
        // The first row is not done before the fourth is: with four threads, rows wait.
        let fourth = AtomicBool::new(false);
        let mut seen = Vec::new();
        let handed = run(
            3..20,
            4,
            &AtomicBool::new(false),
            |row| {
                if row == 6 {
                    fourth.store(true, Ordering::Release);
                }
                while row == 3 && !fourth.load(Ordering::Acquire) {
                    thread::yield_now();
                }
                Some(row * row)
            },
            |row, square| {
                seen.push((row, square));
                ControlFlow::Continue(())
            },
        );
        assert_eq!(handed, 17);
        assert_eq!(seen, (3..20).map(|k| (k, k * k)).collect::<Vec<_>>());
    }

    #[test]
    fn a_sweep_that_is_stopped_ends_at_a_row() {
        let stop = AtomicBool::new(false);
        let handed = run(0..1000, 2, &stop, Some, |row, _| {
            if row < 5 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        assert_eq!(handed, 5);
        assert!(stop.load(Ordering::Relaxed));
        let none = run(0..9, 2, &stop, Some, |_, _| ControlFlow::Continue(()));
        assert_eq!(none, 0);
    }
}
