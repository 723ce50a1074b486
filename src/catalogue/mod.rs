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
    kind!("drag-link", "Double crank: the shortest link is the frame"),
    kind!("double-rocker", "Double rocker: the shortest link is the coupler"),
    kind!("coupler-point", "Four-bar with a point C on a triangular coupler"),
    kind!("slider-crank", "Central slider-crank"),
    kind!("slider-crank-offset", "Slider-crank with an offset guide"),
    kind!("v-engine", "V engine: master rod with an articulated rod"),
    kind!("toggle-press", "Toggle press: crank, rod and two toggle links on a ram"),
    kind!("two-sliders", "Eight links: ternary coupler, two rods and two sliders"),
    kind!("six-link", "Six links: four-bar, two-arm rocker, rod and slider"),
];
