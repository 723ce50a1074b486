//! The `linkgram` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    linkgram::cli::run()
}
