//! Every word of the sheet, one table per language, complete in each by construction.
//!
//! `{names}` in braces are filled with formulas; their order is the language's own.

/// A language of the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
}

impl Language {
    /// All languages.
    pub const ALL: [Self; 1] = [Self::English];

    /// The language of a tag (`en`, `en-GB`).
    #[must_use]
    pub fn from_tag(tag: &str) -> Option<Self> {
        let exact = Self::ALL.into_iter().find(|l| l.words().tag.eq_ignore_ascii_case(tag));
        let primary = tag.split('-').next().unwrap_or(tag);
        exact.or_else(|| Self::ALL.into_iter().find(|l| l.words().tag.eq_ignore_ascii_case(primary)))
    }

    /// The tags of all languages.
    #[must_use]
    pub fn tags() -> Vec<&'static str> {
        Self::ALL.iter().map(|l| l.words().tag).collect()
    }

    /// Its words.
    #[must_use]
    pub const fn words(self) -> &'static Words {
        match self {
            Self::English => &ENGLISH,
        }
    }
}

/// The words of one language.
#[derive(Debug)]
#[allow(missing_docs, reason = "each field is named after the sentence it holds")]
pub struct Words {
    /// Language tag.
    pub tag: &'static str,

    // Titles and captions.
    pub untitled: &'static str,
    pub description: &'static str,
    pub skeleton: &'static str,
    pub velocity_diagram: &'static str,
    pub acceleration_diagram: &'static str,
    pub circle_diagram: &'static str,
    pub centres_figure: &'static str,
    pub steps: &'static str,
    pub results: &'static str,
    pub given: &'static str,
    pub given_guide: &'static str,
    pub scale: &'static str,
    pub page: &'static str,

    // Heads of tables, senses and places.
    pub quantity: &'static str,
    pub value: &'static str,
    pub sense: &'static str,
    pub magnitude: &'static str,
    pub direction: &'static str,
    pub unknown: &'static str,
    pub cw: &'static str,
    pub ccw: &'static str,
    pub at_infinity: &'static str,
    pub guide_of: &'static str,
    pub guide_of_link: &'static str,
    pub rubbing_mark: &'static str,

    // Why something is not determined.
    pub dead_centre: &'static str,
    pub not_determined: &'static str,
    pub undefined: &'static str,

    // Heads of steps.
    pub link: &'static str,
    pub links: &'static str,
    pub and: &'static str,
    pub step_frame: &'static str,
    pub step_place: &'static str,
    pub step_velocity_pole: &'static str,
    pub step_velocity: &'static str,
    pub step_acceleration_pole: &'static str,
    pub step_acceleration: &'static str,
    pub step_rubbing: &'static str,

    // Acts.
    pub mark_places: &'static str,
    pub lay_off_link: &'static str,
    pub strike_arc: &'static str,
    pub draw_guide: &'static str,
    pub mark_intersection: &'static str,
    pub flat_crossing: &'static str,
    pub transfer_point: &'static str,
    pub mark_contact: &'static str,
    pub try_position_rod: &'static str,
    pub try_position_guide: &'static str,
    pub try_position_angle: &'static str,
    pub try_polygon: &'static str,
    pub trial_rate: &'static str,
    pub measure_length: &'static str,
    pub mark_pole: &'static str,
    pub lay_off_vector: &'static str,
    pub vector_as_point: &'static str,
    pub head_first: &'static str,
    pub coriolis_rule: &'static str,
    pub in_sense_of: &'static str,
    pub draw_ray: &'static str,
    pub mark_meet: &'static str,
    pub divide_image: &'static str,
    pub complete_image: &'static str,
    pub same_image: &'static str,
    pub read_vector: &'static str,
    pub translation: &'static str,

    // The circle diagram.
    pub step_centres: &'static str,
    pub centre_count: &'static str,
    pub primary_centres: &'static str,
    pub centre_meet: &'static str,
    pub centre_parallel: &'static str,
    pub common_normal: &'static str,
    pub centre_by_velocity: &'static str,
    pub centre_by_rates: &'static str,
    pub centre_stalled: &'static str,
}

