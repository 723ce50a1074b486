//! All integration tests as one program: the library is linked once, and every processor is busy to the end.
//!
//! A file of `tests/` is a module here, with one line below; `cargo test --test all chains::` runs the tests of one. What
//! tests share is in `common/` and `sheets/`.

mod classroom;
mod common;
mod derived_forces;
mod sheets;

mod arithmetics;
mod assemblies;
mod auxiliary;
mod board_laws;
mod by_hand;
mod cases;
mod centres;
mod chains;
mod cli;
mod confirmed;
mod equations;
mod exam;
mod examiner;
#[path = "extremes/main.rs"]
mod extremes;
mod fair_examiner;
mod far_and_near;
mod far_forces;
mod fifth_examiner;
mod force_sheets;
mod forces;
mod forces_arcs;
mod forces_classroom;
mod forces_cycle;
mod forces_loads;
mod forces_methods;
mod forces_parts;
mod forces_routes;
mod forces_spin;
mod formats;
mod fourth_examiner;
mod friction;
#[path = "goldens/main.rs"]
mod goldens;
mod grade;
mod grade_follows;
mod grade_language;
mod grade_names;
mod grade_room;
mod grade_skeleton;
mod grade_unread;
mod groups;
mod handed_out;
#[path = "hard/main.rs"]
mod hard;
mod help;
#[path = "ink/main.rs"]
mod ink;
mod klein;
mod laid_off;
mod lecturer_reads;
mod lecturers_eye;
mod legibility;
#[path = "live/main.rs"]
mod live;
mod mutated_files;
mod mutations;
mod near_singular;
mod nothing_missing;
mod nudged_strokes;
#[path = "other_programs/main.rs"]
mod other_programs;
#[path = "pairs/main.rs"]
mod pairs;
mod placed;
mod plan;
#[path = "planted/main.rs"]
mod planted;
mod planted_forces;
mod printed_balance;
mod printed_lines;
mod random_sheets;
mod rooms;
mod second_examiner;
mod signed_sheets;
mod sixty_sheets;
mod stated;
#[path = "statements/main.rs"]
mod statements;
mod structure;
mod sweep;
mod sweep_assemblies;
mod sweep_trials;
mod tapes;
mod the_drawing_is_the_computation;
mod third_examiner;
mod told;
mod two_faults;

/// A file that no line names would be compiled and run by nobody.
#[test]
fn every_file_is_in_the_list() {
    let listed = include_str!("main.rs");
    let here = common::root().join("tests");
    for entry in std::fs::read_dir(here).expect("the folder of this file") {
        let path = entry.expect("an entry of it").path();
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name in letters");
        let source = path.extension().is_some_and(|ending| ending == "rs") || path.join("main.rs").is_file();
        assert!(
            !source || name == "main" || listed.contains(&format!("\nmod {name};\n")),
            "mod {name}; is missing"
        );
    }
}
