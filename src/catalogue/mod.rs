//! Ready scenes of the common mechanisms, for `linkgram new`.

/// A kind of mechanism with a ready scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind {
    /// Its name on the command line.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// The scene file.
    pub scene: &'static str,
}

macro_rules! kind {
    ($name:literal, $about:literal) => {
        Kind { name: $name, about: $about, scene: include_str!(concat!($name, ".json")) }
    };
}

/// Every kind, in the order in which they are listed.
pub const KINDS: &[Kind] = &[
    kind!("four-bar", "Crank-rocker four-bar, open assembly"),
    kind!("four-bar-crossed", "The same four-bar, crossed assembly"),
    kind!("rocker-crank", "Crank-rocker four-bar driven from its rocker"),
    kind!("drag-link", "Double crank: the shortest link is the frame"),
    kind!("double-rocker", "Double rocker: the shortest link is the coupler"),
    kind!("four-bar-triple-rocker", "Four-bar beyond Grashof: no link turns fully"),
    kind!("parallel-crank", "Parallel cranks of a locomotive (change-point four-bar)"),
    kind!("antiparallel-crank", "The same links crossed: cranks that turn against each other"),
    kind!("coupler-point", "Four-bar with a point C on a triangular coupler"),
    kind!("watt", "Watt straight-line linkage"),
    kind!("tchebyshev", "Tchebyshev straight-line linkage"),
    kind!("roberts", "Roberts straight-line linkage"),
    kind!("peaucellier", "Peaucellier straight-line linkage (eight links)"),
    kind!("ackermann", "Ackermann steering, inner wheel turned"),
    kind!("davis", "Davis steering: a sliding bar turns two slotted arms"),
    kind!("six-link", "Six links: four-bar, two-arm rocker, rod and slider"),
    kind!("wrapping-machine", "Wrapping machine: a coupler point swings a bell crank"),
    kind!("two-sliders", "Eight links: ternary coupler, two rods and two sliders"),
    kind!("stephenson", "Stephenson six-bar driven where no dyad is solvable alone"),
    kind!("slider-crank", "Central slider-crank"),
    kind!("slider-crank-offset", "Slider-crank with an offset guide"),
    kind!("v-engine", "V engine: master rod with an articulated rod"),
    kind!("w-engine", "W engine: master rod and two articulated rods"),
    kind!("sewing-machine", "Sewing-machine needle bar: bell crank, rod and bar"),
    kind!("eccentric-pump", "Pump with a curved guide: the arm of the crank pin rides on an arc"),
    kind!("hand-pump", "Hand pump: the slider is the frame, the rod is moved"),
    kind!("toggle-press", "Toggle press: crank, rod and two toggle links on a ram"),
    kind!("punch-press", "Toggle punch press (eight links)"),
    kind!("pantograph", "Pantograph: F copies the path of D at half size"),
    kind!("drag-link-shaper", "Drag-link quick return: double crank, rod and ram"),
    kind!("scotch-yoke", "Scotch yoke: harmonic motion"),
    kind!("oblique-yoke", "Yoke with an oblique slot"),
    kind!("oldham", "Oldham's coupling of two parallel shafts"),
    kind!("elliptic-trammel", "Elliptic trammel, driven by one slider"),
    kind!("slotted-lever", "Crank and slotted lever"),
    kind!("offset-shaper", "Crank-shaper whose slot lies beside the lever"),
    kind!("crank-shaper", "Crank-shaper quick return: slotted lever, rod and ram"),
    kind!("shaper-block", "Shaper whose ram rides on the lever itself: a pin on two guides"),
    kind!("whitworth", "Whitworth quick return: the slotted arm turns fully"),
    kind!("oscillating-cylinder", "Engine with an oscillating cylinder"),
    kind!("geneva", "Geneva wheel of four slots, pin in engagement"),
    kind!("curved-slot", "Pin of a disc in the curved slot of a rocker"),
    kind!("coupler-slot", "Four-bar whose coupler point drives a slotted arm"),
    kind!("travelling-slot", "A guide that turns and travels: block on the connecting rod of an engine"),
    kind!("gear-pair", "Two gears with a rod and a slider"),
    kind!("geared-five-bar", "Geared five-bar: two meshing gears drive a dyad"),
    kind!("differential-stroke", "Gears that drive one point of a linkage from two sides (Andreau)"),
    kind!("hypocycloid", "Planet in a ring gear with a rod and a slider"),
    kind!("rolling-rocker", "Eccentric gear on which the gear of a rocker rolls"),
    kind!("rack-pinion", "Pinion that drives a rack"),
    kind!("rolling-wheel", "Driven wheel on the ground with a rod and a slider"),
    kind!("rack-wheel", "Wheel that rolls on the ground, pushed by a crank and rod"),
    kind!("engine", "Forces in an engine: gas pressure, weights and inertia"),
    kind!("press", "Forces in a toggle press: the torque that a pressing force needs"),
    kind!("governor-porter", "Porter governor with dead weight: rising and falling speed"),
    kind!("governor-hartnell", "Hartnell governor with a spring and friction at the sleeve"),
    kind!("turning-moment", "Turning-moment diagram of a four-stroke engine, its flywheel"),
];

#[cfg(test)]
mod tests {
    use super::KINDS;
    use crate::check::check;
    use crate::plan::Extent;
    use crate::scene;
    use crate::sheet::{self, Language, scale};

    #[test]
    fn every_kind_checks() {
        for kind in KINDS {
            let scene = scene::read(kind.scene, kind.name).unwrap_or_else(|error| panic!("{error}"));
            let check = check(&scene, 0.05);
            assert!(check.ok, "{}: {:?}", kind.name, check.outcome);
        }
    }

    #[test]
    fn every_kind_draws() {
        for kind in KINDS {
            let scene = scene::read(kind.scene, kind.name).unwrap();
            let solved = crate::solve::solve(&scene, Extent::WholeSkeleton, scale::for_scene).unwrap();
            let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
            assert!(crate::render::svg::write(&figure).len() > 1000, "{}", kind.name);
        }
    }

    #[test]
    fn kinds_have_names_of_their_own_and_a_line_that_fits() {
        for (index, kind) in KINDS.iter().enumerate() {
            assert!(KINDS[..index].iter().all(|k| k.name != kind.name), "{} twice", kind.name);
            assert!(kind.name.len() + kind.about.len() < 100, "{}", kind.name);
        }
    }

    #[test]
    fn every_scene_of_the_folder_is_listed() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/catalogue");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "json") {
                let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
                assert!(KINDS.iter().any(|k| k.name == name), "{name} is not listed");
            }
        }
    }
}
