//! Where everything stands when a lattice is shown.
//!
//! ```text
//!  header: preset, facts                                    time, speed
//!  ── discs ────────┬── rows over time ───────────────┬─ E ───────────
//!  discs            │ axis  trace                     │ history
//!  discs            │ axis  trace                     ├─ E_r/E ───────
//!  discs            │       time                      │ history
//!  discs            ├─ σ ────────┬─ parameters ───────┴───────────────
//!  discs            │ verdict    │ name   value        keys
//!  scale            │ ε_eff      │ name   value        keys
//!  message
//!  keys
//! ```
//!
//! Discs need height more than anything else does. On tall screens the histories stand
//! below the traces, and the column beside the lattice has a trace too.

use ratatui::layout::Rect;

use super::{AXIS, LatticeShape, Layout, PARAMETERS, Panels, Rows, SIGMA};
use super::{column_width, panel_height};

/// Columns of the discs at 80 columns: thirteen discs of four dots.
const DISCS: u16 = 26;
/// The part of the height that the discs take before they part, the rest being for gaps.
pub const SHARE: f64 = 0.55;
/// Distance of two rows in diameters, √3/2.
pub const ROW: f64 = 0.866;
/// Columns from which on there are panels below the traces.
pub(super) const WITH_PANELS: u16 = DISCS + 1 + SIGMA;
/// Columns from which on there is a trace beside the discs.
const WITH_TRACE: u16 = 40;
/// Columns of the narrowest of two traces.
const TWO_TRACES: u16 = 24;
/// Columns of the histories that stand beside a trace.
const STRIPS: u16 = 17;
/// Rows from which on they stand below it, and how many they have there.
const TALL: u16 = 20;
const LOW_STRIPS: u16 = 8;

/// The layout of a screen for a lattice, of which `rows` are left of `height`, and `layout` has the
/// lines above and below.
pub(super) fn place(
    layout: &mut Layout,
    mut rows: Rows,
    height: u16,
    lattice: LatticeShape,
    sides: usize,
) {
    let width = rows.0.width;
    if height >= 6 {
        layout.upper_rule = rows.top(1);
    }
    let body = rows.0;
    let with_panels = height >= 18 && width >= WITH_PANELS;
    if width < WITH_TRACE {
        layout.discs = body;
        return;
    }
    let discs = discs_width(body, lattice);
    layout.discs = Rect {
        width: discs,
        ..body
    };
    let mut right = Rows(Rect {
        x: body.x + discs + 1,
        width: body.width - discs - 1,
        ..body
    });
    if with_panels {
        let panels = right.bottom(panel_height(height));
        layout.lower_rule = right.bottom(1);
        place_panels(&mut layout.panels, panels);
    }
    let traces = if with_panels {
        place_strips(layout, right)
    } else {
        right
    };
    place_panes(layout, traces, height, sides);
}

/// Columns of the discs: as many as they need when they have their share of the height, if
/// the panels have theirs.
fn discs_width(body: Rect, lattice: LatticeShape) -> u16 {
    let most = (body.width * 2 / 5)
        .min(body.width.saturating_sub(SIGMA + PARAMETERS + 2))
        .max(DISCS.min(body.width / 2));
    let height = 4.0 * f64::from(body.height.saturating_sub(1));
    let diameter = |width: u16| 2.0 * f64::from(width) / lattice.columns as f64;
    let high = SHARE * height / (1.0 + ROW * (lattice.rows as f64 - 1.0));
    let diameter = high.min(diameter(most)).floor().max(1.0);
    let wanted = (0.5 * diameter * lattice.columns as f64).ceil();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between two widths of the screen"
    )]
    let wanted = wanted.clamp(f64::from(DISCS.min(most)), f64::from(most)) as u16;
    wanted
}

fn place_panels(panels: &mut Panels, area: Rect) {
    let spare = area.width.saturating_sub(SIGMA + PARAMETERS);
    let most = PARAMETERS + (spare / 2).min(12);
    let parameters = most.min(area.width.saturating_sub(SIGMA + 1));
    let sigma = area.width - parameters - 1;
    panels.sigma = Rect {
        width: sigma,
        ..area
    };
    // Names and values that are cut are worse than none.
    if parameters + 1 >= PARAMETERS {
        panels.parameters = Rect {
            x: area.x + sigma + 1,
            width: parameters,
            ..area
        };
    } else {
        panels.sigma.width = area.width;
    }
}

/// The histories, and what they leave for the traces.
fn place_strips(layout: &mut Layout, mut right: Rows) -> Rows {
    if right.0.height >= TALL {
        let strips = right.bottom(LOW_STRIPS);
        layout.strips_rule = right.bottom(1);
        let half = strips.width / 2;
        layout.panels.energy = Rect {
            width: half,
            ..strips
        };
        layout.panels.relative = Rect {
            x: strips.x + half + 1,
            width: strips.width - half - 1,
            ..strips
        };
        return right;
    }
    let area = right.0;
    let width = STRIPS + area.width.saturating_sub(53) / 4;
    if area.width < AXIS + TWO_TRACES + 1 + width || area.height < 8 {
        return right;
    }
    let mut strips = Rows(Rect {
        x: area.right() - width,
        width,
        ..area
    });
    layout.panels.relative = strips.bottom(area.height / 2);
    layout.strips_rule = strips.bottom(1);
    layout.panels.energy = strips.0;
    Rows(Rect {
        width: area.width - width - 1,
        ..area
    })
}

/// The traces: of the rows, and where there is room of the column beside them.
fn place_panes(layout: &mut Layout, mut rows: Rows, height: u16, sides: usize) {
    let time = if height >= super::LOW {
        rows.bottom(1)
    } else {
        Rect::default()
    };
    let area = rows.0;
    if area.is_empty() || area.width < AXIS + 2 {
        return;
    }
    layout.axis = Rect {
        width: AXIS,
        ..area
    };
    let room = area.width - AXIS;
    let count = if sides > 1 && room > 2 * TWO_TRACES {
        2
    } else {
        1
    };
    let width = (room - (count - 1)) / count;
    for k in 0..count {
        let x = area.x + AXIS + k * (width + 1);
        let pane = Rect { x, width, ..area };
        // The discs are the lattice's column.
        let column = if k == 0 {
            0
        } else {
            column_width(width, area.height)
        };
        layout.place_pane(pane, column, time);
    }
}
