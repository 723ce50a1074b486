//! Reading scenes and writing results: beside, then renamed, so that nothing is ever half-written.

use std::collections::HashSet;
use std::fs;
use std::hash::{BuildHasher, Hasher};
use std::io::{BufWriter, ErrorKind, Read, Write};
#[cfg(feature = "cli")]
use std::path::Component;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::limits;

/// A file that cannot be read or written, in one sentence that names it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct FileError(pub(crate) String);

/// Room for most scenes (bytes).
const USUAL_SCENE: usize = 16 << 10;

/// Standard input, on the command line.
const STANDARD_INPUT: &str = "-";

/// A path in a message: one line, and nothing that a terminal obeys.
pub(crate) fn shown(path: &Path) -> String {
    crate::terminal::line(&path.display().to_string())
}

/// The name to show and the text of a scene; `-` is standard input.
pub(crate) fn read(path: &Path) -> Result<(String, String), FileError> {
    if path.as_os_str() != STANDARD_INPUT {
        return read_file(path);
    }
    let mut bytes = Vec::with_capacity(USUAL_SCENE);
    let input = std::io::stdin().lock().take(limits::FILE as u64 + 1).read_to_end(&mut bytes);
    input.map_err(|error| FileError(format!("standard input: {error}")))?;
    text("<stdin>".to_owned(), bytes)
}

/// The name to show and the text of a file; no name means standard input.
pub(crate) fn read_file(path: &Path) -> Result<(String, String), FileError> {
    let bytes = read_bytes(path, limits::FILE)?;
    text(shown(path), bytes)
}

/// Nobody waits for a pipe or a device: only a regular file is opened.
pub(crate) fn read_bytes(path: &Path, most: usize) -> Result<Vec<u8>, FileError> {
    let failed = |error: std::io::Error| failed(path, &error);
    let kind = fs::metadata(path).map_err(failed)?;
    if kind.is_dir() {
        return Err(FileError(format!("{}: is a folder", shown(path))));
    }
    if !kind.is_file() {
        return Err(FileError(format!(
            "{}: is a pipe, a device or a socket, and no file; give it on standard input, as `-`",
            shown(path)
        )));
    }
    let mut bytes = Vec::with_capacity(USUAL_SCENE);
    let file = fs::File::open(path).map_err(failed)?;
    file.take(most as u64 + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() > most {
        return Err(FileError(format!("{}: larger than {} MiB", shown(path), most >> 20)));
    }
    Ok(bytes)
}

fn text(file: String, bytes: Vec<u8>) -> Result<(String, String), FileError> {
    if bytes.len() > limits::FILE {
        return Err(FileError(format!("{file}: larger than {} MiB; not a scene", limits::FILE >> 20)));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let good =
            String::from_utf8_lossy(&error.as_bytes()[..error.utf8_error().valid_up_to()]).into_owned();
        let line = good.matches('\n').count() + 1;
        let column = good.rsplit('\n').next().map_or(1, |last| last.chars().count() + 1);
        FileError(format!("{file}:{line}:{column}: not UTF-8 text; save the file as UTF-8"))
    })?;
    Ok((file, text))
}

/// The place of a file that another file names: beside it or below, never elsewhere. Whoever hands something in
/// must not have a neighbour's work read.
#[cfg(feature = "cli")]
pub(crate) fn beside_of(file: &Path, name: &str) -> Result<PathBuf, FileError> {
    let refused = |why: &str| Err(FileError(format!("{}: {why}", crate::terminal::line(name))));
    let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    if name.is_empty() || name.contains('\0') || !Path::new(name).components().all(inside) {
        return refused("lies elsewhere; a file is named as it lies beside the one that names it");
    }
    let path = file.with_file_name(name);
    let folder = parent(file);
    let (Ok(whole), Ok(home)) = (fs::canonicalize(&path), fs::canonicalize(folder)) else {
        // What is not there is told by whoever reads it.
        return Ok(path);
    };
    if whole.starts_with(home) {
        Ok(path)
    } else {
        refused("is a link to elsewhere; lay the file itself there")
    }
}

/// Refuses a file that a link leads out of its folder.
pub(crate) fn inside(folder: &Path, path: &Path) -> Result<(), FileError> {
    let home = fs::canonicalize(folder).map_err(|error| failed(folder, &error))?;
    // The folders that do not stand yet are made where their nearest one stands.
    let standing = path.ancestors().skip(1).find_map(|above| fs::canonicalize(or_here(above)).ok());
    match standing {
        Some(place) if place.starts_with(&home) => Ok(()),
        _ => Err(FileError(format!(
            "{}: a link leads out of {}; nothing is written there",
            shown(path),
            shown(folder)
        ))),
    }
}

