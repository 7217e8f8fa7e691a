//! Keys: one table, read by the loop, by the line at the bottom and by the help.

use crossterm::event::{Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

use crate::live::{Leap, Way};

/// What a key asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Pause, or go on.
    Pause,
    /// Pause, and go back or on by one frame.
    Frame(Way),
    /// Pause, and go to another time.
    Leap(Leap),
    /// Start again from t = 0.
    Restart,
    /// Slow down at the next landing until contacts can be watched, or go on as before.
    LookInto,
    /// The present page behind those that follow, or no longer.
    Ghost,
    /// One speed of the ladder slower or faster.
    Speed(i32),
    /// The next method for the left column.
    Method,
    /// The twin on or off.
    Twin,
    /// The error against an exact run in the shadow, shown or not.
    Shadow,
    /// The list of presets.
    Presets,
    /// The help.
    Help,
    /// A parameter by name, or the selected one, up or down by key presses.
    Nudge {
        /// The parameter; the selected one if none is named.
        name: Option<&'static str>,
        /// How many key presses.
        steps: i32,
        /// Whether they are coarse ones.
        coarse: bool,
    },
    /// Select a row of the panel further down, or up if negative.
    Select(i32),
    /// Type a value for the selected parameter.
    Exact,
    /// Type `name=value`.
    Prompt,
    /// Take the last edit back.
    Undo,
    /// Make the edit again that was taken back last.
    Redo,
    /// Back to the preset.
    Reset,
    /// The command line that makes what is simulated.
    CommandLine,
    /// A file of what is simulated.
    Save,
    /// A tape of the session, begun or ended.
    Record,
    /// A picture of what the traces show, and its numbers.
    Picture,
    /// Draw the whole screen again.
    Redraw,
    /// Stop the program for a while, as the shell's job.
    Suspend,
    /// Leave.
    Quit,
}

/// A row of the table.
#[derive(Debug)]
pub struct Binding {
    codes: &'static [KeyCode],
    ctrl: bool,
    action: Action,
    /// The keys in words, and what they do, for the help; none for a row that is
    /// told together with the one before.
    pub help: Option<(&'static str, &'static str)>,
    /// The same for the line at the bottom.
    pub hint: Option<Hint>,
}

/// Keys on the line at the bottom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hint {
    /// The keys.
    pub keys: &'static str,
    /// What they do, in a word.
    pub what: &'static str,
    /// Narrow lines leave out the hints of the highest rank.
    pub rank: u8,
}

const fn key(codes: &'static [KeyCode], action: Action) -> Binding {
    Binding {
        codes,
        ctrl: false,
        action,
        help: None,
        hint: None,
    }
}

const fn ctrl(codes: &'static [KeyCode], action: Action) -> Binding {
    Binding {
        codes,
        ctrl: true,
        action,
        help: None,
        hint: None,
    }
}

const fn leap(codes: &'static [KeyCode], leap: Leap) -> Binding {
    key(codes, Action::Leap(leap))
}

const fn nudge(codes: &'static [KeyCode], name: &'static str, steps: i32) -> Binding {
    key(
        codes,
        Action::Nudge {
            name: Some(name),
            steps,
            coarse: false,
        },
    )
}

const fn turn(codes: &'static [KeyCode], steps: i32, coarse: bool) -> Binding {
    key(
        codes,
        Action::Nudge {
            name: None,
            steps,
            coarse,
        },
    )
}

impl Binding {
    const fn help(mut self, keys: &'static str, what: &'static str) -> Self {
        self.help = Some((keys, what));
        self
    }

    const fn hint(mut self, keys: &'static str, what: &'static str, rank: u8) -> Self {
        self.hint = Some(Hint { keys, what, rank });
        self
    }
}

use KeyCode::{Backspace, Char, Down, End, Enter, Home, Left, PageDown, PageUp, Right, Up};

