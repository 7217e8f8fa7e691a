//! The prompt: a line to type into, and what there is to say of it above.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Span;
use ratatui::widgets::{Clear, Widget};

use crate::tui::layout::Layout;
use crate::tui::model::{Model, Note, Prompt};
use crate::tui::text::{columns, line, wrapped};

/// A line of fewer columns has no label.
const NARROWEST: u16 = 12;

/// Draws the prompt where messages stand, or where there is a line at all.
pub fn render(model: &Model, prompt: &Prompt, layout: &Layout, buffer: &mut Buffer) {
    let screen = buffer.area;
    let last = Rect {
        y: screen.bottom().saturating_sub(1),
        height: screen.height.min(1),
        ..screen
    };
    let messages = layout.message;
    let message = Rect {
        y: messages.bottom().saturating_sub(1),
        height: messages.height.min(1),
        ..messages
    };
    let places = [message, layout.keys];
    let place = places.into_iter().find(|place| !place.is_empty());
    let place = place.unwrap_or(last);
    Clear.render(place, buffer);
    ask(model, prompt, place, buffer);
    if let Some(note) = &prompt.note {
        tell(model, note, place, buffer);
    }
}

fn ask(model: &Model, prompt: &Prompt, area: Rect, buffer: &mut Buffer) {
    let theme = model.theme;
    let mut line = line(theme, buffer, area, 0);
    line.skip(1);
    let (what, how) = match prompt.parameter {
        Some(parameter) => (
            format!("{} = ", parameter.name),
            format!("  {}", parameter.allowed()),
        ),
        None => (
            "set ".to_owned(),
            "  name=value, such as t_c=4.6us".to_owned(),
        ),
    };
    if columns(&what) + NARROWEST <= line.room() {
        line.put(&what, theme.strong());
    }
    let (before, at, after) = window(model, prompt, line.room());
    line.put(before, Style::new())
        .put(at, theme.selected())
        .put(after, Style::new());
    let how = if prompt.text().is_empty() {
        how
    } else {
        "  Enter sets, Tab completes, Esc leaves".to_owned()
    };
    if columns(&theme.text(&how)) <= line.room() {
        line.put(&how, theme.quiet());
    }
}

/// What is shown of the text: before, at and after the place where typing goes on. What
/// lies far on the left of it gives way.
fn window<'a>(model: &Model, prompt: &'a Prompt, room: u16) -> (&'a str, &'a str, &'a str) {
    let (before, rest) = prompt.text().split_at(prompt.cursor());
    let (at, after) = rest.split_at(rest.chars().next().map_or(0, char::len_utf8));
    let at = if at.is_empty() { " " } else { at };
    let wide = |text: &str| Span::raw(model.theme.text(text)).width();
    let room = usize::from(room).saturating_sub(wide(at));
    let start = before
        .char_indices()
        .map(|(start, _)| start)
        .find(|&start| wide(&before[start..]) <= room);
    (&before[start.unwrap_or(before.len())..], at, after)
}

/// Writes a note into as many rows above the prompt as it needs.
fn tell(model: &Model, note: &Note, prompt: Rect, buffer: &mut Buffer) {
    let theme = model.theme;
    let lines = wrapped(&theme.text(&note.text), prompt.width.saturating_sub(2));
    let height = u16::try_from(lines.len()).unwrap_or(u16::MAX).min(prompt.y);
    let above = Rect {
        y: prompt.y - height,
        height,
        ..prompt
    };
    Clear.render(above, buffer);
    let style = if note.alarm {
        theme.alarm()
    } else {
        theme.strong()
    };
    for (row, text) in (0..height).zip(lines) {
        line(theme, buffer, above, row).skip(1).put(&text, style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Preset;
    use crate::tui::model::Place;
    use crate::tui::theme::Theme;

    #[test]
    fn the_place_of_typing_is_always_seen() {
        let preset = Preset::load("shaken").expect("an embedded preset");
        for ascii in [false, true] {
            let theme = Theme {
                ascii,
                colour: false,
            };
            let (model, _) = Model::new(preset.clone(), None, theme, (80, 24)).expect("a twin");
            let mut prompt = Prompt::new(None);
            "ε=0.81 and 漢字 and something long"
                .chars()
                .for_each(|c| prompt.insert(c));
            for room in 0..50u16 {
                prompt.go(Place::End);
                while prompt.cursor() > 0 {
                    let (before, at, after) = window(&model, &prompt, room);
                    let shown = format!("{before}{at}{after}");
                    assert!(prompt.text().ends_with(shown.trim_end()));
                    let wide = |text: &str| Span::raw(theme.text(text)).width();
                    let both = wide(before) + wide(at);
                    assert!(both <= usize::from(room).max(wide(at)), "{room}: {shown}");
                    prompt.go(Place::Left);
                }
                assert_eq!(window(&model, &prompt, room).0, "");
            }
        }
    }
}
