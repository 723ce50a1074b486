//! Arguments, progress and exit status.
//!
//! Exit status: 0 fine · 1 a check did not hold, or an asked quantity is indeterminate · 2 bad input or
//! usage. Results go to stdout, diagnostics to stderr.
//!
//! **Architecture Invariant:** everything that a library user needs is in the library; this room only
//! reads arguments and files, calls it, and prints.

mod check;
mod draw;
mod exam;
mod golden;
mod grade;
mod help;
mod new;
mod reversals;
mod solve;
mod structure;
mod sweep;
mod tradeoff;
mod watch;

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use crate::drawing::Kind;
use crate::files::{self, FileError};
use crate::scene::{Diagnostic, Scene};
use crate::sheet::Language;
use crate::solve::{Arithmetic, Hand, Settings};
use crate::sweep::Over;
use crate::terminal;

/// Draws and checks graphical solutions of planar mechanisms.
#[derive(Debug, Parser)]
#[command(
    name = "linkgram",
    version,
    about,
    arg_required_else_help = true,
    disable_help_subcommand = true,
    after_help = "`linkgram help` lists topics to look up: scene, quantities, formats, grading, exams, sweeps, live, golden, accuracy."
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Args)]
struct DrawArguments {
    /// The scene file; - for standard input
    scene: PathBuf,
    /// Where to write; the ending chooses the format (.svg, .png, .pdf, .tex, .json, .html); may be given
    /// several times: all files are written, or none. Without it the figure goes to standard output
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// A single figure instead of the sheet: skeleton, velocity, acceleration, steps, results
    #[arg(long, value_name = "NAME")]
    figure: Vec<String>,
    /// What to draw: the question without its answers, the solution, or its steps one by one
    #[arg(long = "as", value_name = "KIND", value_enum, default_value_t = Kind::Solution)]
    kind: Kind,
    /// With --as steps: one SVG that plays them, without a script; an HTML page plays by itself, without this option
    #[arg(long)]
    play: bool,
    /// Paper: A0 to A6, letter or legal, with " landscape" after it if wanted
    #[arg(long, value_name = "SIZE")]
    paper: Option<String>,
    /// Language of the sheet: en, ar, ar-x-ajala, fa; of a page several: en,ar,fa
    #[arg(long, value_name = "LANG")]
    lang: Option<String>,
    /// Resolution of a PNG: 150 where nothing is said
    #[arg(long, value_name = "DPI", allow_negative_numbers = true)]
    dpi: Option<f32>,
    /// Arithmetic of the drawing board: f32, f64, or dd (double-double, 31 digits)
    #[arg(long, value_name = "ARITHMETIC", default_value = "f64", value_parser = parse_arithmetic)]
    arith: Arithmetic,
    /// Colours: mono, colour or dark; what the scene says, or mono
    #[arg(long, value_name = "NAME")]
    theme: Option<String>,
    /// Text of an SVG: embed (with the glyphs that it uses), live (for those who have the typefaces) or outline
    /// (paths); embed where nothing is said
    #[arg(long, value_name = "KIND")]
    text: Option<String>,
    /// Format on standard output: svg, png, pdf, tex, json or html
    #[arg(long, value_name = "FORMAT")]
    format: Option<String>,
    /// Other positions, dashed on the skeleton: places of the input, such as 60,90 or "1 rad,2 rad"
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    positions: Vec<String>,
    /// The other assembly, dashed on the skeleton
    #[arg(long)]
    other_assembly: bool,
    /// Draw it even where the independent solver does not confirm it, with a note that says so
    #[arg(long)]
    unchecked: bool,
    /// Of a page (.html): what moves it, the input or time
    #[arg(long, value_enum, default_value_t = Against::Input)]
    against: Against,
    /// Of a page: from this place of the input, in the scene's unit
    #[arg(long, value_name = "AT", allow_hyphen_values = true)]
    from: Option<f64>,
    /// Of a page: to this place of the input
    #[arg(long, value_name = "AT", allow_hyphen_values = true)]
    to: Option<f64>,
}

