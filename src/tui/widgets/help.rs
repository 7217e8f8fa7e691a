//! The help: the keys, and what the numbers mean.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};

use super::rules;
use super::text::{line, wrapped};
use crate::tui::keys::BINDINGS;
use crate::tui::model::Model;

/// What the screen shows, term by term.
const TERMS: &[(&str, &str)] = &[
    (
        "typing",
        "names or symbols; a bare number is in SI units, and s ms µs ns ps, m mm µm nm pm, Hz kHz MHz may follow it (u for µ). Tab completes, ↑ ↓ bring lines back, Ctrl-A Ctrl-E go to the ends, Ctrl-W Ctrl-U Ctrl-K delete.",
    ),
    (
        "z_i",
        "reduced height of bead i: its height less the diameters of the beads below. All lines meet where the beads touch.",
    ),
    (
        "MD",
        "soft contacts that last t_c. Contacts of many beads at once lose too little energy: the detachment effect.",
    ),
    (
        "ED",
        "hard spheres, one collision after another, none of which takes time.",
    ),
    (
        "2D 1D",
        "soft discs of a lattice, and the soft column that is as high, all else being alike. There are no hard discs to compare with: the verdict is by σ_0 alone.",
    ),
    (
        "discs",
        "gaps, heights and shifts are so many times larger than the discs; the filled ones touch another or the floor. The sides are joined: what leaves on one enters on the other.",
    ),
    (
        "E_r/E",
        "the part of the kinetic energy that is motion of the beads against each other: 0 for a column that moves as one.",
    ),
    (
        "σ landing",
        "mean separation of the beads over their speed as they arrive at the floor, in contact times; below it the lowest of the last ten plate periods. σ ≪ 1: contacts overlap in time, and little is lost.",
    ),
    (
        "σ",
        "mean free flight between two contacts of a pair, in contact times. A few long flights rule it.",
    ),
    (
        "verdict",
        "what soft contacts give from the start on against hard spheres, below it the quantity that parts them most: agreement within 5 %, detachment beyond a half (MD is not to be trusted), crossover between. It is the scene's, whatever is done to the running columns, and the same as in beadlab run.",
    ),
    (
        "ε_eff",
        "speed of the column after its last bounce off the floor over that before.",
    ),
    (
        "drift",
        "change of the energy ledger, relative to its largest term: it checks the books; a grid is off by far more (x).",
    ),
    (
        "edits",
        "act at once, and beads and plate keep their places and velocities. Another amplitude or frequency acts gently, from when the plate next passes its middle: one swing, about a period, leads over to the new motion without a jump of place, velocity or acceleration. What rests is thrown only if one of both motions throws it. Undo, redo and 0 lead back in the same way; r starts with it from t = 0. Overlaps alone change at once: a stiffer contact law keeps a contact's force, so the beads above rise a little, a softer one its overlap.",
    ),
    (
        "Gear Verlet",
        "soft contacts on a fixed grid of steps, t_c/100 say. Too few steps and they blow up; the screen warns.",
    ),
    (
        "exact",
        "soft contacts without steps: linear contacts to rounding; power laws by an adaptive method to a tolerance.",
    ),
    (
        "error",
        "what x shows: an exact run from the column's state at that moment goes on beside it, in the time that the columns leave. How far the bead that is furthest off is off, in metres and in diameters, and by what part E is. A fixed grid is off by its steps; what is exact by rounding, which grows on a plate: the motion is chaotic there.",
    ),
];

/// A line of the help: a word, and what it stands for.
type Entry = (String, String);

/// Draws the help over the whole area, scrolled down by so many lines.
pub fn render(model: &Model, scrolled: u16, area: Rect, buffer: &mut Buffer) {
    Clear.render(area, buffer);
    let theme = model.theme;
    rules::horizontal(
        theme,
        Rect {
            height: 1.min(area.height),
            ..area
        },
        buffer,
    );
    rules::title(
        theme,
        "help: any key goes back, arrows scroll",
        area,
        buffer,
    );
    let body = Rect {
        y: area.y.saturating_add(1),
        height: area.height.saturating_sub(1),
        ..area
    };
    let lines = content(model, body.width);
    let last = u16::try_from(lines.len())
        .unwrap_or(u16::MAX)
        .saturating_sub(body.height);
    let shown = lines.iter().skip(usize::from(scrolled.min(last)));
    for (row, (word, text)) in (0..body.height).zip(shown) {
        let narrow = Rect {
            width: WORD,
            ..body
        };
        let rest = Rect {
            x: body.x + WORD.min(body.width),
            width: body.width.saturating_sub(WORD),
            ..body
        };
        line(theme, buffer, narrow, row).put(&format!(" {word}"), theme.strong());
        line(theme, buffer, rest, row).put(text, Style::new());
    }
}

/// Columns for the word at the left.
const WORD: u16 = 12;

fn content(model: &Model, width: u16) -> Vec<Entry> {
    let room = width.saturating_sub(WORD + 1).max(10);
    let preset = &model.preset;
    let mut lines = Vec::new();
    let mut add = |word: &str, text: &str| {
        for (k, text) in wrapped(text, room).into_iter().enumerate() {
            lines.push((
                if k == 0 {
                    word.to_owned()
                } else {
                    String::new()
                },
                text,
            ));
        }
    };
    add(&preset.name, &preset.caption);
    add("look for", &preset.look_for);
    add("try next", &preset.try_next);
    add("", "");
    for (keys, what) in BINDINGS.iter().filter_map(|binding| binding.help) {
        add(keys, what);
    }
    add("", "");
    for (term, what) in TERMS {
        add(term, what);
    }
    lines
}
