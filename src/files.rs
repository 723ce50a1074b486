//! Reading scenes and writing results: beside, then renamed, so that nothing is ever half-written.

use std::fs;
use std::io::{BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A file that cannot be read or written, in one sentence that names it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct FileError(pub(crate) String);

/// A scene file larger than this is refused before it is read.
const LARGEST_SCENE: u64 = 16 * 1024 * 1024;

/// Room for most scenes (bytes).
const USUAL_SCENE: usize = 16 << 10;

/// The name to show and the text of a scene; `-` is standard input.
pub(crate) fn read(path: &Path) -> Result<(String, String), FileError> {
    let mut bytes = Vec::with_capacity(USUAL_SCENE);
    let file = if path.as_os_str() == "-" {
        std::io::stdin()
            .lock()
            .take(LARGEST_SCENE + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| FileError(format!("standard input: {error}")))?;
        "<stdin>".to_owned()
    } else {
        let shown = path.display().to_string();
        fs::File::open(path)
            .and_then(|file| file.take(LARGEST_SCENE + 1).read_to_end(&mut bytes))
            .map_err(|error| FileError(format!("{shown}: {error}")))?;
        shown
    };
    if bytes.len() as u64 > LARGEST_SCENE {
        return Err(FileError(format!("{file}: larger than {} MiB; not a scene", LARGEST_SCENE >> 20)));
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

/// Refuses to write over the file that was read, in whatever way it is named.
pub(crate) fn spare<'a>(
    input: &Path,
    outputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), FileError> {
    // What is not there yet cannot be the input, nor can standard input.
    let Ok(input) = fs::canonicalize(input) else { return Ok(()) };
    let same = |path: &&PathBuf| fs::canonicalize(path).is_ok_and(|path| path == input);
    match outputs.into_iter().find(same) {
        Some(path) => Err(FileError(format!(
            "{}: is the scene itself, and would be overwritten; choose another name",
            path.display()
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
    // What cannot be written at all is told before anything long is begun.
    let result = paths
        .into_iter()
        .try_for_each(|path| Waiting::create(path).map(|one| waiting.push(one)))
        .and_then(|()| {
            waiting.iter_mut().enumerate().try_for_each(|(index, one)| {
                let mut to = BufWriter::new(&mut one.file);
                let written = write(index, &mut to).and_then(|()| to.flush());
                drop(to);
                written.and_then(|()| one.file.sync_all()).map_err(|error| failed(one.path, &error))
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
    FileError(format!("{}: {error}", path.display()))
}

/// A file written beside its place.
struct Waiting<'a> {
    path: &'a Path,
    beside: PathBuf,
    file: fs::File,
    /// The file that stood there before, under another name.
    old: Option<PathBuf>,
    in_place: bool,
}

impl<'a> Waiting<'a> {
    fn create(path: &'a Path) -> Result<Self, FileError> {
        if path.is_dir() {
            return Err(FileError(format!("{}: is a folder", path.display())));
        }
        let beside = beside(path, "part")?;
        // Two names of one file would wait under one name.
        let file = fs::File::create_new(&beside).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => FileError(format!("{}: is to be written twice", path.display())),
            _ => failed(path, &error),
        })?;
        Ok(Self { path, beside, file, old: None, in_place: false })
    }

    /// Renames it to its place; among several, what stands there is kept until all are.
    fn put(&mut self, several: bool) -> Result<(), FileError> {
        if several && self.path.exists() {
            let old = beside(self.path, "old")?;
            // A second name costs nothing; where the file system has none, a copy serves.
            fs::hard_link(self.path, &old)
                .or_else(|_| fs::copy(self.path, &old).map(drop))
                .map_err(|error| failed(self.path, &error))?;
            self.old = Some(old);
        }
        fs::rename(&self.beside, self.path).map_err(|error| failed(self.path, &error))?;
        self.in_place = true;
        Ok(())
    }

    /// Leaves nothing behind but the file, or, if all are taken back, what was there before.
    fn finish(self, all_are_written: bool) {
        if !self.in_place {
            let _ = fs::remove_file(&self.beside);
        }
        match (&self.old, all_are_written || !self.in_place) {
            (Some(old), true) => drop(fs::remove_file(old)),
            (Some(old), false) => drop(fs::rename(old, self.path)),
            (None, true) => {}
            (None, false) => drop(fs::remove_file(self.path)),
        }
    }
}

/// A name in the same folder that nobody else uses.
fn beside(path: &Path, ending: &str) -> Result<PathBuf, FileError> {
    let name = path.file_name().ok_or_else(|| FileError(format!("{}: not a file name", path.display())))?;
    let mut beside = std::ffi::OsString::from(".");
    beside.push(name);
    beside.push(format!(".{}.{ending}", std::process::id()));
    Ok(path.with_file_name(beside))
}

/// Every scene under the paths: a file as it is, a folder's `.json` files in the order of their names.
pub(crate) fn scenes_under(paths: &[PathBuf]) -> Result<Vec<PathBuf>, FileError> {
    let mut found = Vec::new();
    for path in paths {
        if path.as_os_str() == "-" || !path.is_dir() {
            found.push(path.clone());
        } else {
            let before = found.len();
            let scene = |path: &PathBuf| path.extension().is_some_and(|e| e == "json");
            found.extend(all_under(path)?.into_iter().filter(scene));
            if found.len() == before {
                return Err(FileError(format!("{}: no .json file in this folder", path.display())));
            }
        }
    }
    Ok(found)
}

/// Folders nested deeper than this are nobody's scenes.
const DEEPEST_FOLDER: usize = 64;

/// Every file of a folder and of those below it, in the order of their names.
pub(crate) fn all_under(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let mut found = Vec::new();
    walk(folder, &mut found, &mut Vec::new())?;
    Ok(found)
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>, around: &mut Vec<PathBuf>) -> Result<(), FileError> {
    let failed = |error: std::io::Error| FileError(format!("{}: {error}", folder.display()));
    let whole = fs::canonicalize(folder).map_err(failed)?;
    // A link back to a folder around it shows nothing new.
    if around.contains(&whole) {
        return Ok(());
    }
    if around.len() > DEEPEST_FOLDER {
        return Err(FileError(format!("{}: folders nested too deep", folder.display())));
    }
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .map_err(failed)?
        .map(|e| e.map(|e| e.path()))
        .collect::<Result<_, _>>()
        .map_err(failed)?;
    entries.sort();
    around.push(whole);
    for entry in entries {
        if entry.is_dir() {
            walk(&entry, found, around)?;
        } else {
            found.push(entry);
        }
    }
    around.pop();
    Ok(())
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
