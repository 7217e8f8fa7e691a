//! How far the runs of `beadlab run` are: the scene's own, and those that its sensitivity
//! takes.

use crate::commands::progress::Waiting;
use crate::scene::Scene;
use crate::study::{FindingStage, PATTERNS, work_of_sensitivity};
use std::time::{Duration, Instant};

/// Time between two words about it.
const REFRESH: Duration = Duration::from_millis(100);

/// Runs of a scene on their way, one after another.
pub(super) struct Runs {
    waiting: Waiting,
    /// Of every run, s; under gravity it is known.
    duration: Option<f64>,
    /// Of all runs, in runs of the scene.
    work: Vec<f64>,
    /// The run, from 0, and the time that it has come to, s.
    at: usize,
    time: f64,
    due: Instant,
}

impl Runs {
    /// The runs of a scene, with those of its sensitivity or without.
    pub fn new(scene: &Scene, sensitivity: bool, waiting: Waiting) -> Self {
        let patterns = if sensitivity { PATTERNS } else { 0 };
        let mut work = vec![1.0];
        work.extend(work_of_sensitivity(scene, patterns));
        Self {
            waiting,
            // A floor collision ends when it is over.
            duration: scene.duration.filter(|_| scene.gravity.is_some()),
            work,
            at: 0,
            time: 0.0,
            due: Instant::now(),
        }
    }

    /// What the command is at.
    pub fn show(&mut self, stage: FindingStage) {
        match stage {
            FindingStage::Run(time) => self.show_run(time),
            // All of them are done, and this takes as long as it takes.
            FindingStage::Verdict => self
                .waiting
                .show("verdict: the same column of hard spheres", None),
        }
    }

    /// A run has come to `time`, s: the next one, if the last was further.
    fn show_run(&mut self, time: f64) {
        self.at += usize::from(time < self.time);
        self.time = time;
        if Instant::now() < self.due {
            return;
        }
        self.due = Instant::now() + REFRESH;
        let what = match self.at {
            0 => format!("t = {time:.3e} s"),
            k => format!("sensitivity, run {k}, t = {time:.3e} s"),
        };
        let part = self
            .duration
            .and_then(|duration| self.part(time / duration));
        self.waiting.show(&what, part);
    }

    /// Which part of all is done, if this part of the run is; none of one that nobody
    /// has foreseen.
    fn part(&self, of_run: f64) -> Option<f64> {
        let before: f64 = self.work.iter().take(self.at).sum();
        let done = before + self.work.get(self.at)? * of_run;
        Some(done / self.work.iter().sum::<f64>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Preset;

    #[test]
    fn the_part_done_grows_through_all_runs() {
        let scene = Preset::load("fig5b").expect("an embedded preset").scene;
        let mut runs = Runs::new(&scene, true, Waiting::unseen());
        let all = runs.work.len();
        // Four other grids, three patterns of last bits.
        assert_eq!(all, 8);
        let mut last = 0.0;
        for _ in 0..all {
            for part in [0.1, 0.5, 1.0] {
                runs.show_run(part * scene.duration.expect("it is shaken for so long"));
                let part = runs.part(part).expect("all are foreseen");
                assert!(part > last && part <= 1.0 + 1e-12, "{part} after {last}");
                last = part;
            }
        }
        assert!((last - 1.0).abs() < 1e-12);
        runs.show_run(0.0);
        assert_eq!(runs.part(0.0), None);
    }
}
