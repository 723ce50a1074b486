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
    pub lay_off_from_centre: &'static str,
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

    // Velocities from centres.
    pub transfer_figure: &'static str,
    pub method_centres: &'static str,
    pub method_line_of_centres: &'static str,
    pub method_link_to_link: &'static str,
    pub method_gauge_line: &'static str,
    pub method_klein: &'static str,
    pub by_direct_method: &'static str,
    pub by_line_of_centres: &'static str,
    pub by_link_to_link: &'static str,
    pub by_gauge_line: &'static str,
    pub transfer_ratio: &'static str,
    pub transfer_common: &'static str,
    pub transfer_about_pole: &'static str,
    pub transfer_translation: &'static str,
    pub transfer_gauge: &'static str,
    pub transfer_parallel: &'static str,
    pub transfer_parallel_flat: &'static str,
    pub transfer_omega: &'static str,
    pub transfer_omega_by_parallel: &'static str,
    // Constructions on the skeleton.
    pub auxiliary_figure: &'static str,
    pub klein_figure: &'static str,
    pub klein_crank: &'static str,
    pub klein_crank_accelerations: &'static str,
    pub klein_across: &'static str,
    pub klein_chord: &'static str,
    pub klein_tangent: &'static str,
    pub klein_gathering: &'static str,
    pub klein_along: &'static str,
    pub klein_turned: &'static str,
    pub klein_reversed: &'static str,
    pub inflection_figure: &'static str,
    pub inflection_normals: &'static str,
    pub inflection_chord: &'static str,
    pub inflection_tangent: &'static str,
    pub inflection_straight: &'static str,
    pub inflection_toward: &'static str,
    pub inflection_away: &'static str,
    pub centre_of_guide: &'static str,
    pub inflection_circle: &'static str,
    pub acceleration_centre: &'static str,
    pub acceleration_centre_steady: &'static str,
    pub kennedy_figure: &'static str,
    pub kennedy_trial: &'static str,
    pub kennedy_velocities: &'static str,
    pub kennedy_line: &'static str,
    pub rotation_figure: &'static str,
    pub rotation_other: &'static str,
    pub rotation_bisectors: &'static str,
    pub rotation_angle: &'static str,
    pub centrodes_figure: &'static str,
    pub centrode_in: &'static str,
    pub centrodes_loci: &'static str,
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
    lay_off_from_centre: "From the instant centre {centre}: {vector} = {value}; lay off {image} = {mm}.",
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

    transfer_figure: "Velocities from instant centres",
    method_centres: "centres",
    method_line_of_centres: "line of centres",
    method_link_to_link: "link to link",
    method_gauge_line: "gauge line",
    method_klein: "Klein",
    by_direct_method: "{quantity} by the direct method",
    by_line_of_centres: "{quantity} by the line of centres",
    by_link_to_link: "{quantity} from link to link",
    by_gauge_line: "{quantity} by gauge lines",
    transfer_ratio: "{common} has one velocity in both links: {omega} = {known} · {first} / {second} = {known_value} · {a} / {b} = {value}.",
    transfer_common: "{centre} has one velocity in links {one} and {other}: {velocity} = {omega} {distance} = {omega_value} · {length} = {value}.",
    transfer_about_pole: "{velocity} = {omega} {distance} = {omega_value} · {length} = {value}, square to that radius.",
    transfer_translation: "The pole of link {link} is at infinity: it only translates, with {value}.",
    transfer_gauge: "Gauge line from the pole through the tip of {known}; {point} turned onto the line of centres; there {velocity} = {mm}, that is {value}, turned back.",
    transfer_parallel: "Turn {known} by 90° onto the line from {from} to {pole}: {from}′. The parallel to {line} through it meets the line from {to} to {pole} in {to}′; {to}{to}′ is {velocity} turned: {mm}, that is {value}.",
    transfer_parallel_flat: "{from}, {to} and {pole} are in one line: {velocity} is to {known} as the distances from {pole}; {mm}, that is {value}.",
    transfer_omega: "{omega} = {velocity} / {distance} = {speed} / {length} = {value}.",
    transfer_omega_by_parallel: "{from}′{to}′ = {a} and {line} = {b}: what it is longer by, at the velocity scale, over {line} gives {omega} = {value}.",
    auxiliary_figure: "Construction on the skeleton",
    klein_figure: "Klein’s construction on link {link}",
    klein_crank: "The crank {crank} is the image of {velocity}, turned back by 90°: {pole} falls on {pivot}, {image} on {pin}. With {omega} = {rate} the scale of velocities is {scale}.",
    klein_crank_accelerations: "The crank is also the image of the normal acceleration of its pin: {pole}, {image}. With {omega}² the scale of accelerations is {scale}.",
    klein_across: "Through {pole} draw a line square to the {guide}. It meets {rod}, produced if need be, in {image}.",
    klein_chord: "Strike a circle on {rod} as diameter, and about {pin} a circle with the radius {opening}. Their common chord is square to {rod} and cuts it in {foot}.",
    klein_tangent: "{opening} is longer than {rod}. Square to {rod} in {end} draw a line to the circle about {pin} with the radius {opening}. The tangent there meets {rod} produced in {foot}.",
    klein_gathering: "The crank gathers or loses speed. At {pin} lay off {mm} square to it against the sense of {alpha}, {alpha}/{omega}² times {crank}: {image}. The normal part of the rod moves along, and its end {foot} with it.",
    klein_along: "Through {foot} draw a line square to {rod}, through {pole} a line along the {guide}. They meet in {image}.",
    klein_turned: "Velocities are read turned by 90° in the sense of {omega}.",
    klein_reversed: "Accelerations are read backwards: {acceleration} from {image} to {pole}.",
    inflection_figure: "Inflection circle of link {link}",
    inflection_normals: "The path normals of {first} and {second} meet in {pole}, the pole of link {link}.",
    inflection_chord: "{centre} is the centre of curvature of the path of {point}. Strike a circle on {radius} as diameter, and about {point} a circle through {pole}. Their common chord cuts {radius} in {found}.",
    inflection_tangent: "{centre} is the centre of curvature of the path of {point}, nearer than {pole}. Square to {radius} in {centre} draw a line to the circle about {point} through {pole}. The tangent there meets {radius} produced in {found}. Draw a line square to it there.",
    inflection_straight: "{point} runs straight: it is its own {found}. Draw the line of its guide.",
    inflection_toward: "From {point} lay off {normal}/{omega}² = {mm} toward {pole}: {found}. Draw a line square to it there.",
    inflection_away: "From {point} lay off {normal}/{omega}² = {mm} away from {pole}: {found}. Draw a line square to it there.",
    centre_of_guide: "the centre of the {guide}",
    inflection_circle: "The lines square to the pole rays at {first} and {second} meet in the inflection pole {summit}. The circle on {pole}{summit} = {mm}, that is {value}, is the inflection circle: its points run straight here.",
    acceleration_centre: "{alpha}/{omega}² = {ratio} is the tangent of {angle}. At {pole} lay off this angle from {pole}{summit}, {sense}. It meets the circle in {centre}, the point of link {link} without acceleration.",
    acceleration_centre_steady: "{alpha} = 0: the acceleration centre {centre} falls on {summit}.",
    kennedy_figure: "Kennedy’s theorem on {links}",
    kennedy_trial: "{first} and {second} are known. Suppose that {third} lies off their line, in {trial}.",
    kennedy_velocities: "Against link {base}, {trial} moves as a point of link {one} square to {first}, and as a point of link {other} square to {second}. These directions differ.",
    kennedy_line: "Both links have one velocity only on the line {line}: there lies {third}.",
    rotation_figure: "Centre of a finite rotation of link {link}",
    rotation_other: "Draw the position for the input at {value}, dashed.",
    rotation_bisectors: "The perpendicular bisectors of {first} and {second} meet in {centre}.",
    rotation_angle: "Link {link} turns about {centre} by {angle} {sense} from {before} to {after}, measured.",
    centrodes_figure: "Centrodes of {centre}",
    centrode_in: "locus in link {link}",
    centrodes_loci: "The locus of {centre} in link {fixed} is solid, that in link {moving} dashed. They touch in {centre}, and the second rolls on the first. The curves hold within {within}.",
};
