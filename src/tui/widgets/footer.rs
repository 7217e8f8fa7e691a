//! The last lines: a message, and the keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::accuracy;
use super::text::{columns, fitted, line, wrapped};
use crate::tui::keys::{BINDINGS, Hint};
use crate::tui::layout::Layout;
use crate::tui::model::{Model, Notice};

/// Looks at the numbers, five a second, for which a line of a longer text stays.
const LOOKS_A_LINE: u64 = 25;

/// Draws the line of the moment: a message, a hint, or, where they stand nowhere else,
/// what there is to say of the columns and what to look for.
pub fn render_message(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    let (theme, area) = (model.theme, layout.message);
    let notice = model.notices().first().copied();
    let notice = notice.filter(|_| layout.notices.is_empty());
    // A warning is worth more than the repetition of an edit.
    let warned = matches!(notice, Some(Notice::TooFewSteps { .. }));
    let message = model.message.as_ref();
    let message = message.filter(|message| !(message.echo && warned));
    let mut start = line(theme, buffer, area, 0);
    start.skip(1);
    let room = start.room().saturating_sub(1);
    match (message, notice) {
        (Some(message), _) => {
            let style = if message.alarm {
                theme.alarm()
            } else {
                theme.strong()
            };
            start.put(&fitted(&theme.text(&message.text), room), style);
        }
        _ if model.held => {
            let what = if model.is_over() {
                "the collision is over"
            } else {
                "the page is full"
            };
            start.put(
                &format!("{what}: r restarts, space goes on"),
                theme.strong(),
            );
        }
        (None, Some(notice)) => accuracy::render_notice(model, notice, area, 0, buffer),
        _ if !layout.text.is_empty() => {}
        _ => {
            // Line after line where all of it has no room.
            let text = format!("look for: {}", model.preset.look_for);
            let lines = wrapped(&theme.text(&text), room);
            let turn = usize::try_from(model.numbers.looks / LOOKS_A_LINE).unwrap_or(0);
            if let Some(line) = lines.get(turn % lines.len().max(1)) {
                start.put(line, theme.quiet());
            }
        }
    }
}

/// Draws the keys, as many as there is room for.
pub fn render_keys(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = model.theme;
    let hints = fitting(area.width);
    let mut line = line(theme, buffer, area, 0);
    for hint in hints {
        line.put(" ", Style::new())
            .put(hint.keys, theme.strong())
            .put(" ", Style::new());
        line.put(hint.what, theme.quiet()).put(" ", Style::new());
    }
}

/// The hints for a line of that width: the least needed are left out.
fn fitting(width: u16) -> Vec<Hint> {
    let mut hints: Vec<Hint> = BINDINGS.iter().filter_map(|binding| binding.hint).collect();
    let wide = |hints: &[Hint]| {
        hints
            .iter()
            .map(|hint| columns(hint.keys) + columns(hint.what) + 3)
            .sum::<u16>()
    };
    while wide(&hints) > width {
        let Some(least) = hints
            .iter()
            .map(|hint| hint.rank)
            .max()
            .filter(|_| hints.len() > 1)
        else {
            break;
        };
        hints.retain(|hint| hint.rank < least);
    }
    hints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_and_quit_stay_to_the_last() {
        let keys = |width| {
            fitting(width)
                .iter()
                .map(|hint| hint.keys)
                .collect::<Vec<_>>()
        };
        assert!(keys(80).contains(&"space") && keys(80).contains(&"p") && keys(80).contains(&"m"));
        assert_eq!(keys(20), ["?", "q"]);
        assert!(keys(200).len() >= 11);
    }
}
