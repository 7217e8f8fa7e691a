//! What takes room on the screen, besides what every screen has.

use super::Model;
use crate::scene::Scene;
use crate::tui::caption::{text_width, texts, turns};
use crate::tui::layout::{Contents, LatticeShape};
use ratatui::layout::Rect;

/// A line about one of the columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Notice {
    /// Its steps are too long for closed contacts.
    TooFewSteps {
        /// Which column.
        side: usize,
        /// The least steps in a contact time.
        least: f64,
    },
    /// Its error against the run in its shadow.
    Error {
        /// Which column.
        side: usize,
    },
}

impl Model {
    /// The lines that the screen has for the present scenes, beside the messages of the
    /// moment: what to beware of, and errors that were asked for.
    pub fn notices(&self) -> Vec<Notice> {
        let sides = 0..self.bench.scenes().len();
        let coarse = sides.filter_map(|side| {
            let least = self.bench.least_steps(side)?;
            Some(Notice::TooFewSteps { side, least })
        });
        let references = self.bench.references().iter().enumerate();
        let errors = references
            .filter(|(_, reference)| self.shadow && reference.is_ok())
            .map(|(side, _)| Notice::Error { side });
        coarse.chain(errors).collect()
    }

    /// What takes room on the screen.
    pub(in crate::tui) fn contents(&self) -> Contents {
        let notices = self.notices();
        let screen = Rect::new(0, 0, self.size.0, self.size.1);
        let turns = turns(
            self.theme,
            &texts(&self.preset),
            text_width(screen),
            u16::MAX,
        );
        let lines: usize = turns.iter().map(|turn| turn.lines.len()).sum();
        Contents {
            notices: u16::try_from(notices.len()).unwrap_or(u16::MAX),
            texts: u16::try_from(lines).unwrap_or(u16::MAX),
            errors: notices.iter().any(|n| matches!(n, Notice::Error { .. })),
            ..contents(self.bench.scenes())
        }
    }
}

/// What these scenes take room for.
pub(super) fn contents(scenes: &[Scene]) -> Contents {
    let sites = scenes.first().and_then(|scene| scene.sites());
    Contents {
        sides: scenes.len(),
        lattice: sites.map(|sites| LatticeShape {
            rows: sites.rows,
            columns: sites.columns,
        }),
        ..Contents::default()
    }
}