/// All keys, in the order of the help.
pub const BINDINGS: &[Binding] = &[
    key(&[Char(' ')], Action::Pause)
        .help("space", "pause, go on")
        .hint("space", "pause", 1),
    key(&[Char(',')], Action::Frame(Way::Back))
        .help(
            ", .",
            "pause, and a frame back, on: held down, time runs so",
        )
        .hint(", .", "back, on", 7),
    key(&[Char('.')], Action::Frame(Way::On)),
    leap(&[Char('<')], Leap::Change(Way::Back))
        .help("< >", "to the contact or collision before, after"),
    leap(&[Char('>')], Leap::Change(Way::On)),
    leap(&[Char('{')], Leap::Landing(Way::Back)).help("{ }", "to the landing before, after"),
    leap(&[Char('}')], Leap::Landing(Way::On)),
    leap(&[Char('(')], Leap::Period(Way::Back)).help("( )", "a period of the plate back, on"),
    leap(&[Char(')')], Leap::Period(Way::On)),
    leap(&[Home], Leap::To(0.0)).help("Home End", "to the start, to the latest"),
    leap(&[End], Leap::End),
    key(&[Char('[')], Action::Speed(-1))
        .help("[ ]", "slower, faster")
        .hint("[ ]", "speed", 2),
    key(&[Char(']')], Action::Speed(1)),
    key(&[Char('z')], Action::LookInto)
        .help(
            "z",
            "the next landing so slowly that contacts are seen; back",
        )
        .hint("z", "into a landing", 8),
    key(&[Char('r')], Action::Restart)
        .help("r", "start again from t = 0")
        .hint("r", "restart", 5),
    key(&[Char('g')], Action::Ghost)
        .help(
            "g",
            "keep this page as a ghost behind what follows; let it go",
        )
        .hint("g", "ghost", 11),
    key(&[Char('m')], Action::Method)
        .help("m", "next method: Gear, Verlet, exact, ED")
        .hint("m", "method", 6),
    key(&[Char('w')], Action::Twin)
        .help("w", "twin on, off")
        .hint("w", "twin", 9),
    key(&[Char('x')], Action::Shadow)
        .help("x", "error against an exact run in the shadow, on, off")
        .hint("x", "error", 10),
    key(&[Char('p')], Action::Presets)
        .help("p", "presets")
        .hint("p", "presets", 3),
    nudge(&[Char('e')], "restitution", -1).help("e E", "ε down, up (Alt: coarse)"),
    nudge(&[Char('E')], "restitution", 1),
    nudge(&[Char('t')], "contact_time", -1).help("t T", "t_c down, up"),
    nudge(&[Char('T')], "contact_time", 1),
    nudge(&[Char('a')], "amplitude", -1).help("a A", "amplitude down, up"),
    nudge(&[Char('A')], "amplitude", 1),
    nudge(&[Char('f')], "frequency", -1).help("f F", "frequency down, up"),
    nudge(&[Char('F')], "frequency", 1),
    key(&[Up], Action::Select(-1)).help("↑ ↓", "select a parameter"),
    key(&[Down], Action::Select(1)),
    turn(&[Left, Char('-')], -1, false).help("← →", "selected one down, up (or - +)"),
    turn(&[Right, Char('+'), Char('=')], 1, false),
    turn(&[PageDown], -1, true).help("PgDn PgUp", "coarsely (or Shift ← →)"),
    turn(&[PageUp], 1, true),
    key(&[Enter], Action::Exact).help("Enter", "type a value for it"),
    key(&[Char(':')], Action::Prompt)
        .help(":", "type name=value, such as t_c=4.6us or N=20")
        .hint(":", "set", 4),
    key(&[Char('u')], Action::Undo)
        .help("u U", "undo the last edit; redo it")
        .hint("u", "undo", 8),
    key(&[Char('U')], Action::Redo),
    key(&[Char('0'), Backspace], Action::Reset).help("0", "back to the preset"),
    key(&[Char('y')], Action::CommandLine).help(
        "y",
        "the command that opens this; copied, and told on leaving",
    ),
    key(&[Char('s')], Action::Save).help("s", "save this as a preset file, never over another"),
    key(&[Char('R')], Action::Record).help("R", "record the session to a tape; end it"),
    key(&[Char('P')], Action::Picture)
        .help(
            "P",
            "save the traces as a picture (SVG) and as numbers (CSV)",
        )
        .hint("P", "picture", 12),
    key(&[Char('?'), Char('h')], Action::Help)
        .help("?", "this help")
        .hint("?", "help", 0),
    ctrl(&[Char('l')], Action::Redraw),
    ctrl(&[Char('z')], Action::Suspend),
    key(&[Char('q')], Action::Quit)
        .help("q", "quit (or Ctrl-C)")
        .hint("q", "quit", 0),
    ctrl(&[Char('c')], Action::Quit),
];

