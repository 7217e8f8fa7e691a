//! The first line: what is simulated; simulated time and speed.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::verdict;
use crate::scene::LawName;
use crate::scene::parameters::{Parameter, Value, display, display_ascii, find};
use crate::tui::layout::Layout;
use crate::tui::model::{Model, speed_text};
use crate::tui::numbers;
use crate::tui::text::{columns, fitted, line};

/// What tells one scene from another, the most important first.
const FACTS: [&str; 9] = [
    "n",
    "rows",
    "law",
    "restitution",
    "contact_time",
    "frequency",
    "alpha",
    "s0",
    "v0",
];
/// Speeds that differ by less are the same.
const SAME: f64 = 0.1;

/// Draws the line, with the verdict if that stands nowhere else.
pub fn render(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    let (theme, area) = (model.theme, layout.header);
    let name = &model.preset.name;
    let told = layout.verdict.is_empty() && layout.panels.sigma.is_empty();
    let verdict = verdict::word(model).filter(|_| told);
    let (verdict, alarm) = verdict.map_or((String::new(), Style::new()), |(word, style)| {
        (format!("  {word}"), style)
    });
    // The name and the verdict come before the speed, and that before the time.
    let taken = 1 + columns(name) + columns(&verdict);
    let clocks = [clock(model), time(model)].map(|clock| format!("  {clock} "));
    let fits = |clock: &&String| taken + columns(&theme.text(clock)) <= area.width;
    let clock = clocks.iter().find(fits).map_or("", String::as_str);
    let room = area.width.saturating_sub(columns(&theme.text(clock)));
    let left = Rect {
        width: room,
        ..area
    };
    let room = room.saturating_sub(columns(name) + 1 + columns(&verdict));
    let (facts, taken) = facts(model, room);
    let spare = room.saturating_sub(taken);
    // The program's name and the title give way to what is simulated.
    let (program, spare) = if spare >= 9 {
        (" beadlab  ", spare - 9)
    } else {
        (" ", spare)
    };
    let title = match spare {
        24.. => format!("  {}", fitted(&model.preset.title, spare - 3)),
        _ => String::new(),
    };
    line(theme, buffer, left, 0)
        .put(program, theme.quiet())
        .put(name, theme.strong())
        .put(&verdict, alarm)
        .put(&title, Style::new())
        .put(&facts, Style::new());
    line(theme, buffer, area, 0).right(clock, theme.strong());
}

/// As many facts as fit, and the columns they take.
fn facts(model: &Model, room: u16) -> (String, u16) {
    let sigma = model.bench.scenes()[0]
        .sigma0()
        .map(|s| format!("  σ_0 {}", numbers::short(s)));
    let mut all: Vec<String> = FACTS
        .iter()
        .filter_map(|name| fact(model, find(name)?))
        .collect();
    all.splice(
        all.len().saturating_sub(1)..all.len().saturating_sub(1),
        sigma,
    );
    let (mut text, mut taken) = (String::new(), 0);
    for fact in all {
        let width = columns(&model.theme.text(&fact));
        if taken + width <= room {
            text += &fact;
            taken += width;
        }
    }
    (text, taken)
}

fn fact(model: &Model, parameter: &Parameter) -> Option<String> {
    let value = model.bench.value(parameter)?;
    if parameter.name == "law" {
        let special = matches!(value, Value::Choice(law) if law != LawName::Hooke.as_str());
        return special.then(|| format!("  {}", display(parameter, value)));
    }
    if let ("alpha", Value::Number(alpha)) = (parameter.name, value) {
        return Some(format!("  α {}", numbers::short(alpha)));
    }
    Some(match (model.theme.ascii, parameter.name) {
        // The unit says it all.
        (_, "frequency") => format!("  {}", display(parameter, value)),
        (true, _) => format!(
            "  {} {}",
            parameter.symbol_ascii,
            display_ascii(parameter, value)
        ),
        (false, _) => format!("  {} {}", parameter.symbol, display(parameter, value)),
    })
}

/// Simulated time.
fn time(model: &Model) -> String {
    let time = numbers::clock(model.numbers.time, model.page.sweep.span);
    format!("t {time}")
}

/// Simulated time, and how fast it goes.
fn clock(model: &Model) -> String {
    let rec = model.theme.symbol("● rec  ", "* rec  ");
    let rec = if model.recorded.is_some() { rec } else { "" };
    let time = format!("{rec}{}", time(model));
    let asked = speed_text(model.speed.factor());
    let glyph = |unicode, ascii| model.theme.symbol(unicode, ascii);
    if model.held {
        let what = if model.is_over() { "over" } else { "page full" };
        return format!("{time}  {} {what}", glyph("■", "#"));
    }
    if model.is_back() {
        let (sign, what) = if model.paused {
            (glyph("‖", "="), "back")
        } else {
            (glyph("▶", ">"), "again")
        };
        return format!("{time}  {sign} {what}, {asked}");
    }
    if model.paused {
        return format!("{time}  {} paused, {asked}", glyph("‖", "="));
    }
    let play = glyph("▶", ">");
    match model.numbers.achieved {
        Some(got) if (got / model.speed.factor() - 1.0).abs() > SAME => {
            format!("{time}  {play} {asked} asked, {} reached", speed_text(got))
        }
        _ => format!("{time}  {play} {asked} real time"),
    }
}
