//! Many runs side by side.

use super::{FigureError, Pains};
use crate::study::{Tell, sweep};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// Where a figure's runs are done, and who is told how far they are.
pub(super) struct RunPool<'a, 'b> {
    what: &'static str,
    pains: Pains,
    tell: &'a mut Tell<'b>,
}

impl<'a, 'b> RunPool<'a, 'b> {
    /// The pool of a figure that is called so.
    pub fn new(what: &'static str, pains: Pains, tell: &'a mut Tell<'b>) -> Self {
        Self { what, pains, tell }
    }

    /// One of two things, by the pains that are taken.
    pub fn pick<T>(&self, quick: T, full: T) -> T {
        if self.pains.quick { quick } else { full }
    }

    /// Does the work on every item, on all threads; the results in the items' order.
    ///
    /// The error is that of the first item that has one, however many threads there are.
    pub fn each<I: Sync, T: Send>(
        &mut self,
        items: &[I],
        work: impl Fn(&I) -> Result<T, FigureError> + Sync,
    ) -> Result<Vec<T>, FigureError> {
        let mut results = Vec::with_capacity(items.len());
        // Runs of a figure are of all lengths: their number is no part of the time.
        let all = items.len();
        let mut count =
            |done: usize| (self.tell)(&format!("{done} of {all} runs, {}", self.what), None);
        count(0);
        let mut failed = None;
        sweep::run(
            0..items.len(),
            self.pains.threads,
            &AtomicBool::new(false),
            |row| Some(work(&items[row])),
            |row, result| {
                count(row + 1);
                match result {
                    Ok(result) => results.push(result),
                    Err(error) => {
                        failed = Some(error);
                        return ControlFlow::Break(());
                    }
                }
                ControlFlow::Continue(())
            },
        );
        failed.map_or(Ok(results), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::parameters;

    fn pool(threads: usize, items: &[u64]) -> Result<Vec<u64>, FigureError> {
        let pains = Pains {
            quick: true,
            threads,
        };
        RunPool::new("test", pains, &mut |_, _| {}).each(items, |&item| match item {
            13 | 17 => Err(FigureError::Scene(
                parameters::named(&format!("no{item}")).expect_err("no such parameter"),
            )),
            item => Ok(item * item),
        })
    }

    #[test]
    fn results_and_errors_do_not_depend_on_threads() {
        let fine: Vec<u64> = (100..150).collect();
        let squares: Vec<u64> = fine.iter().map(|k| k * k).collect();
        let bad: Vec<u64> = (0..50).collect();
        for threads in [1, 2, 7, 100] {
            assert_eq!(pool(threads, &fine), Ok(squares.clone()));
            let error = pool(threads, &bad).expect_err("13 fails");
            assert!(error.to_string().contains("no13"), "{error}");
        }
        assert_eq!(pool(2, &[]), Ok(Vec::new()));
    }
}
