//! The title of a column: its method, its law where it is not the linear one, and the
//! drift of its ledger.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::scene::{CollisionRule, Integrator, Method, Scene, Solver};
use crate::tui::model::Model;
use crate::tui::numbers::scientific;
use crate::tui::text::{columns, line};

/// What stands behind the method while a ghost stands behind the lines.
const GHOST: &str = "+ ghost ";

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
    let in_full = with_numbers(scene);
    let methods = [in_words(scene), in_full, with_law(in_short(scene), scene)];
    let mut title = line(theme, buffer, inner, 0);
    title
        .skip(2)
        .put(" ", theme.quiet())
        .put(model.label(index), theme.side(index).patch(theme.strong()));
    let room = title.room();
    let wide = |method: &str, drift: &str| columns(&theme.text(method)) + 3 + columns(drift);
    let drifts = drifts.unwrap_or_default();
    let ghost = model.page.shown_ghost().map_or("", |_| GHOST);
    let fitting = |ghost: &str| {
        let room = room.saturating_sub(columns(ghost));
        let each = methods.iter().flat_map(|method| {
            drifts
                .iter()
                .map(move |drift| (method.as_str(), drift.as_str()))
        });
        each.chain([(methods[2].as_str(), "")])
            .find(|(method, drift)| wide(method, drift) <= room)
    };
    let both = fitting(ghost).map(|found| (ghost, found));
    let Some((ghost, (method, drift))) = both.or_else(|| Some(("", fitting("")?))) else {
        return;
    };
    title
        .put(&format!("  {method} {ghost}"), theme.quiet())
        .right(drift, theme.quiet());
}

/// The method and its law with their numbers, in words.
pub(in crate::tui) fn in_words(scene: &Scene) -> String {
    with_law(&with_numbers(scene), scene)
}

/// `Gear, t_c/100`; `adaptive, 1e-10`.
fn with_numbers(scene: &Scene) -> String {
    let name = in_short(scene);
    if let Some(grid) = scene.grid() {
        let steps = (grid.steps_per_contact * 1e6).round() / 1e6;
        return format!("{name}, t_c/{steps}");
    }
    match (scene.tolerance(), scene.method) {
        (Some(tolerance), _) => format!("{name}, {}", power_of_ten(tolerance)),
        (None, Method::Hard(CollisionRule::Tc { .. })) => format!("hard spheres, {name}"),
        (None, _) => name.to_owned(),
    }
}

fn in_short(scene: &Scene) -> &'static str {
    match scene.method {
        Method::Soft(soft) => match soft.solver {
            Solver::Grid(grid) => match grid.integrator {
                Integrator::Gear => "Gear",
                Integrator::Verlet => "Verlet",
            },
            Solver::Exact => "exact",
            Solver::Adaptive { .. } => "adaptive",
        },
        Method::Hard(CollisionRule::Lrv) => "hard spheres",
        Method::Hard(CollisionRule::Tc { .. }) => "rule tc",
    }
}

fn with_law(how: &str, scene: &Scene) -> String {
    match scene.law().and_then(|law| law.name().title()) {
        Some(law) => format!("{how}, {law}"),
        None => how.to_owned(),
    }
}

/// `1e-10`, and `2.5e-10` where it is none.
fn power_of_ten(x: f64) -> String {
    let short = format!("{x:.0e}");
    match short.parse::<f64>() {
        Ok(rounded) if (rounded / x - 1.0).abs() < 1e-9 => short,
        _ => scientific(x),
    }
}
