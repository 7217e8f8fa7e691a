//! The help: the keys, and what the numbers mean.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};

use super::rules;
use crate::tui::keys::BINDINGS;
use crate::tui::model::Model;
use crate::tui::text::{columns, line, wrapped};

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
        "E",
        "kinetic energy of the beads for the mass of one, on an axis of powers of ten, as E_r/E is.",
    ),
    (
        "•",
        "at the right edge of the beads: the bead touches the one below, or the plate. The beads beside a trace are drawn where they are now.",
    ),
    (
        "gap×",
        "gaps between beads are drawn on so many times the scale of the beads: 0.5 is half as large, 100 shows gaps that would not be seen.",
    ),
    (
        "time",
        "a page is filled from left to right. What stands right of the pen (now) is the end of the page before, up to the time that is named there.",
    ),
    (
        "ghost",
        "the page that g kept, dim and dotted on the axes of the present one: from the begin of a page on, or from the same phase of the plate. It stays over edits and restarts until g or another preset; what was seen through z is seen through z only.",
    ),
    (
        "σ",
        "mean free flight of the beads from contact to contact, in contact times t_c: at a landing their mean separation over their speed, over t_c. On a plate the lowest of the last ten periods stands first. Where σ is far below 1 a contact has not ended when the next begins: the energy runs through the column as a wave, in place of one collision after another, and hardly any is lost. So soft contacts (MD) are not to be trusted there. Hard spheres have no contact time.",
    ),
    (
        "mean flight",
        "or mean σ: mean time between two contacts of a pair over the last plate period, in contact times. A few long flights rule it, so that dense landings hardly show in it.",
    ),
    (
        "verdict",
        "what soft contacts give from the start on against hard spheres, below it the quantity that parts them most: agreement within 5 % (MD holds), detachment beyond a half (MD fails: it is not to be trusted), crossover between (MD strays). It is the scene's, whatever is done to the running columns, and the same as in beadlab run.",
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

/// Its title, longest first.
const TITLES: [&str; 3] = [
    "help: any key goes back, arrows scroll",
    "help: arrows scroll",
    "help",
];
/// Columns before a text whose word stands above it.
const INDENT: u16 = 2;

/// A line of the help: a word, and what it stands for, from a column on.
#[derive(Debug)]
struct HelpLine {
    word: String,
    start: u16,
    text: String,
}

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
    let room = area.width.saturating_sub(rules::TITLE);
    let title = TITLES.iter().find(|title| columns(title) <= room);
    rules::title(theme, title.unwrap_or(&""), area, buffer);
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
    for (row, HelpLine { word, start, text }) in (0..body.height).zip(shown) {
        line(theme, buffer, body, row)
            .skip(1)
            .put(word, theme.strong());
        line(theme, buffer, body, row)
            .skip(*start)
            .put(text, Style::new());
    }
}

/// Narrower columns of texts are not worth a column of words beside them.
const NARROWEST: u16 = 30;
/// Columns between the words and what they stand for.
const APART: u16 = 2;

/// The lines of the help, for a screen of that width. Words too long for a column beside
/// the texts have lines of their own.
fn content(model: &Model, width: u16) -> Vec<HelpLine> {
    let theme = model.theme;
    let preset = &model.preset;
    let texts = [
        (preset.name.as_str(), preset.caption.as_str()),
        ("look for", &preset.look_for),
        ("try next", &preset.try_next),
    ];
    let keys = BINDINGS.iter().filter_map(|binding| binding.help);
    let parts = [texts.to_vec(), keys.collect(), TERMS.to_vec()];
    let words = parts
        .iter()
        .flatten()
        .map(|(word, _)| columns(&theme.text(word)));
    let most = width.saturating_sub(NARROWEST);
    let longest = words
        .map(|word| 1 + word + APART)
        .filter(|taken| *taken <= most);
    let beside = longest.max().unwrap_or(INDENT);
    let room = width.saturating_sub(beside + 1).max(1);
    let mut lines = Vec::new();
    let mut add =
        |word: String, start: u16, text: String| lines.push(HelpLine { word, start, text });
    for (k, part) in parts.iter().enumerate() {
        if k > 0 {
            add(String::new(), 0, String::new());
        }
        for (word, text) in part {
            let mut word = theme.text(word).into_owned();
            if 1 + columns(&word) + APART > beside {
                add(std::mem::take(&mut word), 0, String::new());
            }
            for text in wrapped(&theme.text(text), room) {
                add(std::mem::take(&mut word), beside, text);
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Preset;
    use crate::scene::preset::embedded;
    use crate::tui::theme::Theme;

    /// Words and texts never touch, and no text is cut, at any width that a word has room in.
    #[test]
    fn columns_do_not_touch_and_nothing_is_cut() {
        for (name, _) in embedded() {
            for (width, ascii) in [
                (200, false),
                (80, false),
                (80, true),
                (60, true),
                (40, false),
                (24, true),
            ] {
                let theme = Theme {
                    ascii,
                    colour: false,
                };
                let preset = Preset::load(name).expect("an embedded preset");
                let (model, _) = Model::new(preset, None, theme, (width, 24)).expect("a twin");
                let lines = content(&model, width);
                assert!(lines.iter().any(|line| line.word == *name));
                for HelpLine { word, start, text } in &lines {
                    let apart =
                        word.is_empty() || text.is_empty() || 1 + columns(word) + 2 <= *start;
                    assert!(apart, "{width}: {word} {text}");
                    assert!(start + columns(text) <= width, "{width}: {text}");
                    assert!(columns(word) < width, "{width}: {word}");
                }
            }
        }
    }

    #[test]
    fn words_stand_beside_their_texts_at_80_columns() {
        let preset = Preset::load("inelastic-ball").expect("an embedded preset");
        let theme = Theme {
            ascii: false,
            colour: false,
        };
        let (model, _) = Model::new(preset, None, theme, (80, 24)).expect("a scene");
        let lines = content(&model, 80);
        assert!(
            lines
                .iter()
                .all(|line| line.word.is_empty() || !line.text.is_empty())
        );
    }
}
