//! The last lines: a message, and the keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::menu::render_turn;
use super::{accuracy, past};
use crate::tui::caption::{CaptionPart, Text, text_width, texts, turns};
use crate::tui::keys::{BINDINGS, Hint};
use crate::tui::layout::Layout;
use crate::tui::model::{Model, Notice};
use crate::tui::text::{columns, fitted, line, wrapped};

/// Draws the lines of the moment: a message, a hint, or, in turns, what to look for, what
/// the signs on the screen mean, what to try next and what is simulated.
pub fn render_message(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    let (theme, area) = (model.theme, layout.message);
    let notice = model.notices().first().copied();
    let notice = notice.filter(|_| layout.notices.is_empty());
    // A warning is worth more than the repetition of an edit.
    let warned = matches!(notice, Some(Notice::TooFewSteps { .. }));
    let message = model.message.as_ref();
    let message = message.filter(|message| !(message.echo && warned));
    match (message, notice) {
        (Some(message), _) => {
            let style = if message.alarm {
                theme.alarm()
            } else {
                theme.strong()
            };
            say(model, &message.text, style, area, buffer);
        }
        _ if model.is_back() => past::render(model, area, buffer),
        _ if model.held => {
            let what = if model.is_over() {
                "the collision is over"
            } else {
                "the page is full"
            };
            let text = format!("{what}: r restarts, space goes on");
            say(model, &text, theme.strong(), area, buffer);
        }
        (None, Some(notice)) => accuracy::render_notice(model, notice, area, 0, buffer),
        _ => {
            let turns = turns(theme, &told(model, layout), text_width(area), area.height);
            if let Some(CaptionPart { label, lines }) = model.reading.due(&turns) {
                render_turn(theme, label, lines, area, 0, buffer);
            }
        }
    }
}

/// Writes a text into the rows of the area, with dots at its end if some is left.
fn say(model: &Model, text: &str, style: Style, area: Rect, buffer: &mut Buffer) {
    let lines = wrapped(&model.theme.text(text), text_width(area));
    let last = usize::from(area.height.saturating_sub(1));
    for (row, text) in (0..area.height).zip(&lines) {
        let rest = lines[usize::from(row)..].join(" ");
        let text = if usize::from(row) == last {
            fitted(&rest, text_width(area))
        } else {
            text.clone()
        };
        line(model.theme, buffer, area, row)
            .skip(1)
            .put(&text, style);
    }
}

/// What is told in turns. Of the preset's texts none, where all of them stand above.
fn told(model: &Model, layout: &Layout) -> Vec<Text> {
    let [caption, look_for, try_next] = texts(&model.preset);
    let legend = Text {
        label: "signs: ",
        sentences: legend(model, layout),
    };
    if layout.text.is_empty() {
        vec![look_for, legend, try_next, caption]
    } else {
        vec![legend]
    }
}

/// What the signs on this screen mean.
fn legend(model: &Model, layout: &Layout) -> String {
    let beads = layout.panes.iter().any(|pane| !pane.column.is_empty());
    let mut sentences = Vec::new();
    if !layout.discs.is_empty() {
        sentences.push("Filled discs touch.");
    }
    if model.page.shown_ghost().is_some() {
        sentences.push("Dim dots are the ghost, the page that g kept.");
    }
    if beads {
        sentences.push("A dot • marks two beads that touch.");
    }
    if beads || !layout.discs.is_empty() {
        sentences.push("Gaps are drawn gap× the scale of beads.");
    }
    if !layout.panels.relative.is_empty() {
        sentences
            .push("E_r/E is the part of the kinetic energy E that beads have against each other.");
    }
    if sentences.is_empty() {
        sentences.push("Each line is a bead, the lowest the plate.");
    }
    sentences.join(" ")
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
