//! σ, the verdict on soft contacts, and ε_eff of the last bounce.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::details;
use super::text::{columns, line, wrapped};
use crate::scene::Law;
use crate::study::verdict::Word;
use crate::tui::model::Model;
use crate::tui::numbers;
use crate::tui::theme::Theme;

/// Lines for why there is no verdict.
const WHY: usize = 2;

fn style(word: Word, theme: Theme) -> Style {
    match word {
        Word::Detachment => theme.alarm(),
        Word::Crossover => theme.strong(),
        Word::Agreement => theme.good(),
    }
}

/// The verdict, and the numbers that decide it or why there is none.
fn verdict(model: &Model, width: u16) -> Vec<Pieces> {
    let theme = model.theme;
    let Some(verdict) = model.verdict() else {
        return vec![vec![(" no verdict yet".to_owned(), theme.quiet())]];
    };
    let mut lines: Vec<Pieces> = Vec::new();
    if let Some(word) = verdict.word {
        lines.push(vec![(format!(" {}", word.as_str()), style(word, theme))]);
    }
    match (verdict.word, verdict.decisive) {
        (Some(_), Some(seen)) => lines.push(vec![
            (format!(" {} ", seen.symbol), Style::new()),
            (numbers::short(seen.soft), theme.side(0)),
            ("/".to_owned(), Style::new()),
            (numbers::short(seen.hard), theme.side(1)),
        ]),
        (Some(_), None) => lines.push(vec![(" by σ alone".to_owned(), theme.quiet())]),
        (None, _) => {
            let why = wrapped(&verdict.because, width.saturating_sub(1));
            let why = why.into_iter().take(WHY);
            lines.extend(why.map(|words| vec![(format!(" {words}"), theme.quiet())]));
        }
    }
    lines
}

/// A line of the panel, piece by piece.
type Pieces = Vec<(String, Style)>;

/// Draws the panel: σ of the landings, the verdict, each ε_eff, and what else there is
/// room for.
pub fn render(model: &Model, area: Rect, buffer: &mut Buffer) {
    let mut row = 0;
    for pieces in lines(model, area.width) {
        let mut line = line(model.theme, buffer, area, row);
        for (text, style) in pieces {
            // Pieces are words of a known length, or numbers.
            line.number(&text, style);
        }
        row += 1;
    }
    let rest = Rect {
        y: area.y + row.min(area.height),
        height: area.height.saturating_sub(row),
        ..area
    };
    details::render(model, rest, buffer);
}

fn lines(model: &Model, width: u16) -> Vec<Pieces> {
    let theme = model.theme;
    let quantity = |side: Option<usize>, name: &str, value: Option<f64>| -> Pieces {
        let label = side.map(|index| (model.label(index).to_owned(), theme.side(index)));
        let value = value.map_or_else(|| "-".to_owned(), numbers::short);
        label
            .into_iter()
            .chain([(name.to_owned(), Style::new()), (value, theme.strong())])
            .collect()
    };
    let first = model.numbers.sides.first();
    let landing = first.and_then(|side| model.landing(side));
    let densest = first.and_then(|side| model.densest(side));
    let scene = &model.bench.scenes()[0];
    let nominal = scene.sigma0();
    let means: Vec<Option<f64>> = model
        .numbers
        .sides
        .iter()
        .map(|side| model.sigma(side))
        .collect();
    let mut lines: Vec<Pieces> = Vec::new();
    match (landing, nominal) {
        (Some(_), _) => lines.push(quantity(None, "σ landing ", landing)),
        (None, Some(_)) => lines.push(quantity(None, "σ_0 ", nominal)),
        (None, None) => {}
    }
    if scene.period().is_some() && landing.is_some_and(f64::is_finite) {
        lines.push(quantity(None, " lowest ", densest));
    }
    lines.extend(verdict(model, width));
    for (index, side) in model.numbers.sides.iter().enumerate() {
        lines.push(quantity(Some(index), " ε_eff ", side.seen.bounce));
    }
    // By the t_c of MD, also of the flights of ED.
    let mut last = vec![("mean σ".to_owned(), Style::new())];
    for (index, mean) in means.into_iter().enumerate() {
        last.push((if index == 0 { " " } else { "/" }.to_owned(), Style::new()));
        let mean = mean.map_or_else(|| "-".to_owned(), numbers::short);
        last.push((mean, theme.side(index)));
    }
    lines.push(last);
    // Under a power law t_c depends on the speed: say which one σ is taken with.
    if let (Some(Law::Power(_)), Some(contact_time)) = (scene.law(), scene.contact_time()) {
        let speed = numbers::short(scene.own_speed());
        let time = numbers::with_unit(contact_time, "s");
        let mut words = format!(" t_c {time} at {speed} m/s");
        if columns(&words) > width {
            words = format!(" t_c {time}");
        }
        lines.push(vec![(words, theme.quiet())]);
    }
    lines
}
