//! σ with its regime in words, and ε_eff of the last bounce.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::details;
use super::text::line;
use crate::scene::Law;
use crate::tui::model::Model;
use crate::tui::numbers;
use crate::tui::theme::Theme;

/// What σ says about soft contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// σ ≪ 1.
    Detachment,
    /// σ about 1.
    Crossover,
    /// σ ≫ 1.
    Agreement,
    /// No contact time.
    Hard,
    /// No flight yet.
    Unknown,
}

impl Regime {
    /// The regime of a σ: the lowest of the last landings, since one dense landing is
    /// enough; the mean over a plate period is ruled by a few long flights.
    pub fn of(sigma: Option<f64>) -> Regime {
        match sigma {
            None => Regime::Unknown,
            Some(sigma) if sigma.is_infinite() => Regime::Hard,
            Some(sigma) if sigma < 0.3 => Regime::Detachment,
            Some(sigma) if sigma <= 3.0 => Regime::Crossover,
            Some(_) => Regime::Agreement,
        }
    }

    /// In words, on two lines.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Regime::Detachment => ["detachment: MD", "not to be trusted"],
            Regime::Crossover => ["crossover: MD and ED", "begin to differ"],
            Regime::Agreement => ["MD and ED agree", ""],
            Regime::Hard => ["hard spheres: no", "contact time"],
            Regime::Unknown => ["no landing yet", ""],
        }
    }

    fn style(self, theme: Theme) -> Style {
        match self {
            Regime::Detachment => theme.alarm(),
            Regime::Crossover => theme.strong(),
            Regime::Agreement => theme.good(),
            Regime::Hard | Regime::Unknown => theme.quiet(),
        }
    }
}

/// A line of the panel, piece by piece.
type Pieces = Vec<(String, Style)>;

/// Draws the panel: the regime and the σ that it follows from, each ε_eff, and
/// what else there is room for.
pub fn render(model: &Model, area: Rect, buffer: &mut Buffer) {
    let mut row = 0;
    for pieces in lines(model) {
        let mut line = line(model.theme, buffer, area, row);
        for (text, style) in pieces {
            line.put(&text, style);
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

fn lines(model: &Model) -> Vec<Pieces> {
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
    // A single ball has no separations, only flights.
    let alone = means.first().copied().flatten().filter(|_| scene.n == 1);
    let regime = Regime::of(densest.or(nominal).or(alone));
    let mut lines: Vec<Pieces> = Vec::new();
    match (landing, nominal) {
        (Some(_), _) => lines.push(quantity(None, "σ landing ", landing)),
        (None, Some(_)) => lines.push(quantity(None, "σ_0 ", nominal)),
        (None, None) => {}
    }
    if scene.period().is_some() && landing.is_some_and(f64::is_finite) {
        lines.push(quantity(None, " lowest ", densest));
    }
    let words = regime.words().into_iter().filter(|words| !words.is_empty());
    lines.extend(words.map(|words| vec![(format!(" {words}"), regime.style(theme))]));
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
        let words = format!(
            " t_c {} at {speed} m/s",
            numbers::with_unit(contact_time, "s")
        );
        lines.push(vec![(words, theme.quiet())]);
    }
    lines
}