impl DrawArguments {
    fn job(self) -> draw::Job {
        draw::Job {
            scene: self.scene,
            output: self.output,
            figure: self.figure,
            kind: self.kind,
            play: self.play,
            paper: self.paper,
            lang: self.lang,
            dpi: self.dpi,
            theme: self.theme,
            text: self.text,
            format: self.format,
            positions: self.positions,
            other_assembly: self.other_assembly,
            settings: Settings { arithmetic: self.arith, unchecked: self.unchecked },
            over: self.against.over(),
            from: self.from,
            to: self.to,
        }
    }
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw the solution sheet of a scene, or single figures of it
    Draw(DrawArguments),
    /// Draw at once and after every change of the scene, until Ctrl-C; an error keeps the old files
    Watch(DrawArguments),
    /// Print the asked quantities, graphical beside analytic
    Solve {
        /// The scene file; - for standard input
        scene: PathBuf,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
        /// Say which steps the asked quantities needed, and which were left out
        #[arg(long)]
        explain: bool,
        /// What a draughtsman would get whose lengths and readings slip by up to this many millimetres of
        /// paper, and whose directions by this many degrees
        #[arg(long, value_name = "MM,DEG", allow_hyphen_values = true, value_parser = parse_hand)]
        hand: Option<Hand>,
        /// Arithmetic of the drawing board: f32, f64, or dd (double-double, 31 digits)
        #[arg(long, value_name = "ARITHMETIC", default_value = "f64", value_parser = parse_arithmetic)]
        arith: Arithmetic,
    },
    /// Check scenes: graphical against analytic, and both against what was published
    Check {
        /// Scene files, or folders of them; - for standard input
        #[arg(required = true)]
        paths: Vec<PathBuf>,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
        /// Allowed deviation of published values where the scene states none
        #[arg(long, value_name = "PERCENT", default_value = "5%", allow_hyphen_values = true, value_parser = parse_percent)]
        tolerance: f64,
        /// Arithmetic of the drawing board: f32, f64, or dd (double-double, 31 digits)
        #[arg(long, value_name = "ARITHMETIC", default_value = "f64", value_parser = parse_arithmetic)]
        arith: Arithmetic,
    },
    /// Grade a solution that somebody drew or calculated by hand: what is right, what follows rightly from an
    /// earlier fault, and which typical mistake explains the rest
    Grade {
        /// The scene file; - for standard input
        scene: PathBuf,
        /// What was handed in: JSON, CSV or SVG (linkgram schema answers), of one or of a whole class; - for
        /// standard input. Without any: by how much each answer may be off
        answers: Vec<PathBuf>,
        /// The SVG of the drawing, instead of the one that the answers name
        #[arg(long, value_name = "FILE")]
        drawing: Option<PathBuf>,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
        /// By how many millimetres of paper lengths and readings may slip, and by how many degrees directions;
        /// 0.2mm,0.3deg where nothing is said, and for the variants of an exam what the exam was made with
        #[arg(long, value_name = "MM,DEG", allow_hyphen_values = true, value_parser = parse_hand)]
        hand: Option<Hand>,
        /// No answer may be off by a larger part of the right value; 10% where nothing is said, and for the variants of an exam what the exam was made with
        #[arg(long, value_name = "PERCENT", allow_hyphen_values = true, value_parser = parse_percent)]
        max_tolerance: Option<f64>,
        /// The answers are the examiner's own, such as a textbook's: the `tolerance` that they state counts, uncapped.
        /// Without this it does not
        #[arg(long)]
        trust_answers: bool,
        /// Language of the reports: en, ar, ar-x-ajala, fa; that of the scene's sheet where nothing is said
        #[arg(long, value_name = "LANG")]
        lang: Option<String>,
        /// Where to write the student's polygons over the right ones, every fault circled; the ending chooses the
        /// format, .html is a page with report and figure. A folder: a page for each, marks.csv and faults.csv
        #[arg(short, long, value_name = "FILE|DIR")]
        output: Option<PathBuf>,
    },
    /// Report links, pairs, mobility, groups, Grashof class and dead positions
    Structure {
        /// The scene file; - for standard input
        scene: PathBuf,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Move a mechanism through the range of its first input, or through time: limits, dead positions, strokes, extremes;
    /// tables and diagrams
    Sweep {
        /// The scene file; - for standard input
        scene: PathBuf,
        /// Equal steps over the range; one position more than steps
        #[arg(long, value_name = "N", conflicts_with = "tolerance", value_parser = clap::value_parser!(u32).range(1..=i64::from(crate::limits::STEPS)))]
        steps: Option<u32>,
        /// As many positions as it takes for no column to stray from the line between two of them by more
        /// than this part of its range, except where a column grows without end
        #[arg(long, value_name = "PERCENT", allow_hyphen_values = true, value_parser = parse_straying)]
        tolerance: Option<f64>,
        /// Where to begin, in the scene's unit of the input or of time; a whole turn where nothing is said
        #[arg(long, value_name = "PLACE", allow_negative_numbers = true, value_parser = parse_place, requires = "to")]
        from: Option<f64>,
        /// Where to end
        #[arg(long, value_name = "PLACE", allow_negative_numbers = true, value_parser = parse_place, requires = "from")]
        to: Option<f64>,
        /// What to go over: the first input with the rates as they are, or time, in which every input moves from
        /// the scene's instant on with constant acceleration
        #[arg(long, value_enum, default_value_t = Against::Input)]
        against: Against,
        /// A bound for every number of the tables
        #[arg(long)]
        bounds: bool,
        /// Writes what the independent solver does not confirm, with a note that says so
        #[arg(long)]
        unchecked: bool,
        /// Whether pairs rub, in a scene that says how
        #[arg(long, value_enum, default_value_t = Friction::On)]
        friction: Friction,
        /// Only these of the asked quantities, such as v(B),a(D)
        #[arg(long, value_name = "NAMES")]
        only: Option<String>,
        /// Language of the diagrams: en, ar, ar-x-ajala, fa
        #[arg(long, value_name = "LANG")]
        lang: Option<String>,
        /// Where to write; the ending chooses what: .csv and .json are tables, .svg, .png, .pdf and .tex diagrams.
        /// What happens on the way, on stdout, without it
        #[arg(short, long, value_name = "FILE")]
        output: Vec<PathBuf>,
    },
    /// Compare scenes with the figures that were blessed, or bless what is drawn now
    Golden {
        #[command(subcommand)]
        action: GoldenAction,
    },
    /// Speed against accuracy: error and time of scenes by every setting (arithmetic, record, sweeps, hand,
    /// the independent solver), against a reference of 75 digits
    Tradeoff {
        /// Scene files, or folders of them; - for standard input
        #[arg(required = true)]
        paths: Vec<PathBuf>,
        /// How often everything is measured
        #[arg(long, value_name = "N", default_value_t = 21, value_parser = clap::value_parser!(u16).range(1..=10_000))]
        passes: u16,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
        /// A picture of error over time (.svg, .png or .pdf), besides the table on standard output
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Draw variants of a scene for an examination: questions, solutions, a key and question banks
    Exam {
        /// The scene file, whose `vary` says what may change
        scene: PathBuf,
        /// How many variants; as many as there are names where it is left out
        #[arg(long, value_name = "N", required_unless_present = "names")]
        variants: Option<usize>,
        /// A list of names, one a line: names.csv says which variant is whose
        #[arg(long, value_name = "FILE")]
        names: Option<PathBuf>,
        /// One PDF of all questions, then all solutions, for each language
        #[arg(long)]
        booklet: bool,
        /// No answer may be off by a larger part of its value; results that a careful hand may miss by more are
        /// flagged
        #[arg(long, value_name = "PERCENT", default_value = "10%", allow_hyphen_values = true, value_parser = parse_percent)]
        max_tolerance: f64,
        /// What becomes of answers that a careful hand may miss by more: pass-over (such variants), leave-out (what is
        /// so in the scene itself is not asked) or ask (the key says which); where nothing is said pass-over, and ask where that
        /// leaves too few variants
        #[arg(long, value_name = "WHAT")]
        loose: Option<String>,
        /// The seed: the same seed gives the same variants
        #[arg(long, value_name = "S", default_value_t = 1)]
        seed: u64,
        /// The folder to write into; a run that was interrupted is taken up again
        #[arg(short, long, value_name = "DIR")]
        output: PathBuf,
        /// No lines or arcs of a solution cross at a smaller angle
        #[arg(long, value_name = "ANGLE", default_value = "15deg", value_parser = parse_crossing)]
        flattest: f64,
        /// The students' hand, by which tolerances are found: slips in millimetres and degrees
        #[arg(long, value_name = "MM,DEG", default_value = "0.2mm,0.3deg", value_parser = parse_hand)]
        hand: Hand,
        /// Format of the sheets: svg or pdf
        #[arg(long, value_name = "FORMAT")]
        format: Option<String>,
        /// Text of SVG sheets and of the banks' figures: outline (paths), embed (with the glyphs that it uses) or live;
        /// where nothing is said, sheets are outlined and figures of banks embed
        #[arg(long, value_name = "KIND")]
        text: Option<String>,
        /// Languages: en, ar, ar-x-ajala, fa; several with commas
        #[arg(long, value_name = "LANG")]
        lang: Vec<String>,
        /// How many variants are worked on at once; all processors where it is left out. It changes nothing else
        #[arg(long, value_name = "N")]
        jobs: Option<usize>,
    },
    /// List the mechanism catalogue, or write a ready scene of a kind
    New {
        /// The kind
        kind: Option<String>,
    },
    /// Print a topic (scene, quantities, formats, grading, exams, sweeps, golden, accuracy), or the options of a command
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

/// Whether pairs rub.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Friction {
    /// As the scene says.
    On,
    /// Nothing rubs.
    Off,
}

/// What a JSON Schema is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum SchemaOf {
    Scene,
    Answers,
    Live,
}

/// What a sweep goes over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Against {
    Input,
    Time,
}

