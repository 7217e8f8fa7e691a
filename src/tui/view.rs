//! The model as a picture.

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::layout::{Layout, layout};
use super::model::{Model, Overlay};
use super::text::fitted;
use super::widgets::beads::Beads;
use super::widgets::discs::LatticePicture;
use super::widgets::strip::Graphed;
use super::widgets::trace::Trace;
use super::widgets::{
    accuracy, axis, footer, header, help, menu, parameters, prompt, rules, sigma, strip, time,
    title, verdict,
};
use crate::live::Status;

/// Draws the model.
pub fn view(model: &Model, frame: &mut Frame) {
    let area = frame.area();
    let layout = layout((area.width, area.height), model.contents());
    let buffer = frame.buffer_mut();
    let above_keys = Rect {
        height: area.height.saturating_sub(layout.keys.height),
        ..area
    };
    match &model.overlay {
        Overlay::Help(scrolled) => help::render(model, *scrolled, above_keys, buffer),
        Overlay::Presets(menu) => menu::render(model, menu, above_keys, buffer),
        Overlay::None | Overlay::Prompt(_) => {
            header::render(model, &layout, buffer);
            draw_rules(model, &layout, buffer);
            draw_discs(model, &layout, buffer);
            draw_panes(model, &layout, buffer);
            draw_panels(model, &layout, buffer);
            verdict::render_row(model, layout.verdict, buffer);
            accuracy::render_notices(model, layout.notices, buffer);
            footer::render_message(model, &layout, buffer);
        }
    }
    footer::render_keys(model, layout.keys, buffer);
    if let Overlay::Prompt(prompt) = &model.overlay {
        prompt::render(model, prompt, &layout, buffer);
    }
    if model.theme.ascii {
        keep_ascii(buffer);
    }
}

fn draw_rules(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    let theme = model.theme;
    let across = [layout.upper_rule, layout.lower_rule, layout.strips_rule];
    for rule in across.into_iter().filter(|rule| !rule.is_empty()) {
        rules::horizontal(theme, rule, buffer);
    }
    let discs = layout.discs;
    if !layout.panes.is_empty() && !discs.is_empty() {
        rules::vertical(theme, discs.right(), discs.y..discs.bottom(), buffer);
    }
    let panels = [
        layout.panels.energy,
        layout.panels.relative,
        layout.panels.errors,
        layout.panels.sigma,
        layout.panels.parameters,
    ];
    for panel in panels
        .into_iter()
        .filter(|panel| !panel.is_empty() && panel.x > 0)
    {
        rules::vertical(theme, panel.x - 1, panel.y..panel.bottom(), buffer);
    }
    if let Some(second) = layout.panes.get(1) {
        let bottom = second.trace.bottom() + second.time.height;
        rules::vertical(theme, second.trace.x - 1, second.trace.y..bottom, buffer);
    }
    for rule in across.into_iter().filter(|rule| rule.x > 0) {
        rules::branch(theme, rule.x - 1, rule.y, buffer);
    }
}

/// The discs of a lattice, where the left scene is one.
fn draw_discs(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    let (area, scene) = (layout.discs, &model.bench.scenes()[0]);
    let (Some(sites), Some(side)) = (scene.sites(), model.column.sides.first()) else {
        return;
    };
    if area.is_empty() {
        return;
    }
    let above = Rect {
        width: area.width,
        ..layout.upper_rule
    };
    let title = format!("{} discs", sites.count());
    rules::title(model.theme, &title, above, buffer);
    LatticePicture {
        side,
        sites,
        scale: &model.page.scale,
        // Where there are no traces it is said here.
        tells_failure: layout.panes.is_empty(),
        theme: model.theme,
    }
    .render(area, buffer);
}

fn draw_panes(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    axis::render(model.theme, model.page.trace_scale(), layout.axis, buffer);
    for (index, pane) in layout.panes.iter().enumerate() {
        let Some(scene) = model.bench.scenes().get(index) else {
            continue;
        };
        title::render(model, index, pane.title, buffer);
        time::render(model, pane.trace, pane.time, buffer);
        let seen = model.column.sides.get(index);
        let failure = seen.and_then(|side| match &side.status {
            Status::Failed(why) => Some(why.as_str()),
            Status::Running | Status::Over => None,
        });
        Trace {
            page: &model.page,
            side: index,
            failure,
            theme: model.theme,
        }
        .render(pane.trace, buffer);
        if let Some(side) = seen {
            let below = Rect {
                y: pane.column.bottom(),
                ..pane.time
            };
            let (scale, theme) = (&model.page.scale, model.theme);
            Beads {
                side,
                index,
                scale,
                diameter: scene.diameter,
                deep: model.page.lens.is_some().then_some(side.seen.deepest),
                theme,
            }
            .render(pane.column, below, buffer);
        }
    }
}

fn draw_panels(model: &Model, layout: &Layout, buffer: &mut Buffer) {
    let panels = &layout.panels;
    strip::render(model, Graphed::Kinetic, panels.energy, buffer);
    strip::render(model, Graphed::Relative, panels.relative, buffer);
    accuracy::render_history(model, panels.errors, buffer);
    for (panel, title) in [(panels.sigma, "σ"), (panels.parameters, "parameters")] {
        if !panel.is_empty() {
            let above = Rect {
                y: panel.y.saturating_sub(1),
                height: 1,
                ..panel
            };
            rules::title(model.theme, title, above, buffer);
        }
    }
    let with_history = !panels.relative.is_empty();
    sigma::render(model, panels.sigma, with_history, buffer);
    parameters::render(model, panels.parameters, buffer);
    if !layout.text.is_empty() {
        let rule = Rect {
            height: 1,
            ..layout.text
        };
        rules::horizontal(model.theme, rule, buffer);
        let title = format!("{}: {}", model.preset.name, model.preset.title);
        rules::title(
            model.theme,
            &fitted(&title, rule.width.saturating_sub(6)),
            rule,
            buffer,
        );
        let inner = Rect {
            y: rule.bottom(),
            height: layout.text.height - 1,
            ..layout.text
        };
        menu::render_texts(model, &model.preset, inner, buffer);
    }
}

/// No byte beyond ASCII reaches a terminal that cannot show it.
fn keep_ascii(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        if !cell.symbol().is_ascii() {
            cell.set_symbol("?");
        }
    }
}
