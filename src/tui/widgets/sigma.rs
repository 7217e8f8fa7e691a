//! σ in words, the verdict on soft contacts, and ε_eff of the last bounce.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::details;
use super::verdict::{Pieces, compared, decisive, in_words, relative};
use crate::tui::model::Model;
use crate::tui::numbers;
use crate::tui::text::{columns, line, wrapped};

/// Lines for why there is no verdict.
const WHY: usize = 2;
/// σ below which contacts overlap in time, and above which they are pairs'.
const CROWDED: (f64, f64) = (0.3, 3.0);

/// A line of the panel. Low panels leave out those of the highest rank.
struct RankedLine {
    rank: u8,
    pieces: Pieces,
}

/// Draws the panel: σ and what it compares, the verdict, each ε_eff, and what else there is
/// room for. E_r/E stands here where its history does not stand on the screen.
pub fn render(model: &Model, area: Rect, with_history: bool, buffer: &mut Buffer) {
    if area.is_empty() {
        return;
    }
    let mut row = 0;
    for pieces in shown(lines(model, area.width, with_history), area.height) {
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

/// The most needed lines, as many as there are rows, in their order.
fn shown(lines: Vec<RankedLine>, rows: u16) -> impl Iterator<Item = Pieces> {
    let mut ranks: Vec<u8> = lines.iter().map(|line| line.rank).collect();
    ranks.sort_unstable();
    let last = ranks.get(usize::from(rows.max(1)) - 1).copied();
    let needed = move |line: &RankedLine| last.is_none_or(|last| line.rank <= last);
    lines.into_iter().filter(needed).map(|line| line.pieces)
}

fn lines(model: &Model, width: u16, with_history: bool) -> Vec<RankedLine> {
    let theme = model.theme;
    let mut lines: Vec<RankedLine> = Vec::new();
    let mut say = |rank: u8, pieces: Pieces| lines.push(RankedLine { rank, pieces });
    // The longest of some words that has room.
    let fitting = |words: &[&str], taken: &str| -> String {
        let room = width.saturating_sub(columns(&theme.text(taken)));
        let fits = |word: &&&str| columns(&theme.text(word)) <= room;
        words
            .iter()
            .find(fits)
            .map_or(String::new(), |word| (*word).to_owned())
    };
    let scene = &model.bench.scenes()[0];
    let side = model.numbers.sides.first();
    let landing = side.and_then(|side| model.landing(side));
    let densest = side.and_then(|side| model.densest(side));
    let densest = densest.filter(|_| scene.period().is_some());
    let (value, of): (_, &[&str]) = match (densest.or(landing), scene.sigma0()) {
        (Some(_), _) if densest.is_some() => (
            densest,
            &[", lowest of ten periods", ", lowest lately", ", lowest"],
        ),
        (Some(landing), _) => (Some(landing), &[" at this landing", ", landing"]),
        (None, Some(start)) => (Some(start), &[" at the start", ", start"]),
        (None, None) => (None, &[" no landing yet", " -"]),
    };
    let number = value.map_or(String::new(), |value| format!(" {}", numbers::short(value)));
    let of = fitting(of, &format!("σ{number}"));
    say(
        2,
        vec![
            ("σ".to_owned(), Style::new()),
            (number, theme.strong()),
            (of, theme.quiet()),
        ],
    );
    let what = ["= free flight / contact time t_c", "= free flight / t_c"];
    say(5, vec![(fitting(&what, ""), theme.quiet())]);
    if let Some(value) = value {
        say(4, vec![(fitting(told(value), ""), theme.quiet())]);
    }
    // Under a power law t_c depends on the speed: say which one σ is taken with.
    if let Some(contact_time) = scene.contact_time().filter(|_| scene.depends_on_speed()) {
        let speed = numbers::short(scene.own_speed());
        let time = numbers::with_unit(contact_time, "s");
        let words = [format!("t_c {time} at {speed} m/s"), format!("t_c {time}")];
        say(
            6,
            vec![(fitting(&[&words[0], &words[1]], ""), theme.quiet())],
        );
    }
    match in_words(model) {
        Ok(words) => say(0, vec![words]),
        Err(why) => {
            let why = wrapped(&theme.text(&why), width).into_iter().take(WHY);
            why.for_each(|words| say(0, vec![(words, theme.quiet())]));
        }
    }
    let now = relative(model, width).filter(|_| !with_history);
    for pieces in decisive(model, width).into_iter().chain(now) {
        say(1, pieces);
    }
    let each = |value: fn(&Model, &crate::live::Side) -> Option<f64>| -> Vec<(&str, String)> {
        let sides = model.numbers.sides.iter().enumerate();
        sides
            .map(|(index, side)| {
                let value = value(model, side).map_or_else(|| "-".to_owned(), numbers::short);
                (model.label(index), value)
            })
            .collect()
    };
    let bounces = each(|_, side| side.seen.bounce);
    say(3, compared(theme, &["ε_eff".to_owned()], &bounces, width));
    if let (Some(_), Some(landing)) = (densest, landing) {
        let number = numbers::short(landing);
        let words = fitting(&["last landing σ ", "landing σ ", "σ "], &number);
        say(7, vec![(words, Style::new()), (number, theme.strong())]);
    }
    // By the t_c of MD, also of the flights of ED.
    let names = ["mean flight / t_c".to_owned(), "mean σ".to_owned()];
    say(8, compared(theme, &names, &each(Model::sigma), width));
    lines
}

/// What such a σ means, longest first.
fn told(sigma: f64) -> &'static [&'static str] {
    match sigma {
        _ if sigma == f64::INFINITY => &["contacts take no time"],
        _ if sigma < CROWDED.0 => &[
            "< 1: contacts overlap, little is lost",
            "< 1: contacts overlap",
            "contacts overlap",
        ],
        _ if sigma <= CROWDED.1 => &["near 1: contacts begin to overlap", "near 1: some overlap"],
        _ => &["> 1: one contact after another", "> 1: pairs collide"],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_panels_keep_the_most_needed_lines_in_their_order() {
        let line = |rank| RankedLine {
            rank,
            pieces: vec![(rank.to_string(), Style::new())],
        };
        let kept = |rows| -> String {
            let lines = [2, 5, 4, 0, 1, 3].map(line).into();
            shown(lines, rows)
                .map(|pieces| pieces[0].0.clone())
                .collect()
        };
        assert_eq!(kept(1), "0");
        assert_eq!(kept(3), "201");
        assert_eq!(kept(9), "254013");
    }
}
