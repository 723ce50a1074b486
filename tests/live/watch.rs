//! `linkgram watch`: files follow their scene.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

struct Watch(Child);

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn soon(what: &str, mut holds: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !holds() {
        assert!(begun.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn files_follow_the_scene_and_an_error_keeps_them() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("live-watch");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let (scene, out) = (folder.join("scene.json"), folder.join("sheet.json"));
    let text = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == "four-bar").unwrap().scene;
    fs::write(&scene, text).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .args(["watch".as_ref(), scene.as_os_str(), "--figure".as_ref(), "skeleton".as_ref(), "-o".as_ref()])
        .arg(&out)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let _watch = Watch(child);
    soon("it draws at once", || out.exists());
    let first = fs::read(&out).unwrap();
    // What is no scene keeps the old file; a good one after it replaces it.
    fs::write(&scene, "{").unwrap();
    std::thread::sleep(Duration::from_millis(600));
    assert_eq!(fs::read(&out).unwrap(), first);
    let aside = folder.join("scene.json.new");
    let angle = text.lines().find(|line| line.contains("\"angle\"")).unwrap();
    let digits: String =
        angle.split("\"angle\":").nth(1).unwrap().chars().filter(char::is_ascii_digit).take(2).collect();
    let turned = text.replacen(&format!("\"angle\": {digits}"), "\"angle\": 51", 1);
    assert_ne!(turned, text);
    fs::write(&aside, turned).unwrap();
    fs::rename(&aside, &scene).unwrap();
    soon("it draws again", || fs::read(&out).is_ok_and(|now| now != first));
}

/// A pipe in the place of the scene is told and not waited for; Ctrl-C ends with 0.
#[cfg(unix)]
#[test]
fn a_pipe_is_not_waited_for_and_ctrl_c_ends_well() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("live-watch-pipe");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let (scene, out) = (folder.join("scene.json"), folder.join("sheet.json"));
    let text = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == "four-bar").unwrap().scene;
    fs::write(&scene, text).unwrap();
    let told = folder.join("told.txt");
    let child = Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .args(["watch".as_ref(), scene.as_os_str(), "--figure".as_ref(), "skeleton".as_ref(), "-o".as_ref()])
        .arg(&out)
        .stdout(Stdio::null())
        .stderr(fs::File::create(&told).unwrap())
        .spawn()
        .unwrap();
    let mut watch = Watch(child);
    soon("it draws at once", || out.exists());
    let first = fs::read(&out).unwrap();
    fs::remove_file(&scene).unwrap();
    assert!(Command::new("mkfifo").arg(&scene).status().unwrap().success());
    soon("the pipe is told", || fs::read_to_string(&told).is_ok_and(|told| told.contains("is a pipe")));
    fs::remove_file(&scene).unwrap();
    fs::write(&scene, text.replacen("\"angle\": ", "\"angle\": 1", 1)).unwrap();
    soon("it draws again", || fs::read(&out).is_ok_and(|now| now != first));
    let number = watch.0.id().to_string();
    assert!(Command::new("kill").args(["-INT", &number]).status().unwrap().success());
    soon("it ends", || watch.0.try_wait().unwrap().is_some());
    assert_eq!(watch.0.wait().unwrap().code(), Some(0));
}
