#!/usr/bin/env bash
# Who answers a status question (CSI 5 n) inside tmux and GNU screen?
#
# A good guess: the terminal, once it has read all that was sent before. So a program that
# sends its next frame only when that answer has come cannot run ahead of a slow link. On a
# bare terminal it is so.
#
# What happens (tmux 3.3a-3 and screen 4.9.0-4 of Debian 12; 2026-11-28): tmux and screen
# answer themselves, at once, while the terminal has not read one byte of the frame. A program
# that paces itself by the answers learns nothing of the link beyond. The question must be
# wrapped to reach the terminal (tmux: DCS "tmux;" with ESC doubled; screen: a bare DCS); the
# answer then finds its way back. But tmux passes it on only with `allow-passthrough on`; by
# default it drops the question, and no answer ever comes.
#
# What it means: behind a multiplexer the receipts of a live view of bead columns are worth
# something only if wrapped, and a wrapped one needs a time limit. beadlab wraps its own, sets
# tmux's option for its pane, and gives up a receipt that does not come.
# The terminal here is a pseudo-terminal that stops reading for three seconds just before the
# frame and the question are sent. Needs Debian 12 (amd64, after apt-get update) and python3.
set -euo pipefail
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
apt-get download -qq -o APT::Sandbox::User=root tmux=3.3a-3 screen=4.9.0-4 \
    libevent-core-2.1-7=2.1.12-stable-8 libutempter0=1.2.1-3
for package in *.deb; do dpkg -x "$package" .; done
mkdir -m 700 sockets
echo 'set -g allow-passthrough on' > on.conf
touch off.conf
unset TMUX STY
export TERM=xterm LC_ALL=C.UTF-8 SCREENDIR="$dir/sockets" \
    LD_LIBRARY_PATH="$dir/usr/lib/x86_64-linux-gnu"
cat > ask.py <<'PY'
import os, select, sys, time, tty
question, name = sys.argv[1].encode().decode("unicode_escape").encode(), sys.argv[2]
tty.setraw(0)
time.sleep(1)
os.mkdir(name + ".ready")
time.sleep(0.5)
start, heard = time.time(), b""
os.write(1, b"a frame of the column " * 20 + question)
while b"\x1b[0n" not in heard and time.time() < start + 8:
    if select.select([0], [], [], 0.1)[0]:
        heard += os.read(0, 100)
open(name, "w").write(f"after {time.time() - start:.1f} s" if b"\x1b[0n" in heard else "never")
PY
cat > terminal.py <<'PY'
import os, pty, select, sys, time
PLAIN, TMUX, SCREEN = r"\x1b[5n", r"\x1bPtmux;\x1b\x1b[5n\x1b\\", r"\x1bP\x1b[5n\x1b\\"
def answered(name, question, *inside):
    pid, line = pty.fork()
    if pid == 0:
        program = [*inside, sys.executable, "ask.py", question, name]
        os.execv(program[0], program)
    slept = False
    while True:
        if not slept and (slept := os.path.exists(name + ".ready")):
            time.sleep(3)
        try:
            if select.select([line], [], [], 0.1)[0] and b"\x1b[5n" in os.read(line, 9999):
                os.write(line, b"\x1b[0n")
        except OSError:  # all on the other side have ended
            break
    os.waitpid(pid, 0)
    when = open(name).read()
    print(f"{name:32} answered {when}", flush=True)
    return float(when.split()[1]) if when != "never" else float("inf")
tmux = lambda config: ["usr/bin/tmux", "-S", "sockets/" + config, "-f", config, "new-session"]
screen = ["usr/bin/screen", "-c", "/dev/null"]
seen = [2 < answered("bare terminal", PLAIN) < 8,
        answered("tmux, plain", PLAIN, *tmux("on.conf")) < 2,
        2 < answered("tmux, wrapped, passthrough on", TMUX, *tmux("on.conf")) < 8,
        answered("tmux, wrapped, default options", TMUX, *tmux("off.conf")) > 8,
        answered("screen, plain", PLAIN, *screen) < 2,
        2 < answered("screen, wrapped", SCREEN, *screen) < 8]
sys.exit(0 if all(seen) else "no longer what the text says")
PY
python3 terminal.py
