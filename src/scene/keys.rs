//! Every key that a scene may have, by the object in which it stands.
//!
//! The reader refuses all others, and the published schema is tested against the same tables.

pub(super) const SCENE: &[&str] = &[
    "$schema",
    "title",
    "units",
    "fixed",
    "placed",
    "where",
    "near",
    "links",
    "slides",
    "rolls",
    "input",
    "inputs",
    "find",
    "pins",
    "published",
    "errata",
    "expect",
    "sheet",
    "vary",
    "gravity",
    "masses",
    "loads",
    "springs",
    "spin",
    "cycle",
];
pub(super) const UNITS: &[&str] =
    &["length", "angle", "time", "force", "mass", "torque", "inertia", "stiffness", "pressure", "power"];
pub(super) const GRAVITY: &[&str] = &["g", "direction", "acts"];
pub(super) const MASS: &[&str] = &["mass", "weight", "at", "inertia", "about", "gyration"];
pub(super) const LOAD: &[&str] =
    &["name", "on", "at", "force", "direction", "in", "torque", "pressure", "area", "bore", "rod"];
pub(super) const POINTING: &[&str] = &["from", "to", "turned", "link", "angle"];
pub(super) const SPRING: &[&str] = &["name", "between", "links", "stiffness", "free", "force"];
pub(super) const SPRING_END: &[&str] = &["link", "at"];
pub(super) const PLACED: &[&str] = &["at", "within"];
pub(super) const LOCUS: &[&str] = &["from", "distance", "direction", "square_to", "sees", "at", "on"];
pub(super) const LINK: &[&str] = &["joins", "length", "line", "sides", "turn", "shape", "arms"];
pub(super) const SLIDE: &[&str] = &["pin", "block", "link", "turned", "on", "f", "drag"];
pub(super) const GUIDE: &[&str] =
    &["link", "through", "angle", "toward", "turned", "offset", "centre", "radius"];
pub(super) const ROLL: &[&str] =
    &["links", "centres", "radii", "teeth", "module", "internal", "line", "centre", "radius", "pressure"];
pub(super) const INPUT: &[&str] =
    &["link", "angle", "omega", "alpha", "speed", "slide", "at", "velocity", "acceleration"];
pub(super) const FIND: &[&str] = &["name", "unit", "method", "first", "second"];
pub(super) const PIN: &[&str] = &["radius", "diameter", "f", "circle", "carrier"];
pub(super) const PUBLISHED: &[&str] = &["value", "within", "why"];
pub(super) const SPIN: &[&str] = &["axis", "omega", "balls", "sleeve"];
pub(super) const AXIS: &[&str] = &["through", "angle"];
pub(super) const CYCLE: &[&str] = &["torque", "load", "period", "copies", "rotating", "fluctuation"];
pub(super) const COURSE: &[&str] = &["of", "table", "harmonics"];
pub(super) const CURVE: &[&str] = &["table", "harmonics", "period"];
pub(super) const HARMONICS: &[&str] = &["constant", "sin", "cos"];
pub(super) const AREAS: &[&str] = &["areas", "scale", "total"];
pub(super) const AREA_SCALE: &[&str] = &["torque", "angle"];
pub(super) const COPIES: &[&str] = &["number", "shift"];
pub(super) const ROTATING: &[&str] = &["inertia", "mass", "weight", "gyration", "ratio"];
pub(super) const SHEET: &[&str] = &[
    "paper",
    "language",
    "symbols",
    "scales",
    "length",
    "velocity",
    "acceleration",
    "figures",
    "notation",
    "decimal",
    "theme",
    "positions",
    "other_assembly",
    "marks",
    "live",
];
pub(super) const LIVE: &[&str] = &["play_seconds", "traces", "diagrams", "scale", "panels"];
pub(super) const SCALES: &[&str] = &["length", "velocity", "acceleration", "force"];
pub(super) const RANGE: &[&str] = &["from", "to", "step"];
