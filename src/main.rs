//! Arguments in, exit code out.

fn main() -> std::process::ExitCode {
    beadlab::commands::main(std::env::args_os())
}
