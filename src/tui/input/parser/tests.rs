//! What terminals send, and what it means.

use super::*;
use crossterm::event::{KeyCode, KeyModifiers};

fn after(milliseconds: u64, start: Instant) -> Instant {
    start + Duration::from_millis(milliseconds)
}

/// What is said, in words; `|` in the text is a pause of half a second.
fn said(text: &str) -> String {
    let mut now = Instant::now();
    let mut parser = Parser::new(now);
    let mut all = Vec::new();
    for (k, part) in text.split('|').enumerate() {
        if k > 0 {
            if parser.deadline().is_some() {
                all.extend(parser.expire());
            }
            now = after(500, now);
        }
        all.extend(parser.feed(part.as_bytes(), now));
    }
    let words: Vec<String> = all.iter().map(word).collect();
    words.join(" ")
}

fn word(said: &Said) -> String {
    match said {
        Said::Receipt => "receipt".to_owned(),
        Said::Event(Event::Paste(text)) => format!("paste:{text}"),
        Said::Event(Event::Key(key)) => {
            let name = match key.code {
                KeyCode::Char(c) => c.to_string(),
                code => format!("{code:?}"),
            };
            let held = [
                (KeyModifiers::CONTROL, "C-"),
                (KeyModifiers::ALT, "A-"),
                (KeyModifiers::SHIFT, "S-"),
            ];
            let held = held.iter().filter(|(one, _)| key.modifiers.contains(*one));
            let held: String = held.map(|(_, text)| *text).collect();
            held + &name
        }
        Said::Event(event) => format!("{event:?}"),
    }
}

#[test]
fn keys_are_what_terminals_send_for_them() {
    for (bytes, keys) in [
        ("qE \r\t\x7f", "q S-E   Enter Tab Backspace"),
        ("\x03\x1a\x0c", "C-c C-z C-l"),
        ("\x1b[A\x1b[B\x1bOC\x1bOD", "Up Down Right Left"),
        (
            "\x1b[H\x1bOF\x1b[1~\x1b[4~\x1b[3~",
            "Home End Home End Delete",
        ),
        ("\x1b[5~\x1b[6~\x1b[Z", "PageUp PageDown S-BackTab"),
        ("\x1b[1;2C\x1b[1;5D\x1b[1;3A", "S-Right C-Left A-Up"),
        ("\x1b|", "Esc"),
        ("\x1b|q", "Esc q"),
        ("\x1b\x1b[A", "Esc Up"),
        ("\x1bq\x1bE", "A-q A-S-E"),
        // Kitty's way: Alt-Shift-t, Esc, q let go, é; and xterm's.
        ("\x1b[116;4u\x1b[27u\x1b[113;1:3u\x1b[233u", "A-S-T Esc é"),
        ("\x1b[27;5;99~\x1b[27;2;116~", "C-c S-T"),
        // The Linux console's F1 to F5, and functions of which nothing is known.
        ("\x1b[[Aq\x1b[15~q\x1b[1;2Pq", "q q q"),
        ("ε\u{e5}", "ε å"),
    ] {
        assert_eq!(
            said(bytes),
            keys.replace("S-BackTab", "BackTab"),
            "{bytes:?}"
        );
    }
}

#[test]
fn a_key_that_is_joined_to_esc_is_still_there() {
    for (bytes, keys) in [
        ("\x1b\r", "Esc Enter"),
        ("\x1b\x03", "C-c"),
        ("\x1b é", "A-  é"),
        ("\x1bé", "Esc é"),
        ("\x1b[|q", "A-[ q"),
        ("\x1bO|q", "A-S-O q"),
        ("\x1b]|q", "A-] q"),
        ("\x1b+q", "A-+ q"),
    ] {
        assert_eq!(said(bytes), keys, "{bytes:?}");
    }
}

#[test]
fn answers_are_no_keys() {
    for answer in [
        "\x1b[?62;22c",
        "\x1b[>41;371;0c",
        "\x1b[24;80R",
        "\x1b[?997;1n",
        "\x1b]11;rgb:0000/0000/0000\x1b\\",
        "\x1b]11;rgb:ffff/ffff/ffff\x07",
        "\x1bP>|xterm(371)\x1b\\",
        "\x1bP1+r436f=3830\x1b\\",
        "\x1b[?2026;2$y",
        "\x1b[?1u",
        "\x1b_Gi=1;OK\x1b\\",
        "\x1b[8;24;80t",
        "\x1b[I\x1b[O",
        "\x1b[M q!\x1b[<0;3;4M",
    ] {
        // As a whole, and byte by byte.
        let text = answer.replace('|', "!");
        assert_eq!(said(&text), "", "{answer:?}");
        let (now, mut all) = (Instant::now(), Vec::new());
        let mut parser = Parser::new(now);
        for byte in text.bytes() {
            all.extend(parser.feed(&[byte], now));
        }
        assert_eq!(all, [], "{answer:?}");
        assert_eq!(said(&(text + "|q")), "q", "{answer:?}");
    }
    assert_eq!(said("\x1b[0nq\x1b[3n"), "receipt q receipt");
}

#[test]
fn what_does_not_end_swallows_nothing_later() {
    for open in [
        "\x1b[1;",
        "\x1b[?99999999;1",
        "\x1b]11;rgb:0000",
        "\x1bP1+r",
        "\x1b_G",
        "\x1b[M ",
        "\x1bX",
        "\x1b[200~text",
        "\x1b]0;\x1b",
    ] {
        assert!(said(&format!("{open}|q")).ends_with('q'), "{open:?}");
        assert!(said(&format!("{open}\x03")).ends_with("C-c"), "{open:?}");
    }
    // Bytes that go on do not keep a string open.
    let start = Instant::now();
    let mut parser = Parser::new(start);
    parser.feed(b"\x1b]11;", start);
    let mut keys = Vec::new();
    for k in 1..8 {
        keys.extend(parser.feed(b"q", after(100 * k, start)));
    }
    assert_eq!(keys.len(), 5);
}

#[test]
fn pastes_are_text() {
    assert_eq!(said("\x1b[200~n=3\rq\x1b[A\x1b[201~q"), "paste:n=3\rq q");
    assert_eq!(said("\x1b[200~n=3|q"), "paste:n=3 q");
    // Receipts come all the while.
    assert_eq!(
        said("\x1b[200~n=\x1b[0n3|\x1b[0nq"),
        "receipt paste:n=3 receipt q"
    );
    let start = Instant::now();
    let mut parser = Parser::new(start);
    let mut all = parser.feed(b"\x1b[200~n=3", start);
    for k in 1..6 {
        all.extend(parser.feed(b"\x1b[0n", after(100 * k, start)));
    }
    all.extend(parser.feed(b"q", after(600, start)));
    assert_eq!(all.iter().map(word).next_back().as_deref(), Some("q"));
}
