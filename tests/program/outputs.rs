//! Where results go: a file that appears when it is complete, and is otherwise as it was,
//! whatever ends the command; and what reaches a terminal.

use crate::program::{beadlab, printed, refused};
use std::fs;
use std::path::{Path, PathBuf};

/// An empty folder of this test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("a folder of an earlier run");
    }
    fs::create_dir(&folder).expect("the folder of the tests can be written");
    folder
}

/// Names in a folder, in their order.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name())
        .map(|name| name.into_string().expect("a UTF-8 name"))
        .collect();
    names.sort();
    names
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).expect("a file of text")
}

/// A path as an argument.
fn argument(path: &Path) -> &str {
    path.to_str().expect("a UTF-8 path")
}

#[test]
fn a_path_that_can_take_no_file_is_refused_before_the_run() {
    let folder = folder("outputs-refused");
    let there = folder.join("there");
    fs::create_dir(&there).expect("a folder");
    for (path, reason) in [
        ("new/", "this names a folder"),
        ("new/.", "this names a folder"),
        ("there", "this names a folder"),
        ("there/..", "this names a folder"),
        ("no/such.csv", "there is no such folder"),
    ] {
        let path = folder.join(path);
        // Hours, if the path did not come first.
        let run = [
            "run",
            "fig5b",
            "--set",
            "duration=1e5",
            "--out",
            argument(&path),
        ];
        let line = refused(&run);
        assert!(
            line.starts_with("--out ") && line.contains(reason),
            "{line}"
        );
        let sweep = [
            "sweep",
            "fig1b",
            "--over",
            "n=1,2",
            "--out",
            argument(&path),
        ];
        let line = refused(&sweep);
        // Which of the two is missing the system decides.
        assert!(
            line.starts_with("--out ") && line.contains("folder"),
            "{line}"
        );
        assert_eq!(names(&folder), ["there"]);
    }
    assert_eq!(names(&there), Vec::<String>::new());
}

#[test]
fn what_cannot_be_seen_reaches_no_terminal() {
    let folder = folder("outputs-hidden");
    // An override of direction, a zero-width space, and an isolate.
    let hidden = ['\u{202e}', '\u{200b}', '\u{2066}', '\u{1b}'];
    let shown = |arguments: &[&str]| {
        let output = beadlab(arguments);
        let both = [output.stdout, output.stderr].concat();
        let text = String::from_utf8(both).expect("UTF-8");
        assert!(!text.contains(hidden), "{arguments:?}: {text:?}");
        text
    };
    let preset = printed(&["presets", "show", "fig1b"]).replace("Soft beads", "soft beads");
    let title = preset.lines().find(|line| line.starts_with("title"));
    let title = title.expect("every preset has a title");
    let strange = "title = \"beads \u{202e}that\u{200b} hit\"";
    let file = folder.join("a\u{2066}b.toml");
    fs::write(&file, preset.replace(title, strange)).expect("a file");
    let path = argument(&file);
    for arguments in [
        &["presets", "check", path][..],
        &["run", path],
        &["run", path, "--format", "csv"],
    ] {
        let text = shown(arguments);
        assert!(text.contains(r"a\u{2066}b"), "{arguments:?}: {text}");
    }
    assert!(shown(&["run", path]).contains(r"beads \u{202e}that\u{200b} hit"));
    for arguments in [
        &["run", "fig\u{202e}1b"][..],
        &["run", "fig1b", "--set", "n\u{202e}=3"],
        &["run", "fig1b", "--set", "n=3\u{202e}"],
        &["run", "fig1b", "--format", "\u{202e}csv"],
        &["run", "fig1b", "--out", "/no/such\u{202e}/folder"],
        &["sweep", "fig1b", "--over", "n=\u{202e}1,2", "--out", "x"],
        &["figure", "2a\u{202e}"],
        &["\u{202e}"],
    ] {
        let text = shown(arguments);
        assert!(text.contains(r"\u{202e}"), "{arguments:?}: {text}");
    }
}

#[cfg(unix)]
mod signals {
    use super::{argument, folder, names, text};
    use std::fs;
    use std::io::Read;
    use std::path::Path;
    use std::process::{Child, Command, ExitStatus, Stdio};
    use std::thread;
    use std::time::Duration;

    /// A minute, in looks: a machine that is so slow has other troubles.
    const LOOKS: usize = 12_000;
    const LOOK: Duration = Duration::from_millis(5);

    /// A child of this test that is still there when the test fails would outlive it.
    struct Running(Child);

    impl Drop for Running {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    impl Running {
        /// The program, started by a shell that does `first`, and becomes it.
        fn start(first: &str, arguments: &[&str]) -> Self {
            let program = Command::new("sh")
                .args(["-c", &format!("{first} exec \"$0\" \"$@\"")])
                .arg(env!("CARGO_BIN_EXE_beadlab"))
                .args(arguments)
                .stdin(Stdio::null())
                .stdout(Stdio::null())
                .stderr(Stdio::piped())
                .spawn();
            Self(program.expect("the shell starts"))
        }

