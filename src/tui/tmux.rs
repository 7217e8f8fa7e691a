//! tmux, between the program and the terminals that show it.

use std::process::{Command, Stdio};

/// Keeps the pane of this program open to questions, which tmux passes on only where the pane
/// allows it; as it was when dropped.
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

/// What the terminal that shows this pane calls itself; tmux calls itself `screen` on all.
pub fn terminal() -> Option<String> {
    std::env::var_os("TMUX")?;
    let name = tmux(&["display-message", "-p", "#{client_termname}"])?;
    Some(name.trim().to_owned()).filter(|name| !name.is_empty())
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
