//! Arguments, progress and exit status.
//!
//! Exit status: 0 fine · 1 a check did not hold, or an asked quantity is indeterminate · 2 bad input or
//! usage. Results go to stdout, diagnostics to stderr.
//!
//! **Architecture Invariant:** everything that a library user needs is in the library; this room only
//! reads arguments and files, calls it, and prints.

mod arguments;
mod check;
mod draw;
mod exam;
mod golden;
mod grade;
mod help;
mod new;
mod solve;
mod structure;
mod sweep;
mod tradeoff;
mod watch;

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use crate::files::{self, FileError};
use crate::scene::{Diagnostic, Scene};
use crate::sheet::Language;
use crate::terminal;

/// Draws and checks graphical solutions of planar mechanisms.
#[derive(Debug, Parser)]
#[command(
    name = "linkgram",
    version,
    about,
    arg_required_else_help = true,
    disable_help_subcommand = true,
    after_help = "`linkgram help` lists topics to look up: scene, quantities, forces, formats, grading, exams, sweeps, live, golden, accuracy."
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw the solution sheet of a scene, or single figures of it
    Draw(draw::Job),
    /// Draw at once and after every change of the scene, until Ctrl-C; an error keeps the old files
    Watch(draw::Job),
    /// Print the asked quantities, graphical beside analytic
    Solve(solve::Job),
    /// Check scenes: graphical against analytic, and both against what was published
    Check(check::Job),
    /// Grade a solution that somebody drew or calculated by hand: what is right, what follows rightly from an
    /// earlier fault, and which typical mistake explains the rest
    Grade(grade::Job),
    /// Report links, pairs, mobility, groups, Grashof class and dead positions
    Structure(structure::Job),
    /// Move a mechanism through the range of its first input, or through time: limits, dead positions, strokes, extremes;
    /// tables and diagrams
    Sweep(sweep::Job),
    /// Compare scenes with the figures that were blessed, or bless what is drawn now
    Golden {
        #[command(subcommand)]
        action: golden::Action,
    },
    /// Speed against accuracy: error and time of scenes by every setting (arithmetic, record, sweeps, hand,
    /// the independent solver), against a reference of 75 digits
    Tradeoff(tradeoff::Job),
    /// Draw variants of a scene for an examination: questions, solutions, a key and question banks
    Exam(exam::Job),
    /// List the mechanism catalogue, or write a ready scene of a kind
    New {
        /// The kind
        kind: Option<String>,
    },
    /// Print a topic (scene, quantities, forces, formats, grading, exams, sweeps, live, golden, accuracy), or the options of a command
    Help {
        /// The topic or the command; all of them are listed without it
        topic: Vec<String>,
    },
    /// Print the JSON Schema of a scene, or of answers for `grade`
    Schema {
        /// Of what
        #[arg(value_enum, default_value_t = SchemaOf::Scene)]
        of: SchemaOf,
    },
}

/// What a JSON Schema is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum SchemaOf {
    Scene,
    Answers,
    Live,
}

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Fine,
    DoesNotHold,
}

/// What stands on stderr before exit 2: bad input or usage; or before exit 1, where a result is not confirmed.
#[derive(Debug)]
struct Failure {
    told: String,
    code: u8,
}

/// Bad input or usage.
#[expect(non_snake_case, reason = "it makes the failure that it is named after")]
fn Failure(told: String) -> Failure {
    Failure { told, code: 2 }
}

impl Failure {
    /// A result that is not confirmed.
    fn unconfirmed(told: String) -> Self {
        Self { told, code: 1 }
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Failure(error.to_string())
    }
}

impl From<Diagnostic> for Failure {
    fn from(diagnostic: Diagnostic) -> Self {
        Failure(diagnostic.to_string())
    }
}

/// The language of this tag.
fn language(tag: &str) -> Result<Language, Failure> {
    Language::from_tag(tag).ok_or_else(|| {
        Failure(format!("language {tag} is not available; known: {}", Language::tags().join(", ")))
    })
}

/// Runs the command with the process's arguments.
#[must_use]
pub fn run() -> ExitCode {
    outlive_full_files();
    run_with(std::env::args_os())
}

