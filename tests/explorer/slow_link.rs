//! How late a key acts over a real ssh connection on a slow link, through a real sshd: it
//! takes a megabyte before any write blocks, so that nothing but the terminal's receipts can
//! keep a queue from growing.
//!
//! Needs sshd and ssh, and takes a minute:
//! `cargo test --test explorer slow_link -- --ignored --nocapture`.
use std::fs;
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::session::{Session, Setup, wait};
use crate::slow_proxy::SlowProxy;

/// An sshd of our own on loopback, with keys of its own.
struct Sshd {
    child: Child,
    folder: PathBuf,
    port: u16,
}

impl Sshd {
    fn start() -> Sshd {
        let name = format!("beadlab-slow-link-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("a folder is to be had");
        for key in ["host", "user"] {
            let made = Command::new("ssh-keygen")
                .args(["-q", "-t", "ed25519", "-N", "", "-f"])
                .arg(folder.join(key))
                .status()
                .expect("ssh-keygen is there");
            assert!(made.success());
        }
        let port = TcpListener::bind("127.0.0.1:0")
            .and_then(|free| free.local_addr())
            .expect("a port is to be had")
            .port();
        let at = folder.display();
        let settings = format!(
            "Port {port}\nListenAddress 127.0.0.1\nHostKey {at}/host\nPidFile none\n\
             StrictModes no\nAuthorizedKeysFile {at}/user.pub\n\
             PermitRootLogin prohibit-password\nUsePAM no\nPasswordAuthentication no\n\
             PrintMotd no\nPrintLastLog no\n"
        );
        fs::write(folder.join("sshd.conf"), settings).expect("it can be written");
        // Where it drops its privileges to; some systems make it only when it is a service.
        let _ = fs::create_dir_all("/run/sshd");
        let path = ["/usr/sbin/sshd", "/usr/bin/sshd", "/usr/local/sbin/sshd"]
            .into_iter()
            .find(|path| Path::new(path).exists())
            .expect("sshd is there");
        let child = Command::new(path)
            .args(["-D", "-e", "-f"])
            .arg(folder.join("sshd.conf"))
            .stderr(Stdio::null())
            .spawn()
            .expect("sshd starts");
        let sshd = Sshd {
            child,
            folder,
            port,
        };
        let answers = || TcpStream::connect(("127.0.0.1", port)).ok().map(|_| ());
        wait(answers, "sshd to answer");
        sshd
    }

    /// The explorer at the other end of a link, slow from when it starts.
    fn explore(&self, proxy: &SlowProxy) -> Session {
        let (at, go) = (self.folder.display(), self.folder.join("go"));
        let _ = fs::remove_file(&go);
        let program = env!("CARGO_BIN_EXE_beadlab");
        let wait_for_go = format!(
            "echo ready; while [ ! -e {} ]; do sleep 0.05; done; exec env LC_ALL=C.UTF-8 {program}",
            go.display()
        );
        let user = Command::new("id").arg("-un").output().expect("somebody");
        let user = String::from_utf8_lossy(&user.stdout).trim().to_owned();
        let (port, host) = (proxy.port.to_string(), format!("{user}@127.0.0.1"));
        let (identity, known) = (
            format!("{at}/user"),
            format!("UserKnownHostsFile={at}/known"),
        );
        let session = Session::start_as(&Setup {
            program: "ssh",
            arguments: &[
                "-F",
                "none",
                "-p",
                &port,
                "-i",
                &identity,
                "-o",
                "IdentitiesOnly=yes",
                "-o",
                "StrictHostKeyChecking=no",
                "-o",
                &known,
                "-o",
                "LogLevel=ERROR",
                "-t",
                &host,
                &wait_for_go,
            ],
            ..Setup::default()
        });
        wait(|| session.shows("ready").then_some(()), "the connection");
        proxy.slow_down();
        fs::write(&go, "").expect("it can be written");
        session
    }
}

impl Drop for Sshd {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// Seconds from space to "paused" on the screen, then from space until it is gone, at each
/// time after the first picture.
fn delays(sshd: &Sshd, rate: u16, way: f64, times: &[f64]) -> Vec<f64> {
    let proxy = SlowProxy::start(sshd.port, rate, Duration::from_secs_f64(way / 2.0));
    let mut session = sshd.explore(&proxy);
    wait(
        || session.shows("real time").then_some(()),
        "the first picture",
    );
    let start = Instant::now();
    let mut all = Vec::new();
    for time in times {
        let due = start + Duration::from_secs_f64(*time);
        thread::sleep(due.saturating_duration_since(Instant::now()));
        for _ in 0..2 {
            let before = session.shows("paused");
            let pressed = Instant::now();
            session.type_keys(" ");
            wait(
                || (session.shows("paused") != before).then_some(()),
                "the key to show",
            );
            all.push(pressed.elapsed().as_secs_f64());
        }
    }
    session.type_keys("q");
    session.wait_for_end();
    all
}

/// Bytes per second, the way there and back in seconds, and the longest that a key may take:
/// that way, what is left of a frame on its way, and the next frame.
#[test]
#[ignore = "needs sshd; a minute"]
fn a_key_acts_soon_on_any_link() {
    let sshd = Sshd::start();
    for (rate, way, most) in [(2_000, 0.3, 1.0), (1_200, 0.6, 2.0), (9_600, 0.1, 0.4)] {
        let delays = delays(&sshd, rate, way, &[3.0, 15.0]);
        println!("{rate} B/s, {way} s there and back: {delays:.2?} s");
        let longest = delays.iter().copied().fold(0.0, f64::max);
        // The queue of a minute without receipts was 100 s: a busy machine cannot be confused
        // with that.
        assert!(
            longest < 2.0 * most,
            "{longest} s at {rate} bytes per second"
        );
    }
}
