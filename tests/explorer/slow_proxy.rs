//! A slow link: one loopback port forwarded to another.

use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};

/// Lets so many bytes a second through in each direction, so late, once it is slow.
pub struct SlowProxy {
    pub port: u16,
    slow: Arc<AtomicBool>,
}

impl SlowProxy {
    /// Forwards connections to the port `to` on loopback.
    pub fn start(to: u16, rate: u16, late: Duration) -> SlowProxy {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port is to be had");
        let port = listener.local_addr().expect("it has an address").port();
        let slow = Arc::new(AtomicBool::new(false));
        let shared = Arc::clone(&slow);
        thread::spawn(move || {
            for here in listener.incoming().flatten() {
                let there = TcpStream::connect(("127.0.0.1", to)).expect("sshd listens");
                for (from, to) in [(&here, &there), (&there, &here)] {
                    let (from, to) = (from.try_clone(), to.try_clone());
                    let (from, to) = (from.expect("a file"), to.expect("a file"));
                    let slow = Arc::clone(&shared);
                    thread::spawn(move || forward(from, to, rate, late, &slow));
                }
            }
        });
        SlowProxy { port, slow }
    }

    pub fn slow_down(&self) {
        self.slow.store(true, Ordering::SeqCst);
    }
}

fn forward(mut from: TcpStream, mut to: TcpStream, rate: u16, late: Duration, slow: &AtomicBool) {
    let (line, end) = channel::<(Instant, Vec<u8>)>();
    thread::spawn(move || {
        let _ = to.set_nodelay(true);
        for (due, bytes) in end {
            thread::sleep(due.saturating_duration_since(Instant::now()));
            if to.write_all(&bytes).is_err() {
                return;
            }
        }
        let _ = to.shutdown(Shutdown::Write);
    });
    let mut free = Instant::now();
    let mut buffer = [0; 16_384];
    loop {
        let is_slow = slow.load(Ordering::SeqCst);
        let most = if is_slow {
            usize::from(rate / 20).clamp(1, 1448)
        } else {
            buffer.len()
        };
        let Ok(count @ 1..) = from.read(&mut buffer[..most]) else {
            return;
        };
        free = free.max(Instant::now());
        let mut due = free;
        if is_slow {
            free += Duration::from_secs_f64(count as f64 / f64::from(rate));
            due = free + late;
        }
        if line.send((due, buffer[..count].to_vec())).is_err() {
            return;
        }
        thread::sleep(free.saturating_duration_since(Instant::now()));
    }
}
