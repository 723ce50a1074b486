//! `linkgram watch`: keeps figures up to date beside an editor.

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use super::draw::{self, Job};
use super::{Ending, Failure, print};
use crate::{files, limits, terminal};

/// How often the scene is looked at.
const LOOK: Duration = Duration::from_millis(100);
/// What changes within this time is one change.
const REST: Duration = Duration::from_millis(50);
/// Editors that save by renaming take a scene away for less than this.
const GONE: Duration = Duration::from_secs(2);

/// Draws at once and after every change, until it is ended: by Ctrl-C when what is being written is whole, by a second
/// one at once.
pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    if job.output.is_empty() {
        return Err(Failure("watch keeps files up to date: name one with -o sheet.svg".to_owned()));
    }
    if job.scene.as_os_str() == "-" {
        return Err(Failure("watch looks at a file; standard input does not change".to_owned()));
    }
    let ended = ended();
    let mut watched = Watched::new(&job.scene);
    while !ended.load(Ordering::Relaxed) {
        match watched.news() {
            News::Nothing => {}
            News::Changed => draw_once(job)?,
            News::Gone => {
                let what = format!("{}: is gone; its figures are kept", files::shown(&job.scene));
                let _ = writeln!(io::stderr(), "{}  {what}", now());
            }
        }
        std::thread::sleep(LOOK);
    }
    Ok(Ending::Fine)
}

/// What tells that somebody has ended it.
fn ended() -> Arc<AtomicBool> {
    let ended = Arc::new(AtomicBool::new(false));
    #[cfg(unix)]
    {
        use signal_hook::{consts::SIGINT, flag};
        // The second one finds it set by the first. Without them the system ends it as it ends everything.
        let _ = flag::register_conditional_shutdown(SIGINT, 0, Arc::clone(&ended));
        let _ = flag::register(SIGINT, Arc::clone(&ended));
    }
    ended
}

/// Writes all outputs, or says why not and keeps the old ones.
fn draw_once(job: &Job) -> Result<(), Failure> {
    let begun = Instant::now();
    match draw::run(job) {
        Ok(_) => {
            let took = begun.elapsed().as_millis();
            for path in &job.output {
                print(&format!("{}  {}  {took} ms\n", now(), files::shown(path)))?;
            }
        }
        Err(Failure { told, .. }) => {
            let _ = writeln!(io::stderr(), "{}  error: {}", now(), terminal::lines(&told));
        }
    }
    Ok(())
}

/// The time of day, UTC.
fn now() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (hours, minutes) = (seconds / 3600 % 24, seconds / 60 % 60);
    format!("{hours:02}:{minutes:02}:{:02}Z", seconds % 60)
}

/// What can be seen of a file without reading it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Look {
    length: u64,
    changed: Option<SystemTime>,
    inode: u64,
}

impl Look {
    fn at(path: &Path) -> Option<Self> {
        let about = fs::metadata(path).ok()?;
        #[cfg(unix)]
        let inode = std::os::unix::fs::MetadataExt::ino(&about);
        #[cfg(not(unix))]
        let inode = 0;
        Some(Self { length: about.len(), changed: about.modified().ok(), inode })
    }
}

#[derive(Debug, PartialEq, Eq)]
enum News {
    Nothing,
    Changed,
    /// It has been away for longer than a save takes; told once.
    Gone,
}

/// A file, and what was last seen of it.
struct Watched<'p> {
    path: &'p Path,
    seen: Option<Look>,
    bytes: Option<Vec<u8>>,
    away: Option<Instant>,
    told: bool,
}

impl<'p> Watched<'p> {
    fn new(path: &'p Path) -> Self {
        Self { path, seen: None, bytes: None, away: None, told: false }
    }

    fn news(&mut self) -> News {
        let Some(mut look) = Look::at(self.path) else {
            let since = *self.away.get_or_insert_with(Instant::now);
            self.seen = None;
            if since.elapsed() > GONE && !self.told {
                self.told = true;
                return News::Gone;
            }
            return News::Nothing;
        };
        (self.away, self.told) = (None, false);
        if self.seen == Some(look) {
            return News::Nothing;
        }
        // It may still be being written.
        loop {
            std::thread::sleep(REST);
            match Look::at(self.path) {
                Some(next) if next == look => break,
                Some(next) => look = next,
                None => return News::Nothing,
            }
        }
        self.seen = Some(look);
        // What is no file is told by whoever draws it; nobody waits for a pipe.
        let bytes = files::read_bytes(self.path, limits::FILE).ok();
        if bytes.is_some() && bytes == self.bytes {
            return News::Nothing;
        }
        self.bytes = bytes;
        News::Changed
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_save_is_seen_once() {
        let folder = std::env::temp_dir().join(format!("linkgram-watch-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (path, aside) = (folder.join("scene.json"), folder.join("scene.json~"));
        let mut watched = Watched::new(&path);
        assert_eq!(watched.news(), News::Nothing, "it is not there yet");
        fs::write(&path, "one").unwrap();
        assert_eq!(watched.news(), News::Changed);
        assert_eq!(watched.news(), News::Nothing);
        // The same text written again is no change.
        fs::write(&path, "one").unwrap();
        assert_eq!(watched.news(), News::Nothing);
        // In place, of the same length.
        fs::write(&path, "two").unwrap();
        assert_eq!(watched.news(), News::Changed);
        // By renaming.
        fs::write(&aside, "six").unwrap();
        fs::rename(&aside, &path).unwrap();
        assert_eq!(watched.news(), News::Changed);
        // Gone for a moment, then there with another text.
        fs::remove_file(&path).unwrap();
        assert_eq!(watched.news(), News::Nothing);
        fs::write(&path, "seven").unwrap();
        assert_eq!(watched.news(), News::Changed);
        fs::remove_dir_all(&folder).unwrap();
    }
}
