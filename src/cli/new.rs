//! `linkgram new`.

use std::fmt::Write;

use super::{Ending, Failure, print};
use crate::catalogue;

pub(super) fn run(kind: Option<&str>) -> Result<Ending, Failure> {
    let Some(kind) = kind else {
        let width = catalogue::KINDS.iter().map(|k| k.name.len()).max().unwrap_or(0);
        let mut out = String::new();
        for kind in catalogue::KINDS {
            let _ = writeln!(out, "{:width$}  {}", kind.name, kind.about);
        }
        print(&out)?;
        return Ok(Ending::Fine);
    };
    match catalogue::KINDS.iter().find(|k| k.name == kind) {
        Some(kind) => {
            print(kind.scene)?;
            Ok(Ending::Fine)
        }
        None => {
            let names: Vec<&str> = catalogue::KINDS.iter().map(|k| k.name).collect();
            let nearest = crate::scene::nearest(kind, &names);
            let mend = nearest.map_or_else(
                || "`linkgram new` lists the kinds".to_owned(),
                |nearest| format!("did you mean {nearest}? `linkgram new` lists the kinds"),
            );
            Err(Failure(format!("unknown kind {kind}: {mend}")))
        }
    }
}