/// The folder of a file.
fn parent(path: &Path) -> &Path {
    path.parent().map_or(Path::new("."), or_here)
}

fn or_here(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

/// Refuses to write over the scene that was read, in whatever way it is named.
#[cfg(feature = "cli")]
pub(crate) fn spare<'a>(
    input: &Path,
    outputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), FileError> {
    spare_input("the scene itself", input, outputs)
}

/// The same for any file that was read; `what` says which.
#[cfg(feature = "cli")]
pub(crate) fn spare_input<'a>(
    what: &str,
    input: &Path,
    outputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), FileError> {
    // What is not there yet cannot be the input, nor can standard input.
    let Ok(input) = fs::canonicalize(input) else { return Ok(()) };
    let same = |path: &&PathBuf| fs::canonicalize(path).is_ok_and(|path| path == input);
    match outputs.into_iter().find(same) {
        Some(path) => Err(FileError(format!(
            "{}: is {what}, and would be overwritten; choose another name",
            shown(path)
        ))),
        None => Ok(()),
    }
}

/// Writes all files, or none: each beside its place first, then all are renamed; if one cannot be, those
/// renamed before it are taken back.
pub(crate) fn write_all(files: &[(PathBuf, Vec<u8>)]) -> Result<(), FileError> {
    let paths = files.iter().map(|(path, _)| path.as_path());
    let mut bytes = files.iter().map(|(_, bytes)| bytes);
    stream_all(paths, |_, to| bytes.next().map_or(Ok(()), |bytes| to.write_all(bytes)))
}

/// The same for files that are written bit by bit: `write` gets the index of each and what to write into.
pub(crate) fn stream_all<'a>(
    paths: impl Iterator<Item = &'a Path>,
    mut write: impl FnMut(usize, &mut dyn Write) -> std::io::Result<()>,
) -> Result<(), FileError> {
    let mut waiting: Vec<Waiting<'_>> = Vec::new();
    let (mut places, mut folders) = (HashSet::new(), HashSet::new());
    // What cannot be written at all is told before anything long is begun.
    let result = paths
        .into_iter()
        .try_for_each(|path| {
            let folder = parent(path);
            // Two names of one file would overwrite one another.
            let whole = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
            if !places.insert(whole.join(path.file_name().unwrap_or_default())) {
                return Err(FileError(format!("{}: is to be written twice", shown(path))));
            }
            if folders.insert(whole) {
                clear(folder);
            }
            Waiting::create(path).map(|one| waiting.push(one))
        })
        .and_then(|()| {
            waiting.iter_mut().enumerate().try_for_each(|(index, one)| {
                let mut to = BufWriter::new(&mut one.file);
                let written = write(index, &mut to).and_then(|()| to.flush());
                // What could not be written is not tried again.
                drop(to.into_parts());
                let kept =
                    written.and_then(|()| if one.beside.is_some() { one.file.sync_all() } else { Ok(()) });
                kept.map_err(|error| failed(one.path, &error))
            })
        })
        .and_then(|()| {
            let several = waiting.len() > 1;
            waiting.iter_mut().try_for_each(|one| one.put(several))
        });
    for one in waiting.into_iter().rev() {
        one.finish(result.is_ok());
    }
    result
}

fn failed(path: &Path, error: &std::io::Error) -> FileError {
    FileError(format!("{}: {error}", shown(path)))
}

/// A file written beside its place.
struct Waiting<'a> {
    path: &'a Path,
    /// Where it is written; a device is written into as it stands.
    beside: Option<PathBuf>,
    file: fs::File,
    /// The file that stood there before, under another name, and held so that nobody clears it away.
    old: Option<(PathBuf, Option<fs::File>)>,
    in_place: bool,
}

