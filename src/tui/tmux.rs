//! tmux passes questions on to the terminals that show it only where its pane allows it.

use std::process::{Command, Stdio};

/// Keeps the pane of this program open to questions; as it was when dropped.
#[derive(Debug)]
pub struct Passage(());

impl Passage {
    /// Allows this pane to ask the terminals behind it. None where it already may, and where
    /// tmux does not answer or knows no such option: older ones pass everything on.
    pub fn open() -> Option<Passage> {
        let set = tmux(&["show-options", "-p", "-v", "allow-passthrough"])?;
        if !set.trim().is_empty() {
            return None;
        }
        tmux(&["set-option", "-p", "allow-passthrough", "on"]).map(|_| Passage(()))
    }
}

impl Drop for Passage {
    fn drop(&mut self) {
        tmux(&["set-option", "-p", "-u", "allow-passthrough"]);
    }
}

/// What tmux answers to a command about this pane.
fn tmux(words: &[&str]) -> Option<String> {
    let mut command = Command::new("tmux");
    command.arg(words[0]).args(&words[1..2]);
    if let Some(pane) = std::env::var_os("TMUX_PANE") {
        command.arg("-t").arg(pane);
    }
    let output = command
        .args(&words[2..])
        .stdin(Stdio::null())
        .output()
        .ok()?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    output.status.success().then_some(said)
}
