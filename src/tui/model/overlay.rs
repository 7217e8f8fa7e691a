//! What lies over the main screen: the list of presets, the help, a prompt.

use super::Prompt;
use crate::scene::Preset;
use crate::scene::preset::embedded;

/// What lies over the main screen.
#[derive(Debug)]
pub enum Overlay {
    /// Nothing.
    None,
    /// The help, scrolled down by so many lines.
    Help(u16),
    /// The list of presets.
    Presets(Menu),
    /// A line to type into.
    Prompt(Prompt),
}

/// The list of presets.
#[derive(Debug)]
pub struct Menu {
    /// All embedded presets.
    pub presets: Vec<Preset>,
    /// The selected one.
    pub selected: usize,
}

impl Menu {
    /// All embedded presets, with the one of that name selected.
    pub fn open(name: &str) -> Menu {
        let presets: Vec<Preset> = embedded()
            .iter()
            .filter_map(|(name, _)| Preset::load(name).ok())
            .collect();
        let selected = presets
            .iter()
            .position(|preset| preset.name == name)
            .unwrap_or(0);
        Menu { presets, selected }
    }

    /// Selects the one so many further down, or up if negative.
    pub fn select(&mut self, rows: i32) {
        self.selected = moved(self.selected, rows, self.presets.len());
    }
}

/// An index moved by `by`, staying below `count`.
pub(in crate::tui) fn moved(index: usize, by: i32, count: usize) -> usize {
    let step = usize::try_from(by.unsigned_abs()).unwrap_or(usize::MAX);
    let to = if by < 0 {
        index.saturating_sub(step)
    } else {
        index.saturating_add(step)
    };
    to.min(count.saturating_sub(1))
}
