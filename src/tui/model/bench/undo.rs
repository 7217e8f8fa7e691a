//! Edits taken back and made again, by keys and by going back in time.

use super::{Bench, Change};
use crate::scene::Scene;

impl Bench {
    /// Shows scenes that were in force at another time. What was edited before then can be
    /// undone, and what was edited later made again.
    pub fn show(&mut self, scenes: &[Scene]) {
        if self.scenes == scenes || scenes.is_empty() {
            return;
        }
        let present = std::mem::replace(&mut self.scenes, scenes.to_vec());
        let is_it = |edit: &Vec<Scene>| edit == scenes;
        if let Some(found) = self.undo.iter().rposition(is_it) {
            self.redo.push(present);
            self.redo.extend(self.undo.drain(found + 1..).rev());
            self.undo.pop();
        } else if let Some(found) = self.redo.iter().rposition(is_it) {
            self.undo.push(present);
            self.undo.extend(self.redo.drain(found + 1..).rev());
            self.redo.pop();
        } else {
            self.forget_edits();
        }
        self.settle();
    }

    /// Takes the last edit back, if there is one.
    pub fn undo(&mut self) -> Option<Change> {
        let before = self.undo.pop()?;
        let change = self.change_to(&before);
        self.redo.push(std::mem::replace(&mut self.scenes, before));
        self.settle();
        Some(change)
    }

    /// Makes the edit again that was taken back last, if there is one.
    pub fn redo(&mut self) -> Option<Change> {
        let again = self.redo.pop()?;
        let change = self.change_to(&again);
        self.undo.push(std::mem::replace(&mut self.scenes, again));
        self.settle();
        Some(change)
    }
}
