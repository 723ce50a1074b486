//! Reading scenes and writing results: beside, then renamed, so that nothing is ever half-written.

use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use super::Failure;

/// A scene file larger than this is refused before it is read.
const LARGEST_SCENE: u64 = 16 * 1024 * 1024;

/// The name to show and the text of a scene; `-` is standard input.
pub(super) fn read(path: &Path) -> Result<(String, String), Failure> {
    let mut bytes = Vec::new();
    let file = if path.as_os_str() == "-" {
        std::io::stdin()
            .lock()
            .take(LARGEST_SCENE + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| Failure(format!("standard input: {error}")))?;
        "<stdin>".to_owned()
    } else {
        let shown = path.display().to_string();
        fs::File::open(path)
            .and_then(|file| file.take(LARGEST_SCENE + 1).read_to_end(&mut bytes))
            .map_err(|error| Failure(format!("{shown}: {error}")))?;
        shown
    };
    if bytes.len() as u64 > LARGEST_SCENE {
        return Err(Failure(format!("{file}: larger than {} MiB; not a scene", LARGEST_SCENE >> 20)));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let good =
            String::from_utf8_lossy(&error.as_bytes()[..error.utf8_error().valid_up_to()]).into_owned();
        let line = good.matches('\n').count() + 1;
        let column = good.rsplit('\n').next().map_or(1, |last| last.chars().count() + 1);
        Failure(format!("{file}:{line}:{column}: not UTF-8 text; save the file as UTF-8"))
    })?;
    Ok((file, text))
}

/// Writes all files, or none: each beside its place first, then all are renamed.
pub(super) fn write_all(files: &[(PathBuf, Vec<u8>)]) -> Result<(), Failure> {
    let mut waiting: Vec<(PathBuf, &PathBuf)> = Vec::new();
    let result = files.iter().try_for_each(|(path, bytes)| {
        let name = path.file_name().ok_or_else(|| Failure(format!("{}: not a file name", path.display())))?;
        let mut beside = std::ffi::OsString::from(".");
        beside.push(name);
        beside.push(format!(".{}.part", std::process::id()));
        let beside = path.with_file_name(beside);
        if path.is_dir() {
            return Err(Failure(format!("{}: is a folder", path.display())));
        }
        // Two names of one file would wait under one name.
        let mut file = fs::File::create_new(&beside).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => Failure(format!("{}: is to be written twice", path.display())),
            _ => Failure(format!("{}: {error}", path.display())),
        })?;
        waiting.push((beside, path));
        let written = file.write_all(bytes).and_then(|()| file.sync_all());
        written.map_err(|error| Failure(format!("{}: {error}", path.display())))
    });
    let result = result.and_then(|()| {
        waiting.iter().try_for_each(|(beside, path)| {
            fs::rename(beside, path).map_err(|error| Failure(format!("{}: {error}", path.display())))
        })
    });
    if result.is_err() {
        for (beside, _) in &waiting {
            let _ = fs::remove_file(beside);
        }
    }
    result
}

/// Every scene under the paths: a file as it is, a folder's `.json` files in the order of their names.
pub(super) fn scenes_under(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    for path in paths {
        if path.as_os_str() == "-" || !path.is_dir() {
            found.push(path.clone());
        } else {
            let before = found.len();
            walk(path, &mut found, 0)?;
            if found.len() == before {
                return Err(Failure(format!("{}: no .json file in this folder", path.display())));
            }
        }
    }
    Ok(found)
}

/// Folders nested deeper than this are a loop of links.
const DEEPEST_FOLDER: usize = 64;

fn walk(folder: &Path, found: &mut Vec<PathBuf>, depth: usize) -> Result<(), Failure> {
    let failed = |error: std::io::Error| Failure(format!("{}: {error}", folder.display()));
    if depth > DEEPEST_FOLDER {
        return Err(Failure(format!("{}: folders nested too deep", folder.display())));
    }
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .map_err(failed)?
        .map(|e| e.map(|e| e.path()))
        .collect::<Result<_, _>>()
        .map_err(failed)?;
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            walk(&entry, found, depth + 1)?;
        } else if entry.extension().is_some_and(|e| e == "json") {
            found.push(entry);
        }
    }
    Ok(())
}
