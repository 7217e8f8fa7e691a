//! The title of a column: its method, its law where it is not the linear one, and the
//! drift of its ledger.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::text::{columns, line};
use crate::scene::{CollisionRule, GridSettings, Integrator, LawName, Method, Soft, Solver};
use crate::tui::model::Model;
use crate::tui::numbers::scientific;

/// Draws the title into the rule above the trace. Where there is no room for all of it
/// the drift loses a digit, then the law goes, which the first line of the screen names
/// too, then the method loses its numbers, then the drift goes, then the method.
pub fn render(model: &Model, index: usize, area: Rect, buffer: &mut Buffer) {
    let (Some(scene), theme) = (model.bench.scenes().get(index), model.theme) else {
        return;
    };
    if area.is_empty() {
        return;
    }
    let inner = Rect {
        width: area.width.saturating_sub(2),
        ..area
    };
    let drifts = model.numbers.sides.get(index).map(|side| {
        let drift = side.seen.energy.drift;
        [scientific(drift), format!("{drift:.0e}")].map(|number| format!(" drift {number} "))
    });
    let in_full = with_numbers(&scene.method);
    let methods = [
        with_law(in_full.clone(), &scene.method),
        in_full,
        in_short(&scene.method),
    ];
    let mut title = line(theme, buffer, inner, 0);
    title
        .skip(2)
        .put(" ", theme.quiet())
        .put(model.label(index), theme.side(index).patch(theme.strong()));
    let room = title.room();
    let wide = |method: &str, drift: &str| columns(&theme.text(method)) + 3 + columns(drift);
    let drifts = drifts.unwrap_or_default();
    let fitting = methods
        .iter()
        .flat_map(|method| {
            drifts
                .iter()
                .map(move |drift| (method.as_str(), drift.as_str()))
        })
        .chain([(methods[2].as_str(), "")])
        .find(|(method, drift)| wide(method, drift) <= room);
    let Some((method, drift)) = fitting else {
        return;
    };
    title
        .put(&format!("  {method} "), theme.quiet())
        .right(drift, theme.quiet());
}

/// `Gear, t_c/100`; `adaptive, 1e-10`.
fn with_numbers(method: &Method) -> String {
    match method {
        Method::Soft(Soft {
            solver: Solver::Exact,
            ..
        }) => "exact".to_owned(),
        Method::Soft(Soft {
            solver: Solver::Adaptive { tolerance },
            ..
        }) => format!("adaptive, {}", power_of_ten(*tolerance)),
        Method::Soft(Soft {
            solver:
                Solver::Grid(GridSettings {
                    integrator,
                    steps_per_contact,
                }),
            ..
        }) => {
            let steps = (steps_per_contact * 1e6).round() / 1e6;
            format!("{}, t_c/{steps}", integrator_name(*integrator))
        }
        Method::Hard(CollisionRule::Lrv) => "hard spheres".to_owned(),
        Method::Hard(CollisionRule::Tc { .. }) => "hard spheres, rule tc".to_owned(),
    }
}

fn in_short(method: &Method) -> String {
    let how = match method {
        Method::Soft(Soft {
            solver: Solver::Exact,
            ..
        }) => "exact",
        Method::Soft(Soft {
            solver: Solver::Adaptive { .. },
            ..
        }) => "adaptive",
        Method::Soft(Soft {
            solver: Solver::Grid(GridSettings { integrator, .. }),
            ..
        }) => integrator_name(*integrator),
        Method::Hard(CollisionRule::Lrv) => "hard spheres",
        Method::Hard(CollisionRule::Tc { .. }) => "rule tc",
    };
    with_law(how.to_owned(), method)
}

fn integrator_name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::Gear => "Gear",
        Integrator::Verlet => "Verlet",
    }
}

fn with_law(how: String, method: &Method) -> String {
    let Method::Soft(Soft { law, .. }) = method else {
        return how;
    };
    let law = match law.name() {
        LawName::Hooke => return how,
        LawName::Hertz => "Hertz",
        LawName::HertzKuwabaraKono => "Hertz-KK",
        LawName::Taguchi => "Taguchi",
        LawName::Power => "power law",
    };
    format!("{how}, {law}")
}

/// `1e-10`, and `2.5e-10` where it is none.
fn power_of_ten(x: f64) -> String {
    let short = format!("{x:.0e}");
    match short.parse::<f64>() {
        Ok(rounded) if (rounded / x - 1.0).abs() < 1e-9 => short,
        _ => scientific(x),
    }
}
