//! The thread that judges the scenes on the bench, which takes up to some seconds. It
//! rests three times as long as it works, so that the columns on the screen go on.

use std::io;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, unbounded};

use crate::scene::Scene;
use crate::study::verdict::{Verdict, verdict};

/// It works for about so long, and then rests.
const TURN: Duration = Duration::from_millis(4);

/// The ends of its channels that the screen holds. Dropping `scenes` ends the thread.
pub struct Judge {
    /// Scenes to judge; a newer one makes it drop the older.
    pub scenes: Sender<Scene>,
    /// Verdicts, each with its scene.
    pub verdicts: Receiver<(Scene, Verdict)>,
}

/// Starts the thread, which waits for its first scene.
///
/// # Errors
/// When the system refuses the thread.
pub fn spawn() -> io::Result<Judge> {
    let (scenes, inbox) = unbounded();
    let (outlet, verdicts) = unbounded();
    thread::Builder::new()
        .name("judge".into())
        .spawn(move || run(&inbox, &outlet))?;
    Ok(Judge { scenes, verdicts })
}

fn run(inbox: &Receiver<Scene>, outlet: &Sender<(Scene, Verdict)>) {
    while let Ok(scene) = inbox.recv() {
        let scene = inbox.try_iter().last().unwrap_or(scene);
        let mut since = Instant::now();
        let mut watch = |_| {
            if since.elapsed() > TURN {
                thread::sleep(3 * since.elapsed());
                since = Instant::now();
            }
            if inbox.is_empty() {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        let judged = match catch_unwind(AssertUnwindSafe(|| verdict(&scene, &mut watch))) {
            Ok(Ok(judged)) => judged,
            // A newer scene waits.
            Ok(Err(_)) => continue,
            Err(_) => Verdict::none("the engine panicked"),
        };
        if outlet.send((scene, judged)).is_err() {
            return;
        }
    }
}
