//! A folder that goes away with its test, and the command run in it.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

pub(crate) struct Folder(pub(crate) PathBuf);

/// What a command said.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// Nothing takes longer, even on a busy machine and hardly optimised.
const PATIENCE: Duration = Duration::from_secs(300);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-hard-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), text).unwrap();
    }

    pub(crate) fn names(&self) -> BTreeSet<String> {
        let entries = std::fs::read_dir(&self.0).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    /// Runs the command here; its standard input never ends and never says anything.
    pub(crate) fn run(&self, arguments: &[&str]) -> Ran {
        self.run_by(Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments))
    }

    pub(crate) fn run_by(&self, command: &mut Command) -> Ran {
        let command = command.current_dir(&self.0).stdin(Stdio::piped());
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let silent = child.stdin.take();
        let begun = Instant::now();
        let [out, err] = [
            Box::new(child.stdout.take().unwrap()) as Box<dyn std::io::Read + Send>,
            Box::new(child.stderr.take().unwrap()),
        ]
        .map(|mut stream| {
            std::thread::spawn(move || {
                let mut bytes = Vec::new();
                stream.read_to_end(&mut bytes).unwrap();
                String::from_utf8_lossy(&bytes).into_owned()
            })
        });
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if begun.elapsed() > PATIENCE {
                child.kill().unwrap();
                child.wait().unwrap();
                panic!("{command:?} does not end");
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        drop(silent);
        Ran { code: status.code(), out: out.join().unwrap(), err: err.join().unwrap() }
    }

    /// Runs the command and expects one message, nothing on standard output and exit status 2.
    pub(crate) fn refused(&self, arguments: &[&str]) -> String {
        let ran = self.run(arguments);
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.err);
        assert!(ran.err.starts_with("error: "), "{arguments:?}: {}", ran.err);
        ran.err
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A slider-crank with its three questions.
pub(crate) const SLIDER: &str = r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
  "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 } },
  "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ], "near": { "B": [40, 0] },
  "input": { "link": 2, "angle": 90, "omega": 10 }, "find": ["v(A)", "v(B)", "omega(3)"] }"#;