impl<'a> Waiting<'a> {
    fn create(path: &'a Path) -> Result<Self, FileError> {
        let waiting = |beside, file| Self { path, beside, file, old: None, in_place: false };
        if path.file_name().is_none() {
            return Err(FileError(format!("{}: not a file name", shown(path))));
        }
        match fs::metadata(path) {
            Ok(there) if there.is_dir() => Err(FileError(format!("{}: is a folder", shown(path)))),
            Ok(there) if is_character_device(&there) => {
                let file = fs::OpenOptions::new().write(true).open(path);
                Ok(waiting(None, file.map_err(|error| failed(path, &error))?))
            }
            Ok(there) if !there.is_file() => Err(FileError(format!(
                "{}: is a pipe, a socket or a disk, and no file; write to standard output instead",
                shown(path)
            ))),
            Ok(there) if there.permissions().readonly() => Err(FileError(format!(
                "{}: is write-protected; choose another name, or let it be written",
                shown(path)
            ))),
            there => {
                let (beside, file) = part(path).map_err(|error| failed(path, &error))?;
                // Who may read what stood there may read what takes its place, and nobody else.
                if let Ok(there) = there {
                    let _ = file.set_permissions(there.permissions());
                }
                Ok(waiting(Some(beside), file))
            }
        }
    }

    /// Renames it to its place; among several, what stands there is kept until all are.
    fn put(&mut self, several: bool) -> Result<(), FileError> {
        let Some(beside) = &self.beside else { return Ok(()) };
        if several && self.path.exists() {
            let old = unused(self.path, OLD);
            // A second name costs nothing; where the file system has none, a copy serves.
            fs::hard_link(self.path, &old)
                .or_else(|_| fs::copy(self.path, &old).map(drop))
                .map_err(|error| failed(self.path, &error))?;
            let held = fs::File::open(&old).ok();
            let _ = held.as_ref().map(fs::File::try_lock_shared);
            self.old = Some((old, held));
        }
        fs::rename(beside, self.path).map_err(|error| failed(self.path, &error))?;
        self.in_place = true;
        Ok(())
    }

    /// Leaves nothing behind but the file, or, if all are taken back, what was there before.
    fn finish(self, all_are_written: bool) {
        let Some(beside) = &self.beside else { return };
        if !self.in_place {
            let _ = fs::remove_file(beside);
        }
        match (&self.old, all_are_written || !self.in_place) {
            (Some((old, _)), true) => drop(fs::remove_file(old)),
            (Some((old, _)), false) => drop(fs::rename(old, self.path)),
            (None, true) => {}
            (None, false) => drop(fs::remove_file(self.path)),
        }
    }
}

#[cfg(unix)]
fn is_character_device(there: &fs::Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_char_device(&there.file_type())
}

#[cfg(not(unix))]
fn is_character_device(_: &fs::Metadata) -> bool {
    false
}

/// How the names of files begin that wait beside their places.
const OURS: &str = ".linkgram-";
/// What is being written.
const PART: &str = ".part";
/// What stood there before.
const OLD: &str = ".old";
/// So often a name is tried.
const TRIES: usize = 64;

/// A new file beside its place. It is locked as long as it is written: what is not is left over.
fn part(path: &Path) -> std::io::Result<(PathBuf, fs::File)> {
    for _ in 0..TRIES {
        let beside = unused(path, PART);
        match fs::File::create_new(&beside) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
            Ok(file) => {
                // Where nothing can be locked, nothing is ever taken for left over.
                let locked = file.try_lock();
                // Between its making and its locking another run may have cleared it away.
                if !matches!(locked, Err(fs::TryLockError::WouldBlock)) && beside.exists() {
                    return Ok((beside, file));
                }
            }
        }
    }
    Err(std::io::Error::other("no name beside it is free"))
}

/// A name in the same folder that nobody else uses: process numbers come again.
fn unused(path: &Path, ending: &str) -> PathBuf {
    // Its keys are drawn at random for every use.
    let mut random = std::hash::RandomState::new().build_hasher();
    random.write_u32(std::process::id());
    path.with_file_name(format!("{OURS}{:016x}{ending}", random.finish()))
}

/// Whether a name is one of ours.
fn is_ours(name: &str) -> bool {
    let inside = name.strip_prefix(OURS).and_then(|n| n.strip_suffix(PART).or_else(|| n.strip_suffix(OLD)));
    inside.is_some_and(|n| n.len() == 16 && n.bytes().all(|b| b.is_ascii_hexdigit()))
}

/// Whether a folder holds nothing but what waits beside its place.
#[cfg(feature = "cli")]
pub(crate) fn holds_nothing(folder: &Path) -> Result<bool, FileError> {
    let entries = fs::read_dir(folder).map_err(|error| failed(folder, &error))?;
    Ok(entries.flatten().all(|entry| is_ours(&entry.file_name().to_string_lossy())))
}

