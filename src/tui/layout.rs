//! Where everything stands.
//!
//! ```text
//!  header: preset, facts                                    time, speed
//!  ── title of the left column ─────────┬── title of the right column ──
//!  axis  trace                  column  │ trace                   column
//!  axis  trace                  column  │ trace                   column
//!        time                   scale   │ time                    scale
//!  ── E ───────┬─ E_r/E ──────┬─ σ ─────┴────┬─ parameters ────────────
//!  history     │ history      │ verdict      │ name   value        keys
//!  numbers     │ numbers      │ ε_eff        │ name   value        keys
//!  ── shaken: on tall screens, what is to be seen ──────────────────────
//!  caption, what to look for, what to try next
//!  what to beware of, and errors that were asked for
//!  on screens without the panels: verdict, E_r/E
//!  message
//!  keys
//! ```
//!
//! Small screens lose the panels first, then everything but the traces, then these. What
//! shows a lattice is another picture: see [`plane`].

mod plane;
#[cfg(test)]
mod tests;

use ratatui::layout::Rect;

pub use plane::{ROW, SHARE};

/// Columns of the vertical axis.
const AXIS: u16 = 6;
/// The narrowest trace worth drawing.
const NARROWEST: u16 = 10;
/// Columns of the σ panel and of the parameters at 80 columns.
const SIGMA: u16 = 21;
const PARAMETERS: u16 = 32;
/// Columns that three histories need.
const THREE_STRIPS: u16 = 38;
/// Rows from which on lines about the columns have rows of their own.
const LOW: u16 = 12;
/// Rows from which on the verdict has a row where there is no σ panel.
const WITH_VERDICT: u16 = 10;
/// Histories of fewer columns tell nothing.
const NARROWEST_STRIP: u16 = 10;
/// Rows from which on there are two for a sentence.
const TWO_LINES: u16 = 20;
/// Rows that a screen has besides the preset's texts.
const WITHOUT_TEXTS: u16 = 29;

/// Where one column of beads is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pane {
    /// Its title, in the rule above.
    pub title: Rect,
    /// Its trace.
    pub trace: Rect,
    /// The beads where they are now; empty where there is no room.
    pub column: Rect,
    /// The time axis below the trace; empty where there is no room.
    pub time: Rect,
}

/// What takes room on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Contents {
    /// Columns of beads.
    pub sides: usize,
    /// Lines about them.
    pub notices: u16,
    /// Lines of the preset's texts, all of them.
    pub texts: u16,
    /// Whether there are histories of their errors.
    pub errors: bool,
    /// The lattice on the left, where there is one.
    pub lattice: Option<LatticeShape>,
}

/// How many discs there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LatticeShape {
    /// Above one another.
    pub rows: usize,
    /// Side by side.
    pub columns: usize,
}

/// The panels below the traces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Panels {
    /// History of E; empty on narrow screens.
    pub energy: Rect,
    /// History of E_r/E.
    pub relative: Rect,
    /// History of errors; empty on narrow screens, and when not asked for.
    pub errors: Rect,
    /// σ, the verdict, ε_eff.
    pub sigma: Rect,
    /// The parameters.
    pub parameters: Rect,
}

/// Where everything stands. What has no room is an empty rectangle.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Layout {
    /// Preset, facts, time and speed.
    pub header: Rect,
    /// The rule over the traces.
    pub upper_rule: Rect,
    /// The discs of a lattice; of a lattice only.
    pub discs: Rect,
    /// The rule over histories that stand beside the discs.
    pub strips_rule: Rect,
    /// The vertical axis, common to all traces.
    pub axis: Rect,
    /// One or two columns of beads.
    pub panes: Vec<Pane>,
    /// The rule over the panels.
    pub lower_rule: Rect,
    /// The panels.
    pub panels: Panels,
    /// The preset's texts.
    pub text: Rect,
    /// The lines about the columns; empty on low screens.
    pub notices: Rect,
    /// The verdict, where there is no σ panel.
    pub verdict: Rect,
    /// The lines of the moment.
    pub message: Rect,
    /// The keys.
    pub keys: Rect,
}

/// Cuts rows off an area, from above and from below.
struct Rows(Rect);

impl Rows {
    fn top(&mut self, height: u16) -> Rect {
        let height = height.min(self.0.height);
        let cut = Rect { height, ..self.0 };
        self.0 = Rect {
            y: self.0.y + height,
            height: self.0.height - height,
            ..self.0
        };
        cut
    }

    fn bottom(&mut self, height: u16) -> Rect {
        let height = height.min(self.0.height);
        self.0.height -= height;
        Rect {
            y: self.0.y + self.0.height,
            height,
            ..self.0
        }
    }
}