impl Against {
    const fn over(self) -> Over {
        match self {
            Self::Input => Over::Input,
            Self::Time => Over::Time,
        }
    }
}

#[derive(Debug, Subcommand)]
enum GoldenAction {
    /// Draw every scene of a folder and tell what differs from its golden: a changed number from other
    /// content, and both from a cosmetic change
    Check {
        /// The folder: scenes with their goldens beside them, or goldens with a suite.json
        folder: PathBuf,
        /// Only the goldens of these names
        names: Vec<String>,
        /// Write a page that shows expected, actual and difference: one HTML file
        #[arg(long, value_name = "FILE")]
        report: Option<PathBuf>,
        /// Write the result as JUnit's XML, for the server that runs tests
        #[arg(long, value_name = "FILE")]
        junit: Option<PathBuf>,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Make what is drawn now the goldens
    Bless {
        /// The folder: scenes with their goldens beside them, or goldens with a suite.json
        folder: PathBuf,
        /// Only the goldens of these names
        names: Vec<String>,
    },
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

fn parse_arithmetic(text: &str) -> Result<Arithmetic, String> {
    match text {
        "f32" => Ok(Arithmetic::Single),
        "f64" => Ok(Arithmetic::Double),
        "dd" => Ok(Arithmetic::DoubleDouble),
        _ => Err("expected f32, f64 or dd".to_owned()),
    }
}

/// `0.2mm,0.3deg`, with or without the units.
fn parse_hand(text: &str) -> Result<Hand, String> {
    let wrong = || "expected a slip in millimetres and one in degrees, such as 0.2mm,0.3deg".to_owned();
    let (length, angle) = text.split_once(',').ok_or_else(wrong)?;
    let part = |text: &str, unit: &str, most: f64| {
        let text = text.trim();
        let digits = text.strip_suffix(unit).unwrap_or(text).trim_end();
        match digits.parse::<f64>() {
            Ok(value) if (0.0..=most).contains(&value) => Ok(value),
            Ok(_) => Err(format!("a hand slips by 0 to {most} {unit}")),
            Err(_) => Err(wrong()),
        }
    };
    Ok(Hand { length: part(length, "mm", 10.0)?, angle: part(angle, "deg", 10.0)?.to_radians() })
}

/// `15deg`, with or without the unit; radians.
fn parse_crossing(text: &str) -> Result<f64, String> {
    match text.trim().trim_end_matches("deg").trim_end().parse::<f64>() {
        // Beyond it hardly a scene has all its crossings.
        Ok(degrees) if (0.0..=60.0).contains(&degrees) => Ok(degrees.to_radians()),
        _ => Err("expected an angle from 0deg to 60deg, such as 15deg".to_owned()),
    }
}

fn parse_percent(text: &str) -> Result<f64, String> {
    let (number, factor) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        // A bare 5 would be 500 %, which nobody means.
        Ok(value) if (0.0..=1.0).contains(&(value * factor)) => Ok(value * factor),
        _ => Err("expected a percentage up to 100% such as 5%, or a part such as 0.05".to_owned()),
    }
}

/// A tolerance of sampling.
fn parse_straying(text: &str) -> Result<f64, String> {
    match parse_percent(text)? {
        // Straight lines come so near with some hundred thousand positions; nearer a table is no help.
        part if part < LEAST_STRAYING => {
            Err("the least tolerance is 1e-7%; for more positions give --steps".to_owned())
        }
        part => Ok(part),
    }
}

/// The least tolerance of sampling, as a part of a column's range.
const LEAST_STRAYING: f64 = 1e-9;

fn parse_place(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(place) if place.is_finite() => Ok(place),
        _ => Err("expected a number, in the scene's unit of the input".to_owned()),
    }
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
        Command::Draw(arguments) => draw::run(&arguments.job()),
        Command::Watch(arguments) => watch::run(&arguments.job()),
        Command::Solve { scene, json, explain, hand, arith } => {
            let settings = Settings { arithmetic: arith, ..Settings::default() };
            solve::run(&solve::Job { scene, json, explain, hand, settings })
        }
        Command::Check { paths, json, tolerance, arith } => {
            check::run(&paths, json, tolerance, Settings { arithmetic: arith, ..Settings::default() })
        }
        Command::Grade {
            scene,
            answers,
            drawing,
            json,
            hand,
            max_tolerance,
            trust_answers,
            lang,
            output,
        } => grade::run(&grade::Job {
            scene,
            answers,
            drawing,
            json,
            hand,
            max_tolerance,
            trust_answers,
            lang,
            output,
        }),
        Command::Structure { scene, json } => structure::run(&scene, json),
        Command::Sweep {
            scene,
            steps,
            tolerance,
            from,
            to,
            against,
            bounds,
            unchecked,
            friction,
            only,
            lang,
            output,
        } => {
            let over = against.over();
            let rubs = friction == Friction::On;
            let job = sweep::Job {
                scene,
                steps,
                tolerance,
                from,
                to,
                over,
                bounds,
                unchecked,
                rubs,
                only,
                lang,
                output,
            };
            sweep::run(&job)
        }
        Command::Golden { action: GoldenAction::Check { folder, names, report, junit, json } } => {
            golden::check(&golden::Job { folder, names }, report.as_deref(), junit.as_deref(), json)
        }
        Command::Golden { action: GoldenAction::Bless { folder, names } } => {
            golden::bless(&golden::Job { folder, names })
        }
        Command::Tradeoff { paths, passes, json, output } => {
            tradeoff::run(&tradeoff::Job { paths, passes, json, output })
        }
        Command::Exam {
            scene,
            variants,
            names,
            booklet,
            max_tolerance,
            loose,
            seed,
            output,
            flattest,
            hand,
            format,
            text,
            lang,
            jobs,
        } => exam::run(&exam::Job {
            scene,
            variants,
            names,
            booklet,
            max_tolerance,
            loose,
            seed,
            output,
            flattest,
            hand,
            format,
            text,
            lang,
            jobs,
        }),
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
