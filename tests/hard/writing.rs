//! Where something is to be written, others have left links, devices and halves of files.

use std::os::unix::fs::{FileTypeExt, symlink};
use std::process::Command;

use super::folder::{Folder, SLIDER};
use crate::common;

fn linkgram() -> &'static str {
    env!("CARGO_BIN_EXE_linkgram")
}

/// Left over by a run that was killed: cleared away by the next one, whatever its process number. What another run
/// holds, and what only looks alike, stays.
#[test]
fn what_a_killed_run_has_left_blocks_nobody_and_goes() {
    let folder = Folder::new("left-over");
    folder.write("slider.json", SLIDER);
    for process in 1..5 {
        folder.write(&format!(".x.svg.{process}.part"), "of an older version");
    }
    folder.write(".linkgram-0123456789abcdef.part", "of a killed run");
    folder.write(".linkgram-0123456789abcdea.old", "of a killed run");
    folder.write(".linkgram-mine.part", "somebody's own");
    folder.write(".linkgram-0000000000000000.part", "of a run that writes");
    let held = std::fs::File::open(folder.path(".linkgram-0000000000000000.part")).unwrap();
    held.try_lock().unwrap();
    let before = folder.names();
    let ran = folder.run(&["draw", "slider.json", "-o", "x.svg"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let mut expected = before;
    expected.insert("x.svg".to_owned());
    expected.remove(".linkgram-0123456789abcdef.part");
    expected.remove(".linkgram-0123456789abcdea.old");
    assert_eq!(folder.names(), expected);
}

/// A device stays a device, and what is written goes into it; a pipe is refused.
#[test]
fn a_device_is_written_into_and_never_replaced() {
    let folder = Folder::new("device");
    folder.write("slider.json", SLIDER);
    symlink("/dev/null", folder.path("null.svg")).unwrap();
    symlink("/dev/full", folder.path("full.svg")).unwrap();
    assert!(Command::new("mkfifo").arg(folder.path("pipe.svg")).status().unwrap().success());
    let ran = folder.run(&["draw", "slider.json", "-o", "null.svg"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
    let there = |name: &str| std::fs::metadata(folder.path(name)).unwrap().file_type();
    assert!(there("null.svg").is_char_device());
    // All files or none.
    let said = folder.refused(&["draw", "slider.json", "-o", "x.svg", "-o", "full.svg"]);
    assert!(said.contains("full.svg") && there("full.svg").is_char_device(), "{said}");
    let said = folder.refused(&["draw", "slider.json", "-o", "x.svg", "-o", "pipe.svg"]);
    assert!(said.contains("pipe.svg: is a pipe") && there("pipe.svg").is_fifo(), "{said}");
    let said = folder.refused(&["draw", "slider.json", "-o", "x.svg", "-o", "./x.svg"]);
    assert!(said.contains("is to be written twice"), "{said}");
    let names: Vec<String> = folder.names().into_iter().collect();
    assert_eq!(names, ["full.svg", "null.svg", "pipe.svg", "slider.json"]);
}

/// The largest file that may be written is smaller than the sheet: one message, nothing left.
#[test]
fn a_write_that_is_cut_leaves_nothing() {
    let folder = Folder::new("cut");
    folder.write("slider.json", SLIDER);
    folder.write("x.svg", "as it was");
    let limited = format!("ulimit -f 2; exec {} draw slider.json -o x.svg", linkgram());
    let ran = folder.run_by(Command::new("sh").args(["-c", &limited]));
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.err.starts_with("error: x.svg: "), "{}", ran.err);
    let names: Vec<String> = folder.names().into_iter().collect();
    assert_eq!(names, ["slider.json", "x.svg"]);
    assert_eq!(std::fs::read(folder.path("x.svg")).unwrap(), b"as it was");
}

/// A folder of the suite that is a link to elsewhere.
#[test]
fn bless_writes_nothing_outside_of_its_suite() {
    let folder = Folder::new("bless");
    for name in ["suite", "elsewhere"] {
        std::fs::create_dir(folder.path(name)).unwrap();
    }
    folder.write("suite/slider.json", SLIDER);
    folder.write("elsewhere/other.json", SLIDER);
    symlink("../elsewhere", folder.path("suite/linked")).unwrap();
    let said = folder.refused(&["golden", "bless", "suite"]);
    assert!(said.contains("a link leads out of suite"), "{said}");
    assert_eq!(std::fs::read_dir(folder.path("elsewhere")).unwrap().count(), 1);
    assert_eq!(std::fs::read_dir(folder.path("suite")).unwrap().count(), 2);
    // A golden that is a pipe is not waited for; two slashes are one.
    std::fs::remove_file(folder.path("suite/linked")).unwrap();
    folder.write("suite/suite.json", r#"{ "figures": [{ "scenes": ["slider.json"], "name": "a//b" }] }"#);
    assert_eq!(folder.run(&["golden", "bless", "suite"]).code, Some(0));
    let ran = folder.run(&["golden", "check", "suite"]);
    assert_eq!((ran.code, ran.out.contains("extra")), (Some(0), false), "{ran:?}");
    std::fs::remove_file(folder.path("suite/a/b.svg")).unwrap();
    assert!(Command::new("mkfifo").arg(folder.path("suite/a/b.svg")).status().unwrap().success());
    let ran = folder.run(&["golden", "check", "suite"]);
    assert!(ran.code == Some(2) && ran.err.contains("is a pipe"), "{ran:?}");
}

const EXAM: &[&str] = &["--variants", "3", "--seed", "5"];

fn exam<'a>(scene: &'a str, folder: &'a str) -> Vec<&'a str> {
    [&["exam", scene, "-o", folder], EXAM].concat()
}

/// An exam is written into its folder: what a link leads to is nobody's exam.
#[test]
fn an_exam_follows_no_link_and_deletes_nothing_of_others() {
    let folder = Folder::new("exam-links");
    let scene = common::root().join("examples/exam/crank-and-slider.json");
    let scene = scene.to_str().unwrap();
    let ran = folder.run(&exam(scene, "exam"));
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    std::fs::create_dir(folder.path("elsewhere")).unwrap();
    folder.write("elsewhere/.theirs.part", "not ours");
    std::fs::remove_dir_all(folder.path("exam/solutions")).unwrap();
    symlink("../elsewhere", folder.path("exam/solutions")).unwrap();
    let said = folder.refused(&exam(scene, "exam"));
    assert!(said.contains("a link leads out of exam"), "{said}");
    assert_eq!(std::fs::read_dir(folder.path("elsewhere")).unwrap().count(), 1);
    // A foreign file beside those of the exam stays.
    std::fs::remove_file(folder.path("exam/solutions")).unwrap();
    folder.write("exam/questions/.theirs.part", "not ours");
    let ran = folder.run(&exam(scene, "exam"));
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert_eq!(std::fs::read(folder.path("exam/questions/.theirs.part")).unwrap(), b"not ours");
}

/// Two at once: both end well, and there is one exam.
#[test]
fn two_exams_at_once_both_end_right() {
    let folder = Folder::new("two-exams");
    let scene = common::root().join("examples/exam/crank-and-slider.json");
    let scene = scene.to_str().unwrap();
    let run = || Command::new(linkgram()).args(exam(scene, "exam")).current_dir(&folder.0).output().unwrap();
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..4).map(|_| scope.spawn(run)).collect();
        for run in runs {
            let ran = run.join().unwrap();
            assert_eq!(ran.status.code(), Some(0), "{}", String::from_utf8_lossy(&ran.stderr));
        }
    });
    let alone = folder.run(&exam(scene, "alone"));
    assert_eq!(alone.code, Some(0), "{}", alone.err);
    for name in ["exam.json", "key.csv", "questions/001.en.svg", "solutions/003.en.svg", "qti.en.zip"] {
        let read = |exam: &str| std::fs::read(folder.path(exam).join(name)).unwrap();
        assert!(read("exam") == read("alone"), "{name}");
    }
    let hidden = |folder: &std::path::Path| {
        let entries = std::fs::read_dir(folder).unwrap();
        entries.filter(|e| e.as_ref().unwrap().file_name().to_string_lossy().starts_with('.')).count()
    };
    assert_eq!(hidden(&folder.path("exam")) + hidden(&folder.path("exam/questions")), 0);
}

/// What may not be written is not replaced; who may read what stood there may read what takes its place.
#[test]
fn a_file_keeps_its_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("mode");
    folder.write("slider.json", SLIDER);
    let mode = |name: &str| std::fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o777;
    let set = |name: &str, mode: u32| {
        std::fs::set_permissions(folder.path(name), std::fs::Permissions::from_mode(mode)).unwrap();
    };
    folder.write("x.svg", "as it was");
    set("x.svg", 0o600);
    let ran = folder.run(&["draw", "slider.json", "-o", "x.svg"]);
    assert_eq!((ran.code, mode("x.svg")), (Some(0), 0o600), "{ran:?}");
    folder.write("x.svg", "as it was");
    set("x.svg", 0o444);
    let said = folder.refused(&["draw", "slider.json", "-o", "x.svg"]);
    assert!(said.contains("x.svg: is write-protected"), "{said}");
    assert_eq!((std::fs::read(folder.path("x.svg")).unwrap(), mode("x.svg")), (b"as it was".to_vec(), 0o444));
    assert_eq!(folder.names().len(), 2, "{:?}", folder.names());
}

#[test]
fn a_version_that_nobody_can_read_is_an_error() {
    let folder = Folder::new("version");
    let full = |what: &str| {
        let command = format!("exec {} {what} > /dev/full", linkgram());
        folder.run_by(Command::new("sh").args(["-c", &command]))
    };
    for what in ["--version", "--help", "draw --help"] {
        let ran = full(what);
        assert_eq!(ran.code, Some(2), "{what}: {ran:?}");
        assert!(ran.err.contains("standard output"), "{what}: {ran:?}");
    }
}

#[test]
fn what_cannot_be_set_or_read_is_told_with_its_place() {
    let folder = Folder::new("told-places");
    folder.write("s.json", SLIDER.replacen('{', "{\n  \"title\": \"a\\u0007b\",", 1));
    let said = folder.refused(&["draw", "s.json", "-o", "x.tex"]);
    assert!(said.contains("s.json:2:12: title: plain LaTeX cannot set"), "{said}");
    std::fs::create_dir(folder.path("suite")).unwrap();
    folder.write("suite/suite.json", "{\n  \"figures\": 3 }");
    let said = folder.refused(&["golden", "check", "suite"]);
    assert!(said.contains("suite.json:2:14: invalid type"), "{said}");
}
