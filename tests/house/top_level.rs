//! What stands at the top of the repository.

use std::process::Command;

/// All that may: files and folders by name.
const THERE: [&str; 12] = [
    ".ci",
    ".gitignore",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE",
    "README.md",
    "clippy.toml",
    "findings",
    "presets",
    "src",
    "target",
    "tests",
];

/// A file that a test or a hand has left there is told before it is committed. Where the
/// source did not come by git there is nothing to ask.
#[test]
fn nothing_else_stands_at_the_top() {
    let mut git = Command::new("git");
    git.args(["ls-files", "--cached", "--others", "--exclude-standard"]);
    let output = git.current_dir(env!("CARGO_MANIFEST_DIR")).output();
    let Some(output) = output.ok().filter(|output| output.status.success()) else {
        return;
    };
    let files = String::from_utf8(output.stdout).expect("names are UTF-8");
    assert!(files.lines().any(|path| path == "src/lib.rs"), "{files}");
    let mut strays: Vec<&str> = files
        .lines()
        .filter_map(|path| path.split('/').next())
        .filter(|name| !THERE.contains(name))
        .collect();
    strays.dedup();
    assert_eq!(strays, Vec::<&str>::new());
}