/// Clears away what runs that were killed have left in a folder: files of our names that no run holds.
fn clear(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let ours = is_ours(&entry.file_name().to_string_lossy());
        if !ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let Ok(file) = fs::File::open(entry.path()) else { continue };
        // Held until it is gone: nobody may take it for his own in between.
        if file.try_lock().is_ok() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Holds a folder: runs that write into one folder do so one after another. Nothing is held where the system does
/// not lock folders.
#[derive(Debug)]
pub(crate) struct Held {
    _folder: Option<fs::File>,
}

/// Waits for other runs, at most as long as they write.
pub(crate) fn hold(folder: &Path) -> Held {
    let held = fs::File::open(folder).ok().filter(|folder| folder.lock().is_ok());
    Held { _folder: held }
}

/// Every scene under the paths: a file as it is, a folder's `.json` files in the order of their names.
#[cfg(feature = "cli")]
pub(crate) fn scenes_under(paths: &[PathBuf]) -> Result<Vec<PathBuf>, FileError> {
    let mut found = Vec::new();
    for path in paths {
        if path.as_os_str() == STANDARD_INPUT || !path.is_dir() {
            found.push(path.clone());
        } else {
            let before = found.len();
            let scene = |path: &PathBuf| path.extension().is_some_and(|e| e == "json");
            found.extend(all_under(path)?.into_iter().filter(scene));
            if found.len() == before {
                return Err(FileError(format!("{}: no .json file in this folder", shown(path))));
            }
        }
    }
    Ok(found)
}

/// Every file of a folder and of those below it, in the order of their names; what several links lead to, once.
pub(crate) fn all_under(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let mut walk = Walk { root: folder, found: Vec::new(), seen: HashSet::new(), looked_at: 0 };
    walk.folder(folder, 0)?;
    Ok(walk.found)
}

/// A walk through a folder.
struct Walk<'a> {
    root: &'a Path,
    found: Vec<PathBuf>,
    /// The folders that were walked: a link to one of them shows nothing new.
    seen: HashSet<PathBuf>,
    looked_at: usize,
}

impl Walk<'_> {
    fn folder(&mut self, folder: &Path, depth: usize) -> Result<(), FileError> {
        let failed = |error: std::io::Error| failed(folder, &error);
        if !self.seen.insert(fs::canonicalize(folder).map_err(failed)?) {
            return Ok(());
        }
        if depth > limits::FOLDERS {
            return Err(FileError(format!(
                "{}: folders nested more than {} deep",
                shown(folder),
                limits::FOLDERS
            )));
        }
        let mut entries = Vec::new();
        for entry in fs::read_dir(folder).map_err(failed)? {
            self.looked_at += 1;
            if self.looked_at > limits::FILES {
                let most = limits::grouped(limits::FILES);
                return Err(FileError(format!("{}: more than {most} files", shown(self.root))));
            }
            entries.push(entry.map_err(failed)?.path());
        }
        entries.sort();
        for entry in entries {
            if entry.is_dir() {
                self.folder(&entry, depth + 1)?;
            } else {
                self.found.push(entry);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder comes into being where the second file should go, after all were written beside.
    #[test]
    fn what_was_renamed_is_taken_back_when_a_later_file_cannot_be() {
        let folder = std::env::temp_dir().join(format!("linkgram-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let [old, new, bad] = ["old.svg", "new.svg", "bad.svg"].map(|name| folder.join(name));
        fs::write(&old, "before").unwrap();
        let mut waiting: Vec<Waiting<'_>> =
            [&old, &new, &bad].into_iter().map(|path| Waiting::create(path).ok().unwrap()).collect();
        for one in &mut waiting {
            one.file.write_all(b"after").unwrap();
        }
        fs::create_dir_all(bad.join("inside")).unwrap();
        assert!(waiting[0].put(true).is_ok() && waiting[1].put(true).is_ok());
        assert_eq!(fs::read(&old).unwrap(), b"after");
        assert!(waiting[2].put(true).is_err());
        for one in waiting.into_iter().rev() {
            one.finish(false);
        }
        assert_eq!(fs::read(&old).unwrap(), b"before");
        fs::remove_dir_all(&bad).unwrap();
        let left: Vec<PathBuf> = fs::read_dir(&folder).unwrap().map(|e| e.unwrap().path()).collect();
        assert_eq!(left, [old]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
