//! The built program, run as a user runs it.
#![allow(dead_code, reason = "every room uses its own part of this")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// What the program does with these arguments and no standard input.
pub fn beadlab(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_beadlab"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("the program starts")
}

/// What a run that must succeed printed.
pub fn printed(arguments: &[&str]) -> String {
    let output = beadlab(arguments);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {stderr}");
    assert_eq!(stderr, "", "{arguments:?}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The one line with which bad input is refused, after `beadlab: `.
pub fn refused(arguments: &[&str]) -> String {
    failed(arguments, 2)
}

/// The one line of a run that ends with `code`.
pub fn failed(arguments: &[&str], code: i32) -> String {
    let output = beadlab(arguments);
    let stderr = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed something");
    assert!(stderr.ends_with('\n'), "{arguments:?}: {stderr:?}");
    assert_eq!(stderr.lines().count(), 1, "{arguments:?}: {stderr}");
    let line = stderr.trim_end().strip_prefix("beadlab: ");
    line.unwrap_or_else(|| panic!("{arguments:?}: {stderr}"))
        .to_owned()
}

/// A file of this test in the folder that cargo gives to tests.
pub fn file(name: &str, text: impl AsRef<[u8]>) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, text).expect("the folder of the tests can be written");
    path.into_os_string().into_string().expect("a UTF-8 path")
}

/// What `run` prints as JSON.
pub fn json(arguments: &[&str]) -> serde_json::Value {
    let all = [&["run"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&printed(&all)).expect("one JSON object")
}

/// Header and rows of CSV text.
pub fn table(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader
        .headers()
        .expect("a header")
        .iter()
        .map(String::from)
        .collect();
    let row = |record: csv::StringRecord| record.iter().map(String::from).collect();
    (
        header,
        reader
            .records()
            .map(|record| row(record.expect("a row")))
            .collect(),
    )
}

/// Where a file of this test would be; there is none.
pub fn no_file(name: &str) -> String {
    let path = file(name, "");
    fs::remove_file(&path).expect("it was written a moment ago");
    path
}

/// A file as text.
pub fn file_text(path: &str) -> String {
    fs::read_to_string(path).expect("a file of text")
}

/// A sweep that must succeed, into a file.
pub fn sweep(arguments: &[&str], out: &str) {
    let all = [&["sweep"], arguments, &["--out", out]].concat();
    let printed = printed(&all);
    assert!(printed.is_empty(), "{all:?}: {printed}");
}