/// What a key asks for on the main screen. Alt and Shift make a nudge coarse.
pub fn action(key: KeyEvent) -> Option<Action> {
    // Both together are AltGr on Windows, by which many a keyboard has its brackets.
    let alt_gr = key
        .modifiers
        .contains(KeyModifiers::CONTROL | KeyModifiers::ALT)
        && matches!(key.code, Char(_));
    let key = KeyEvent {
        modifiers: if alt_gr {
            KeyModifiers::NONE
        } else {
            key.modifiers
        },
        ..key
    };
    let ctrl = key.modifiers.contains(KeyModifiers::CONTROL);
    let coarse_arrow = !matches!(key.code, Char(_))
        && key
            .modifiers
            .intersects(KeyModifiers::SHIFT | KeyModifiers::CONTROL);
    let coarse = coarse_arrow || key.modifiers.contains(KeyModifiers::ALT);
    let is_char = matches!(key.code, Char(_));
    let found = BINDINGS
        .iter()
        .find(|b| b.codes.contains(&key.code) && (b.ctrl == ctrl || !is_char))?;
    Some(match found.action {
        Action::Nudge {
            name,
            steps,
            coarse: always,
        } => Action::Nudge {
            name,
            steps,
            coarse: coarse || always,
        },
        other => other,
    })
}

/// Whether it is the key that leaves from everywhere.
pub fn is_ctrl_c(event: &Event) -> bool {
    matches!(event, Event::Key(key) if key.code == Char('c')
        && key.modifiers == KeyModifiers::CONTROL
        && key.kind != KeyEventKind::Release)
}

/// The keys of a parameter, for the panel: `e/E`.
pub fn keys_of(parameter: &str) -> &'static str {
    match parameter {
        "restitution" => "e/E",
        "contact_time" => "t/T",
        "amplitude" => "a/A",
        "frequency" => "f/F",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_has_two_meanings() {
        for (k, binding) in BINDINGS.iter().enumerate() {
            for other in &BINDINGS[k + 1..] {
                let shared = binding.codes.iter().any(|code| other.codes.contains(code));
                assert!(
                    !shared || binding.ctrl != other.ctrl,
                    "{binding:?} and {other:?}"
                );
            }
        }
    }

    #[test]
    fn letters_nudge_finely_and_with_alt_coarsely() {
        let fine = action(KeyEvent::new(Char('E'), KeyModifiers::SHIFT));
        assert_eq!(
            fine,
            Some(Action::Nudge {
                name: Some("restitution"),
                steps: 1,
                coarse: false
            })
        );
        let coarse = action(KeyEvent::new(Char('e'), KeyModifiers::ALT));
        assert_eq!(
            coarse,
            Some(Action::Nudge {
                name: Some("restitution"),
                steps: -1,
                coarse: true
            })
        );
        let arrow = action(KeyEvent::new(Left, KeyModifiers::SHIFT));
        assert_eq!(
            arrow,
            Some(Action::Nudge {
                name: None,
                steps: -1,
                coarse: true
            })
        );
    }

    /// Kitty's Alt-Shift-t is taken for what it writes by the reader of its protocol.
    #[test]
    fn alt_gr_writes_brackets() {
        let both = KeyModifiers::CONTROL | KeyModifiers::ALT;
        for c in ['[', ']'] {
            let typed = action(KeyEvent::new(Char(c), both));
            assert!(typed.is_some());
            assert_eq!(typed, action(KeyEvent::new(Char(c), KeyModifiers::NONE)));
        }
    }

    #[test]
    fn control_letters_are_not_letters() {
        assert_eq!(
            action(KeyEvent::new(Char('c'), KeyModifiers::CONTROL)),
            Some(Action::Quit)
        );
        assert_eq!(
            action(KeyEvent::new(Char('e'), KeyModifiers::CONTROL)),
            None
        );
        assert!(action(KeyEvent::new(Char('e'), KeyModifiers::NONE)).is_some());
    }
}