const ENGLISH: Words = Words {
    tag: "en",

    untitled: "Planar mechanism",
    description: "Graphical solution of a planar mechanism: {what}.",
    skeleton: "Kinematic skeleton",
    velocity_diagram: "Velocity diagram",
    acceleration_diagram: "Acceleration diagram",
    circle_diagram: "Circle diagram",
    centres_figure: "Instant centres",
    steps: "Steps",
    results: "Results",
    given: "Given:",
    given_guide: "{guide} through {place} at {angle}",
    scale: "scale {scale}",
    page: "page {page} of {pages}",

    quantity: "quantity",
    value: "value",
    sense: "sense, direction",
    magnitude: "magnitude",
    direction: "direction",
    unknown: "?",
    cw: "cw",
    ccw: "ccw",
    at_infinity: "at infinity",
    guide_of: "guide of {point}",
    guide_of_link: "guide of link {link}",
    rubbing_mark: "rub",

    dead_centre: "dead centre",
    not_determined: "not determined here",
    undefined: "does not exist here",

    link: "link {links}",
    links: "links {links}",
    and: " and ",
    step_frame: "Frame and input",
    step_place: "Position of {links}",
    step_velocity_pole: "Velocity: the pole and the input",
    step_velocity: "Velocity of {links}",
    step_acceleration_pole: "Acceleration: the pole and the input",
    step_acceleration: "Acceleration of {links}",
    step_rubbing: "Rubbing speeds",

    mark_places: "Mark {points} to the scale {scale}.",
    lay_off_link: "At {from} lay off {length} = {value} ({mm}) at {angle} to the horizontal: {to}.",
    strike_arc: "About {centre} strike an arc with the radius {length} = {value} ({mm}).",
    draw_guide: "Draw the {guide}.",
    mark_intersection: "The lines meet in {point}.",
    flat_crossing: "They cross at only {angle}: badly readable by hand.",
    transfer_point: "Transfer {point} of link {link}.",
    mark_contact: "Mark the contact point {point}.",
    try_position_rod: "No dyad of this group is solvable alone. Turn link {link} by trial; {near} runs along its trial curve. Take the position in which {length} has its given length.",
    try_position_guide: "No dyad of this group is solvable alone. Turn link {link} by trial; {near} runs along its trial curve. Take the position in which it lies on its guide.",
    try_position_angle: "No dyad of this group is solvable alone. Turn link {link} by trial. Take the position in which link {driven} has its given angle.",
    try_polygon: "Draw two trial polygons: with {rate} = 0 and with {rate} = {value}. The sought image lies on the line through the two trial images.",
    trial_rate: "By proportion {rate} = {value}; with it draw the polygon.",
    measure_length: "Measured: {length} = {mm}, that is {value}.",
    mark_pole: "Choose the pole {pole}; it is the image of the whole frame.",
    lay_off_vector: "Lay off {vector} = {image} = {mm}, {direction}.",
    vector_as_point: "{vector} measures {mm} on paper: drawn as a point, {tail} and {head} coincide.",
    head_first: "its head at {head}",
    coriolis_rule: "{omega} is that of link {link}, which carries the guide; {slip} turned by 90° in the sense of {omega} ({sense}) gives the direction.",
    in_sense_of: "in the sense of {rotation}",
    draw_ray: "Through {from} draw a line {direction}.",
    mark_meet: "The lines meet in {label}.",
    divide_image: "Divide {image} as the link is divided: {part} : {image} = {ratio} gives {label}.",
    complete_image: "On {base} complete the image of link {link}, similar and of the same reading sense: {label}.",
    same_image: "{label} falls on {with}.",
    read_vector: "Read {vector} = {image}: {reading}.",
    translation: "Link {link} only translates: {omega} = 0.",

    step_centres: "Instant centres",
    centre_count: "N = {n} ({n} − 1) / 2 = {count} centres.",
    primary_centres: "Primary centres, seen from the pairs: {centres}.",
    centre_meet: "{centre}, triangles {triangles}: the lines {first} and {second} meet there.",
    centre_parallel: "{centre}, triangles {triangles}: the lines {first} and {second} are parallel; it lies at infinity.",
    common_normal: "normal to the {guide}",
    centre_by_velocity: "{centre}: the circle diagram stalls here. The centre lies on the normal to {velocity} through {point}, at the distance {velocity} / {omega}, both from the velocity diagram.",
    centre_by_rates: "{centre}: the circle diagram stalls here. The centre divides the line {first}{second} inversely as {one} and {other} of the velocity diagram.",
    centre_stalled: "{centre}: no two triangles lead to it.",
};
