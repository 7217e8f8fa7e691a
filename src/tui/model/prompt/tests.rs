use super::*;
use crate::scene::parameters::{find, table};

fn typed(text: &str) -> Prompt {
    let mut prompt = Prompt::new(None);
    text.chars().for_each(|c| prompt.insert(c));
    prompt
}

/// The text, with a bar where typing goes on.
fn shown(prompt: &Prompt) -> String {
    let (before, after) = prompt.text().split_at(prompt.cursor());
    format!("{before}|{after}")
}

#[test]
fn keys_move_and_delete_as_in_a_shell() {
    use Place::{End, Left, Right, Start, Word};
    let mut prompt = typed("ε=0.8 µm");
    for (go, after) in [
        (Left, "ε=0.8 µ|m"),
        (Left, "ε=0.8 |µm"),
        (Start, "|ε=0.8 µm"),
        (Left, "|ε=0.8 µm"),
        (Right, "ε|=0.8 µm"),
        (End, "ε=0.8 µm|"),
        (Right, "ε=0.8 µm|"),
        (Word, "ε=0.8 |µm"),
        (Word, "ε=|0.8 µm"),
        (Word, "|ε=0.8 µm"),
        (Word, "|ε=0.8 µm"),
    ] {
        prompt.go(go);
        assert_eq!(shown(&prompt), after, "{go:?}");
    }
    for (delete, after) in [
        (Left, "|ε=0.8 µm"),
        (Right, "|=0.8 µm"),
        (End, "|"),
        (Right, "|"),
    ] {
        prompt.delete(delete);
        assert_eq!(shown(&prompt), after, "{delete:?}");
    }
    let mut prompt = typed("t_c = 4.6 us");
    for after in ["t_c = 4.6 |", "t_c = |", "|"] {
        prompt.delete(Word);
        assert_eq!(shown(&prompt), after);
    }
    let mut prompt = typed("t_c=4.6us");
    prompt.go(Left);
    prompt.delete(Start);
    assert_eq!(shown(&prompt), "|s");
    prompt.insert('µ');
    assert_eq!(shown(&prompt), "µ|s");
}

#[test]
fn the_line_stays_one_printable_line_of_bounded_length() {
    let mut prompt = typed("a\nb\u{1b}\tc");
    assert_eq!(shown(&prompt), "abc|");
    (0..200).for_each(|_| prompt.insert('µ'));
    assert_eq!(prompt.text().chars().count(), Prompt::LONGEST);
}

#[test]
fn earlier_lines_come_back_and_what_was_typed_too() {
    let entered = ["N=20".to_owned(), "f=30".to_owned()];
    let mut prompt = typed("ε");
    for (back, after) in [
        (false, "ε|"),
        (true, "f=30|"),
        (true, "N=20|"),
        (true, "N=20|"),
        (false, "f=30|"),
        (false, "ε|"),
        (false, "ε|"),
        (true, "f=30|"),
    ] {
        prompt.recall(&entered, back);
        assert_eq!(shown(&prompt), after);
    }
    let mut prompt = typed("ε");
    prompt.recall(&[], true);
    assert_eq!(shown(&prompt), "ε|");
}

#[test]
fn a_fault_is_shown_at_its_place() {
    let mut prompt = typed("ε=µ");
    // Also where the place is inside a character, or beyond the line.
    for (at, after) in [(3, "ε=|µ"), (4, "ε=|µ"), (99, "ε=µ|")] {
        prompt.refuse("no".to_owned(), at);
        assert_eq!(shown(&prompt), after);
        assert!(prompt.note.as_ref().is_some_and(|note| note.alarm));
    }
}

/// The line after Tab, and what is said.
fn completed(text: &str, back: usize) -> (String, String) {
    let mut prompt = typed(text);
    (0..back).for_each(|_| prompt.go(Place::Left));
    let all: Vec<_> = table().iter().collect();
    prompt.complete(&all, &["speed"]);
    let note = prompt.note.as_ref().map(|note| note.text.clone());
    (shown(&prompt), note.unwrap_or_default())
}

#[test]
fn tab_completes_names_and_words() {
    for (text, back, after) in [
        ("res", 0, "restitution=|"),
        ("sp", 0, "speed=|"),
        ("con", 0, "contact_time=|"),
        ("rest=0.9", 4, "restitution|=0.9"),
        ("eps", 0, "restitution=|"),
        ("ε", 0, "restitution=|"),
        ("law=t", 0, "law=taguchi|"),
        ("law=hertz-", 0, "law=hertz-kuwabara-kono|"),
        ("law=he", 0, "law=hertz|"),
        ("floor=same-s", 0, "floor=same-spring|"),
        ("floor_contact=", 0, "floor_contact=same-|"),
        ("jitter=of", 0, "jitter=off|"),
    ] {
        assert_eq!(completed(text, back), (after.to_owned(), String::new()));
    }
    for (text, says) in [
        ("d", "diameter  damping"),
        ("", "restitution"),
        ("t_", "contact_time  steps_per_contact"),
        ("xyz", "no such parameter"),
        ("law=x", "hooke"),
        ("law=", "hooke"),
        ("law=hertz", "hertz  hertz-kuwabara-kono"),
        ("t_c=", "contact_time: a number from 1e-12 to 1000 s"),
    ] {
        let (line, note) = completed(text, 0);
        assert_eq!(line, format!("{text}|"));
        let words = says.split_whitespace();
        assert!(
            words.clone().all(|word| note.contains(word)),
            "{text}: {note}"
        );
    }
    assert_eq!(
        completed("oops=1", 0),
        ("oops=1|".to_owned(), String::new())
    );
    let mut prompt = Prompt::new(find("law"));
    "tag".chars().for_each(|c| prompt.insert(c));
    prompt.complete(&[], &[]);
    assert_eq!(shown(&prompt), "taguchi|");
}
