//! The verdict on soft contacts: in the σ panel, or where there is none in a row of its own,
//! or in the first line of the screen.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::strip::Graphed;
use crate::study::verdict::Word;
use crate::tui::model::Model;
use crate::tui::numbers::short;
use crate::tui::text::{columns, fitted, line};
use crate::tui::theme::Theme;

/// Texts that stand side by side, each with its style.
pub type Pieces = Vec<(String, Style)>;

/// The symbol by which a verdict names E_r/E.
const RELATIVE: &str = "E_r/E";
/// Columns between what stands side by side in the row.
const APART: u16 = 2;

fn style(word: Word, theme: Theme) -> Style {
    match word {
        Word::Detachment => theme.alarm(),
        Word::Crossover => theme.strong(),
        Word::Agreement => theme.good(),
    }
}

/// What the word says of soft contacts against hard spheres.
fn meaning(word: Word) -> &'static str {
    match word {
        Word::Detachment => "fails",
        Word::Crossover => "strays",
        Word::Agreement => "holds",
    }
}

/// The word, if there is one.
pub fn word(model: &Model) -> Option<(String, Style)> {
    let word = model.verdict()?.word?;
    Some((word.as_str().to_owned(), style(word, model.theme)))
}

/// The word and what it says, or why there is none yet.
pub fn in_words(model: &Model) -> Result<(String, Style), String> {
    let verdict = model.verdict().ok_or("no verdict yet")?;
    let word = verdict.word.ok_or_else(|| verdict.because.clone())?;
    let text = format!("{}: {} {}", word.as_str(), model.label(0), meaning(word));
    Ok((text, style(word, model.theme)))
}

/// The quantity that decides the verdict, of soft contacts and of hard spheres.
pub fn decisive(model: &Model, width: u16) -> Option<Pieces> {
    let verdict = model.verdict()?;
    verdict.word?;
    let theme = model.theme;
    let Some(seen) = verdict.decisive else {
        return Some(vec![("by σ alone".to_owned(), theme.quiet())]);
    };
    let name = if seen.symbol == RELATIVE {
        vec![format!("mean {RELATIVE}"), RELATIVE.to_owned()]
    } else {
        vec![seen.symbol.to_owned()]
    };
    let values = [("MD", short(seen.soft)), ("ED", short(seen.hard))];
    Some(compared(theme, &name, &values, width))
}

/// E_r/E of the columns now, unless the verdict is by it.
pub fn relative(model: &Model, width: u16) -> Option<Pieces> {
    let judged = model.verdict().filter(|verdict| verdict.word.is_some());
    let by = judged.and_then(|verdict| verdict.decisive);
    if by.is_some_and(|seen| seen.symbol == RELATIVE) {
        return None;
    }
    let values: Vec<(&str, String)> = model
        .numbers
        .sides
        .iter()
        .enumerate()
        .map(|(index, side)| {
            let share = Graphed::Relative.now(&side.seen.energy);
            (model.label(index), short(share))
        })
        .collect();
    Some(compared(
        model.theme,
        &[RELATIVE.to_owned()],
        &values,
        width,
    ))
}

/// A quantity of both columns, `E_r/E MD 0.19 ED 0`, by the longest of its names that has
/// room, and else without the names of the columns, `E_r/E 0.19/0`.
pub fn compared(theme: Theme, names: &[String], values: &[(&str, String)], width: u16) -> Pieces {
    let named = |name: &String| {
        let mut pieces = vec![(name.clone(), Style::new())];
        for (index, (label, value)) in values.iter().enumerate() {
            pieces.push((format!(" {label} "), theme.side(index)));
            pieces.push((value.clone(), theme.strong()));
        }
        pieces
    };
    let fits = |pieces: &Pieces| wide(theme, pieces) <= width;
    names.iter().map(named).find(fits).unwrap_or_else(|| {
        let name = names.last().map_or("", String::as_str);
        let mut pieces = vec![(format!("{name} "), Style::new())];
        for (index, (_, value)) in values.iter().enumerate() {
            if index > 0 {
                pieces.push(("/".to_owned(), Style::new()));
            }
            pieces.push((value.clone(), theme.side(index)));
        }
        pieces
    })
}

/// Draws the row of its own: the word and E_r/E, and what decides if there is room.
pub fn render_row(model: &Model, area: Rect, buffer: &mut Buffer) {
    if area.is_empty() {
        return;
    }
    let theme = model.theme;
    let mut row = line(theme, buffer, area, 0);
    row.skip(1);
    let room = row.room();
    let energies = |room| relative(model, room).or_else(|| decisive(model, room));
    let left = |head: &str| room.saturating_sub(columns(&theme.text(head)) + APART);
    // The names of the columns have more to say than what the word means.
    let whole = energies(u16::MAX).map_or(0, |pieces| wide(theme, &pieces));
    let fits = |head: &str| whole <= left(head);
    let (head, style) = match in_words(model) {
        Ok((words, style)) if fits(&words) => (words, style),
        Ok((_, style)) => (word(model).map_or(String::new(), |(word, _)| word), style),
        // Half of the row is kept for E_r/E.
        Err(why) => (fitted(&theme.text(&why), room / 2), theme.quiet()),
    };
    row.put(&head, style);
    let mut put = |pieces: Option<Pieces>, whole: bool| {
        let room = row.room().saturating_sub(APART);
        let pieces = pieces.filter(|pieces| !whole || wide(theme, pieces) <= room);
        for (k, (text, style)) in pieces.into_iter().flatten().enumerate() {
            row.skip(if k == 0 { APART } else { 0 })
                .number(&text, style);
        }
        row.room().saturating_sub(APART)
    };
    let room = put(energies(left(&head)), false);
    // Where E_r/E does not decide it, this does.
    put(
        relative(model, room).and_then(|_| decisive(model, room)),
        true,
    );
}

/// Columns that pieces take.
fn wide(theme: Theme, pieces: &Pieces) -> u16 {
    let texts = pieces.iter().map(|(text, _)| columns(&theme.text(text)));
    texts.sum()
}
