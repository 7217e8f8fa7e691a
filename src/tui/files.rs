//! Files that are written into a folder, each of a new name.

use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::Path;

use super::update::NewFile;

/// So many numbers are tried.
const NUMBERS: u32 = 1000;

/// Why files of a number are not there.
enum Trouble {
    /// One of the names is taken.
    Taken,
    /// One cannot be written.
    Failed(String),
}

/// A file of the first name that is free of `STEM-1.ENDING`, `STEM-2.ENDING`, ..., and the name.
///
/// # Errors
/// When there can be none, in a line.
pub(super) fn create_new(
    folder: &Path,
    stem: &str,
    ending: &str,
) -> Result<(String, File), String> {
    numbered(stem, |stem| create(folder, format!("{stem}.{ending}")))
}

/// Writes files of the first number whose names are all free; their names.
///
/// # Errors
/// When one cannot be written, in a line: then none is left.
pub(super) fn write_new(
    folder: &Path,
    stem: &str,
    files: &[NewFile],
) -> Result<Vec<String>, String> {
    numbered(stem, |stem| write_all(folder, stem, files))
}

/// Makes something of the first name for which nothing is taken.
fn numbered<T>(stem: &str, make: impl Fn(&str) -> Result<T, Trouble>) -> Result<T, String> {
    for number in 1..=NUMBERS {
        match make(&format!("{stem}-{number}")) {
            Ok(made) => return Ok(made),
            Err(Trouble::Taken) => {}
            Err(Trouble::Failed(why)) => return Err(why),
        }
    }
    Err(format!(
        "{stem}-1 to {stem}-{NUMBERS} are there: nothing is written"
    ))
}

fn create(folder: &Path, name: String) -> Result<(String, File), Trouble> {
    match File::create_new(folder.join(&name)) {
        Ok(file) => Ok((name, file)),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(Trouble::Taken),
        Err(error) => Err(Trouble::Failed(format!("{name}: {error}"))),
    }
}

/// Writes all files that are called so but for their endings, or none.
fn write_all(folder: &Path, stem: &str, files: &[NewFile]) -> Result<Vec<String>, Trouble> {
    let mut names = Vec::new();
    for NewFile { ending, text } in files {
        let created = create(folder, format!("{stem}.{ending}"));
        let written = created.and_then(|(name, mut file)| {
            let written = file.write_all(text.as_bytes());
            let failed = |error| Trouble::Failed(format!("{name}: {error}"));
            names.push(name.clone());
            written.map_err(failed)
        });
        if let Err(trouble) = written {
            for made in &names {
                // What cannot be removed either is at least told of.
                let _ = fs::remove_file(folder.join(made));
            }
            return Err(trouble);
        }
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder of its own for a test, which is gone with it.
    struct Folder(std::path::PathBuf);

    impl Folder {
        fn new(name: &str) -> Folder {
            let name = format!("beadlab-{name}-{}", std::process::id());
            let path = std::env::temp_dir().join(name);
            fs::create_dir_all(&path).expect("a folder is to be had");
            Folder(path)
        }

        fn holds(&self, name: &str) -> Option<String> {
            fs::read_to_string(self.0.join(name)).ok()
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn pair(text: &str) -> [NewFile; 2] {
        ["svg", "csv"].map(|ending| NewFile {
            ending,
            text: format!("{text} as {ending}"),
        })
    }

    #[test]
    fn files_that_belong_together_have_one_new_number() {
        let folder = Folder::new("numbers");
        let write = |text| write_new(&folder.0, "fig5b", &pair(text));
        assert_eq!(
            write("a"),
            Ok(vec!["fig5b-1.svg".into(), "fig5b-1.csv".into()])
        );
        assert_eq!(
            write("b"),
            Ok(vec!["fig5b-2.svg".into(), "fig5b-2.csv".into()])
        );
        // One of the names is somebody else's.
        fs::write(folder.0.join("fig5b-3.csv"), "mine").expect("it is written");
        assert_eq!(
            write("c"),
            Ok(vec!["fig5b-4.svg".into(), "fig5b-4.csv".into()])
        );
        for (name, text) in [
            ("fig5b-1.svg", Some("a as svg")),
            ("fig5b-2.csv", Some("b as csv")),
            ("fig5b-3.csv", Some("mine")),
            ("fig5b-3.svg", None),
            ("fig5b-4.csv", Some("c as csv")),
        ] {
            assert_eq!(folder.holds(name).as_deref(), text, "{name}");
        }
    }

    #[test]
    fn what_cannot_be_written_is_told_in_a_line() {
        let folder = Folder::new("refused");
        let nowhere = folder.0.join("nowhere");
        let why = write_new(&nowhere, "fig5b", &pair("a")).expect_err("there is no folder");
        assert!(why.starts_with("fig5b-1.svg: ") && why.lines().count() == 1);
    }
}
