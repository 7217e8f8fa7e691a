//! `beadlab sweep --resume`: what a file must be to be gone on with.

use crate::program::{file_text as text, no_file, refused, sweep};
use std::fs;

#[test]
fn a_row_that_is_not_this_sweeps_is_named_and_nothing_is_lost() {
    let quick = ["fig1b", "--over", "n=2,3"];
    let out = no_file("sweep-wrong.csv");
    sweep(&quick, &out);
    let whole = text(&out);
    let lines: Vec<&str> = whole.lines().collect();
    let (number, row) = (lines.len(), lines[lines.len() - 1]);
    let cells: Vec<&str> = row.split(',').collect();
    let with = |k: usize, cell: &str| {
        let mut cells = cells.clone();
        cells[k] = cell;
        cells.join(",") + "\n"
    };
    let empty = "3".to_owned() + &",".repeat(cells.len() - 1) + "\n";
    for (wrong, reason) in [
        (with(0, "2"), "column 1 (n): `2` must be 3"),
        (
            with(1, "0.3x"),
            "column 2 (eps_eff): `0.3x` must be a number",
        ),
        (
            with(2, "NaN"),
            "column 3 (er_over_ef): `NaN` must be a number",
        ),
        (
            with(3, "\u{202e}1"),
            r"column 4 (contact_duration): `\u{202e}1` must be a number",
        ),
        (
            with(18, "1.5"),
            "column 19 (steps): `1.5` must be a whole number",
        ),
        (with(19, ""), "must be empty, since the row has no results"),
        (empty, "column 21 (note): `` must be the row's note"),
        (format!("{row},1\n"), "22 cells, must be 21"),
        ("3,1\n".to_owned(), "2 cells, must be 21"),
        ("\n".to_owned(), "0 cells, must be 21"),
        (
            "my notes".to_owned(),
            "`my notes` is not the beginning of row 2",
        ),
        (
            format!("{row}\n4,"),
            "is one too many, since this sweep has 2 rows",
        ),
    ] {
        let other = whole.replace(&format!("{row}\n"), &wrong);
        fs::write(&out, &other).expect("a file");
        let resume = [&["sweep"], &quick[..], &["--resume", "--out", &out]].concat();
        let line = refused(&resume);
        let number = number + usize::from(reason.contains("too many"));
        assert!(line.contains(&format!("line {number}")), "{line}");
        assert!(line.contains(reason), "{line}");
        assert_eq!(text(&out), other);
    }
    // Half a row is no wrong one, nor is a number that is another.
    for half in [&row[..1], &row[..row.len() / 2], row] {
        fs::write(&out, whole.replace(&format!("{row}\n"), half)).expect("a file");
        sweep(&[&quick[..], &["--resume"]].concat(), &out);
        assert_eq!(text(&out), whole, "{half}");
    }
}

#[test]
fn of_a_file_that_is_not_a_sweeps_only_as_much_is_read_as_a_header_is_long() {
    // It would take more memory than there is, if it were read to its end.
    let out = no_file("sweep-huge.csv");
    let huge = fs::File::create(&out).expect("a file");
    huge.set_len(1 << 40)
        .expect("a file of zeros that takes no room");
    drop(huge);
    let line = refused(&[
        "sweep", "fig1b", "--over", "n=1,2", "--resume", "--out", &out,
    ]);
    assert!(line.contains("is of another sweep: line 1"), "{line}");
    fs::remove_file(&out).expect("it was made here");
}