        fn send(&self, signal: &str) {
            let kill = Command::new("kill")
                .args([&format!("-{signal}"), &self.0.id().to_string()])
                .status();
            assert!(kill.expect("kill runs").success());
        }

        /// How it ended, and what it said.
        fn end(mut self) -> (ExitStatus, String) {
            for _ in 0..LOOKS {
                if let Some(status) = self.0.try_wait().expect("a child") {
                    let mut said = String::new();
                    let stderr = self.0.stderr.as_mut().expect("a pipe");
                    stderr.read_to_string(&mut said).expect("text");
                    return (status, said);
                }
                thread::sleep(LOOK);
            }
            panic!("it does not end");
        }
    }

    fn wait_until(is_so: impl Fn() -> bool) {
        for _ in 0..LOOKS {
            if is_so() {
                return;
            }
            thread::sleep(LOOK);
        }
        panic!("it never comes");
    }

    fn has_part(folder: &Path) -> bool {
        names(folder).iter().any(|name| name.contains(".part"))
    }

    #[test]
    fn ctrl_c_and_term_leave_the_file_that_was_there_and_no_other() {
        for (signal, code) in [("INT", 130), ("TERM", 143)] {
            let folder = folder(&format!("outputs-{signal}"));
            let out = folder.join("motion.csv");
            fs::write(&out, "before\n").expect("a file");
            let long = ["run", "fig5b", "--set", "duration=1e5", "--format", "csv"];
            let every = ["--every", "0.01", "--out", argument(&out)];
            let running = Running::start("", &[&long[..], &every].concat());
            wait_until(|| has_part(&folder));
            running.send(signal);
            let (status, said) = running.end();
            assert_eq!(status.code(), Some(code), "{said}");
            assert_eq!(said, "beadlab: stopped: no file is changed\n");
            assert_eq!(names(&folder), ["motion.csv"]);
            assert_eq!(text(&out), "before\n");
        }
    }

    #[test]
    fn studies_end_at_once_too() {
        for study in [
            &["accuracy", "fig5b"][..],
            &["stability"],
            &["figure", "all"],
        ] {
            let folder = folder(&format!("outputs-{}", study[0]));
            let out = folder.join("report");
            let running = Running::start("", &[study, &["--out", argument(&out)]].concat());
            wait_until(|| out.exists() && !has_part(&out));
            running.send("TERM");
            let (status, said) = running.end();
            assert_eq!(status.code(), Some(143), "{said}");
            assert!(said.starts_with("beadlab: stopped"), "{said}");
            assert_eq!(names(&out), Vec::<String>::new());
        }
    }

    #[test]
    fn a_file_that_a_killed_run_left_stops_no_other() {
        let folder = folder("outputs-stale");
        let out = folder.join("out.txt");
        // The shell has the number that the program will have.
        let stale = folder.join(".out.txt.");
        let first = format!("echo stale > '{}'$$.part;", argument(&stale));
        let running = Running::start(&first, &["run", "fig1b", "--out", argument(&out)]);
        let id = running.0.id();
        let (status, said) = running.end();
        assert!(status.success() && said.is_empty(), "{said}");
        assert_eq!(
            names(&folder),
            [format!(".out.txt.{id}.part"), "out.txt".into()]
        );
        assert!(text(&out).contains("eps_eff"));
    }

    /// Only Linux tells a program what is ignored.
    #[cfg(target_os = "linux")]
    #[test]
    fn signals_that_are_ignored_from_the_start_end_nothing() {
        let folder = folder("outputs-ignored");
        let ignore = "trap '' INT HUP;";
        let out = folder.join("out.txt");
        let short = ["run", "fig5b", "--set", "duration=0.5", "--out"];
        let running = Running::start(ignore, &[&short[..], &[argument(&out)]].concat());
        wait_until(|| has_part(&folder));
        running.send("INT");
        running.send("HUP");
        let (status, said) = running.end();
        assert!(status.success() && said.is_empty(), "{said}");
        assert!(text(&out).contains("h_cm_mean"));

        let rows = folder.join("rows.csv");
        let sweep = ["sweep", "fig1b", "--over", "steps_per_contact=5000:9000:40"];
        let running = Running::start(ignore, &[&sweep[..], &["--out", argument(&rows)]].concat());
        wait_until(|| fs::read_to_string(&rows).is_ok_and(|text| text.lines().count() > 12));
        running.send("HUP");
        running.send("INT");
        let (status, said) = running.end();
        assert!(status.success() && said.is_empty(), "{said}");
        let whole = |line: &&str| line.ends_with(',') && !line.starts_with('#');
        assert_eq!(text(&rows).lines().filter(whole).count(), 40);
    }
}
