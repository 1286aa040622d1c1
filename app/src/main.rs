//! nbrdf: measured materials as 32 numbers.

fn main() -> std::process::ExitCode {
    nbrdf::cli::run()
}