/// Where a file may not grow further the system would end the process, with half a file left: heard as a signal, it
/// is an error of writing like any other.
#[cfg(unix)]
fn outlive_full_files() {
    let heard = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
    // Without it nothing is worse than before.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, heard);
}

#[cfg(not(unix))]
const fn outlive_full_files() {}

/// Runs the command with the given arguments, the program's name first.
#[must_use]
pub fn run_with(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are not errors; clap knows where each goes.
            let told = error.to_string();
            let plain = terminal::lines(&told);
            // A name of a file may stand among the arguments.
            let printed = if plain == told {
                error.print().and_then(|()| std::io::stdout().flush())
            } else {
                std::io::stderr().write_all(plain.as_bytes())
            };
            if error.use_stderr() {
                return ExitCode::from(2);
            }
            return match printed {
                Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                    let _ = writeln!(std::io::stderr(), "error: standard output: {error}");
                    ExitCode::from(2)
                }
                _ => ExitCode::SUCCESS,
            };
        }
    };
    let ending = match arguments.command {
        Command::Draw(job) => draw::run(&job),
        Command::Watch(job) => watch::run(&job),
        Command::Solve(job) => solve::run(&job),
        Command::Check(job) => check::run(&job),
        Command::Grade(job) => grade::run(&job),
        Command::Structure(job) => structure::run(&job),
        Command::Sweep(job) => sweep::run(&job),
        Command::Golden { action } => golden::run(&action),
        Command::Tradeoff(job) => tradeoff::run(&job),
        Command::Exam(job) => exam::run(&job),
        Command::New { kind } => new::run(kind.as_deref()),
        Command::Help { topic } => help::run(&topic),
        Command::Schema { of } => schema(of),
    };
    match ending {
        Ok(Ending::Fine) => ExitCode::SUCCESS,
        Ok(Ending::DoesNotHold) => ExitCode::from(1),
        Err(Failure { told, code }) => {
            let _ = writeln!(std::io::stderr(), "error: {}", terminal::lines(&told));
            ExitCode::from(code)
        }
    }
}

fn schema(of: SchemaOf) -> Result<Ending, Failure> {
    let schema = match of {
        SchemaOf::Scene => crate::scene::schema(),
        SchemaOf::Answers => crate::grade::schema(),
        SchemaOf::Live => crate::live::schema(),
    };
    let text = serde_json::to_string_pretty(&schema).map_err(|error| Failure(error.to_string()))?;
    print(&(text + "\n"))?;
    Ok(Ending::Fine)
}

/// Why a figure could not be written in its format; a character that cannot be set is shown in the scene.
fn not_written(scene: &Scene, error: &crate::render::RenderError) -> Failure {
    use crate::render::{RenderError, tex::TexError};
    match error {
        RenderError::Tex(TexError::Character { character, .. }) => {
            match scene.source.complain_of_character(*character, error.to_string()) {
                Some(diagnostic) => diagnostic.into(),
                None => Failure(error.to_string()),
            }
        }
        _ => Failure(error.to_string()),
    }
}

/// Writes text, or JSON, to stdout; a reader who hung up is no error.
fn print(text: &str) -> Result<(), Failure> {
    print_bytes(terminal::lines(text).as_bytes())
}

/// Writes a figure to stdout, byte by byte.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Fewer things than this need no progress bar.
const MANY: usize = 50;

/// A bar on stderr, where somebody is looking and there is much to do.
fn progress(count: usize, what: &str) -> ProgressBar {
    if count < MANY || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template(&format!("{{bar:40}} {{pos}}/{{len}} {what}, {{eta}} left"))
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(count as u64).with_style(style)
}

fn read_scene(path: &std::path::Path) -> Result<(String, Scene), Failure> {
    let (file, text) = files::read(path)?;
    let scene = crate::scene::read(&text, &file)?;
    Ok((file, scene))
}

/// An error of a later room, at the place in the file that it is about.
fn failure(scene: &Scene, error: &crate::solve::SolveError) -> Failure {
    crate::report::diagnose(scene, error).into()
}
