//! Arguments in, exit code out.

#![deny(clippy::disallowed_methods)]

fn main() -> std::process::ExitCode {
    beadlab::commands::main(std::env::args_os())
}