/// The layout of a screen of that size with these contents.
pub fn layout((width, height): (u16, u16), contents: Contents) -> Layout {
    let mut rows = Rows(Rect {
        x: 0,
        y: 0,
        width,
        height,
    });
    let mut layout = Layout {
        header: rows.top(1),
        ..Layout::default()
    };
    if height >= 4 {
        layout.keys = rows.bottom(1);
    }
    // The texts, and their title.
    let text = match contents.texts {
        lines if lines > 0 && width >= 60 && height > WITHOUT_TEXTS + lines => lines + 1,
        _ => 0,
    };
    if height >= 8 {
        // Where the texts stand they need no turns here.
        let tall = height >= TWO_LINES && text == 0;
        layout.message = rows.bottom(if tall { 2 } else { 1 });
    }
    let panels = has_panels((width, height), contents);
    if height >= WITH_VERDICT && !panels {
        layout.verdict = rows.bottom(1);
    }
    if height >= LOW {
        layout.notices = rows.bottom(contents.notices);
    }
    layout.text = rows.bottom(text);
    if let Some(lattice) = contents.lattice {
        plane::place(&mut layout, rows, height, lattice, contents.sides);
        return layout;
    }
    if panels {
        let panels = rows.bottom(panel_height(height));
        layout.lower_rule = rows.bottom(1);
        layout.panels = panel_columns(panels, contents.errors);
    }
    if height >= 6 {
        layout.upper_rule = rows.top(1);
    }
    let time = if height >= 12 {
        rows.bottom(1)
    } else {
        Rect::default()
    };
    place_panes(&mut layout, rows.0, time, contents.sides);
    layout
}

/// Whether there is room for the panels.
fn has_panels((width, height): (u16, u16), contents: Contents) -> bool {
    let narrowest = if contents.lattice.is_some() {
        plane::WITH_PANELS
    } else {
        60
    };
    height >= 18 && width >= narrowest
}

/// Width of a trace on such a screen, cells.
pub fn trace_width(size: (u16, u16), contents: Contents) -> u16 {
    layout(size, contents)
        .panes
        .first()
        .map_or(1, |pane| pane.trace.width.max(1))
}

/// More rows on taller screens, until all parameters are seen.
fn panel_height(height: u16) -> u16 {
    match height {
        0..24 => (height - 17).max(2),
        _ => (7 + (height - 24) / 3).min(15),
    }
}

fn panel_columns(area: Rect, with_errors: bool) -> Panels {
    let spare = area.width.saturating_sub(80);
    let parameters = PARAMETERS + (spare / 6).min(12);
    let mut sigma = SIGMA + (spare / 5).min(20);
    let mut x = area.x;
    let mut take = |width: u16| {
        let cut = Rect { x, width, ..area };
        x += width + 1;
        cut
    };
    let mut left = area.width.saturating_sub(parameters + sigma + 2);
    if left < NARROWEST_STRIP {
        sigma = area.width.saturating_sub(parameters + 1);
        left = 0;
    }
    let none = Rect::default();
    let (energy, relative, errors) = match left {
        0 => (none, none, none),
        1..22 => (none, take(left), none),
        THREE_STRIPS.. if with_errors => {
            let third = (left - 2) / 3;
            (take(third), take(third), take(left - 2 - 2 * third))
        }
        _ => (take((left - 1) / 2), take(left - 1 - (left - 1) / 2), none),
    };
    Panels {
        energy,
        relative,
        errors,
        sigma: take(sigma),
        parameters: take(parameters),
    }
}

/// Beads beside the traces, when there is room: wider on wider screens.
fn column_width(pane: u16, height: u16) -> u16 {
    match pane {
        _ if height < 6 => 0,
        0..24 => 0,
        24..44 => 5,
        44..70 => 9,
        _ => 13,
    }
}

fn place_panes(layout: &mut Layout, area: Rect, time: Rect, sides: usize) {
    if area.is_empty() {
        return;
    }
    let axis = if area.width >= AXIS + NARROWEST {
        AXIS
    } else {
        0
    };
    layout.axis = Rect {
        width: axis,
        ..area
    };
    let room = area.width - axis;
    let both = sides > 1 && room > 2 * NARROWEST;
    let count = if both { 2 } else { 1 };
    let width = (room - (count - 1)) / count;
    for k in 0..count {
        let x = area.x + axis + k * (width + 1);
        let column = column_width(width, area.height);
        layout.place_pane(Rect { x, width, ..area }, column, time);
    }
}

impl Layout {
    /// A pane whose rightmost columns show the beads now.
    fn place_pane(&mut self, pane: Rect, column: u16, time: Rect) {
        let gap = u16::from(column > 0);
        let trace = Rect {
            width: pane.width - column - gap,
            ..pane
        };
        // The title of the first pane begins over the axis.
        let start = if self.panes.is_empty() {
            self.axis.x
        } else {
            pane.x
        };
        self.panes.push(Pane {
            title: Rect {
                x: start,
                width: pane.right() - start,
                ..self.upper_rule
            },
            trace,
            column: Rect {
                x: trace.right() + gap,
                width: column,
                ..pane
            },
            time: if time.is_empty() {
                time
            } else {
                Rect {
                    x: pane.x,
                    width: pane.width,
                    ..time
                }
            },
        });
    }
}
