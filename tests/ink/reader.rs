//! Reads a finished sheet back from its SVG: what a person with a ruler and the printed scale sees.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

/// A place or a difference on the page in millimetres, x right and **y up**.
pub type Mm2 = [f64; 2];

/// A sheet as read off.
pub struct Sheet {
    /// Metres per millimetre of the skeleton, from the printed scale.
    pub length: f64,
    /// Joints of the skeleton by name.
    pub joints: BTreeMap<String, Mm2>,
    /// Directions of guides under their riders, by rider and carrying link: `D/1`.
    pub guides: BTreeMap<String, Mm2>,
    /// Instant centres that are marked, by name, from the same origin as the joints and at the scale of these.
    pub centres: BTreeMap<String, Mm2>,
    /// Metres per millimetre of their figure.
    pub length_of_centres: f64,
    /// Velocity and acceleration polygon.
    pub velocity: Option<Polygon>,
    pub acceleration: Option<Polygon>,
}

/// A polygon as read off.
pub struct Polygon {
    /// SI units per millimetre, from the printed scale.
    pub scale: f64,
    /// Image points and feet by name; a foot may have the name of a coincident point's image (b′₂).
    pub images: BTreeMap<String, Vec<Mm2>>,
    pub vectors: Vec<Vector>,
    pub rays: Vec<Ray>,
}

/// A vector as drawn.
pub struct Vector {
    pub quantity: String,
    pub kind: String,
    /// Names of its ends.
    pub tail: String,
    pub head: String,
    /// Its two ends; none if it is drawn as a point.
    pub ends: Option<[Mm2; 2]>,
    pub claim: Option<Claim>,
}

/// A construction line as drawn.
pub struct Ray {
    pub ends: [Mm2; 2],
    pub claim: Option<Claim>,
}

/// "∥ this line" or "⊥ this line".
#[derive(Debug, Clone)]
pub struct Claim {
    pub perpendicular: bool,
    pub line: String,
}

impl Vector {
    /// From tail to head.
    pub fn along(&self) -> Option<Mm2> {
        self.ends.map(|[from, to]| minus(to, from))
    }
}

pub fn minus(a: Mm2, b: Mm2) -> Mm2 {
    [a[0] - b[0], a[1] - b[1]]
}

impl Sheet {
    /// Reads a sheet; panics with what is missing.
    pub fn read(svg: &str) -> Self {
        let document = Document::parse(svg).expect("a sheet is XML");
        let root = document.root_element();
        let panels: Vec<Node> = having(root, "panel").collect();
        let of = |class: &str| {
            let mut found = panels.iter().filter_map(|panel| {
                let drawing = panel.children().find(|n| has(*n, class))?;
                let caption = panel.children().find(|n| has(*n, "caption")).expect("a panel has a caption");
                Some((drawing, text_of(caption)))
            });
            let first = found.next();
            assert!(found.next().is_none(), "one {class} panel");
            first
        };
        let (skeleton, caption) = of("skeleton").expect("a sheet has a skeleton");
        let mut joints = BTreeMap::new();
        for joint in having(skeleton, "joint") {
            joints.insert(data(joint, "point").to_owned(), circle(joint));
        }
        let mut guides = BTreeMap::new();
        for guide in skeleton.descendants().filter(|n| n.has_attribute("data-guide")) {
            let name = data(guide, "guide");
            let rider = || name.split_once('/').and_then(|(rider, _)| joints.get(rider)).copied();
            let paths: Vec<Node> = guide.children().filter(|n| n.has_tag_name("path")).collect();
            let direction = match (paths.iter().find_map(|p| centre_of_arc(*p)), rider()) {
                (Some(centre), Some(rider)) => {
                    let [x, y] = minus(rider, centre);
                    [-y, x]
                }
                (Some(_), None) => panic!("the rider of an arc is a pin of the skeleton"),
                (None, _) => {
                    let Some(line) = paths.first() else { continue };
                    let places = path(*line);
                    minus(places[1], places[0])
                }
            };
            guides.insert(name.to_owned(), direction);
        }
        let (mut centres, mut length_of_centres) = (BTreeMap::new(), printed_ratio(&caption) / 1000.0);
        if let Some((drawing, own)) = of("instant-centres") {
            // Both panels show the same skeleton, each at its scale: from a joint of it on the way is the same.
            let joint = having(drawing, "joint").next().expect("a joint");
            let (here, there) = (circle(joint), joints[data(joint, "point")]);
            let larger = printed_ratio(&own) / printed_ratio(&caption);
            length_of_centres = printed_ratio(&own) / 1000.0;
            for centre in having(drawing, "centre").filter(|n| n.has_attribute("data-centre")) {
                let at = circle(centre);
                for name in data(centre, "centre").split(' ') {
                    let way = minus(at, here).map(|mm| larger * mm);
                    centres.insert(name.to_owned(), [there[0] + way[0], there[1] + way[1]]);
                }
            }
        }
        let polygon = |class: &str| of(class).map(|(drawing, caption)| Polygon::read(drawing, &caption));
        Self {
            length: printed_ratio(&caption) / 1000.0,
            joints,
            guides,
            centres,
            length_of_centres,
            velocity: polygon("velocity"),
            acceleration: polygon("acceleration"),
        }
    }

    /// The drawn line that a claim refers to.
    pub fn line(&self, reference: &str) -> Mm2 {
        if let Some(guide) = reference.strip_prefix("guide ") {
            return *self.guides.get(guide).unwrap_or_else(|| panic!("the sheet draws no {reference}"));
        }
        let (a, b) = reference.split_once(' ').expect("a line is named by two points");
        minus(self.joints[b], self.joints[a])
    }
}

impl Polygon {
    fn read(drawing: Node, caption: &str) -> Self {
        let scale = printed_scale(caption);
        let mut images: BTreeMap<String, Vec<Mm2>> = BTreeMap::new();
        for image in having(drawing, "image").filter(|n| n.has_attribute("data-point")) {
            images.entry(data(image, "point").to_owned()).or_default().push(circle(image));
        }
        let vectors = having(drawing, "vector").map(Vector::read).collect();
        let rays = having(drawing, "ray")
            .map(|ray| {
                let places = path(ray.children().find(|n| n.has_tag_name("path")).expect("a ray is a path"));
                Ray { ends: [places[0], places[1]], claim: claim(ray) }
            })
            .collect();
        Self { scale, images, vectors, rays }
    }

    /// The vector that stands for a quantity.
    pub fn vector(&self, quantity: &str) -> Option<&Vector> {
        self.vectors.iter().find(|v| v.quantity == quantity)
    }
}

impl Vector {
    fn read(vector: Node) -> Self {
        let part = |class: &str| vector.children().find(|n| has(*n, class)).map(path);
        let ends = if vector.attribute("data-as-point") == Some("true") {
            None
        } else {
            // The tail is the start of the shaft, the tip the first corner of the head.
            let tail = part("shaft").expect("a vector has a shaft")[0];
            Some([tail, part("head").expect("a vector has a head")[0]])
        };
        Self {
            quantity: data(vector, "quantity").to_owned(),
            kind: vector.attribute("class").unwrap().trim_start_matches("vector ").to_owned(),
            tail: data(vector, "from").to_owned(),
            head: data(vector, "to").to_owned(),
            ends,
            claim: claim(vector),
        }
    }
}

fn claim(node: Node) -> Option<Claim> {
    let line = |name| node.attribute(name).map(str::to_owned);
    let parallel = line("data-parallel").map(|line| Claim { perpendicular: false, line });
    parallel.or_else(|| line("data-perpendicular").map(|line| Claim { perpendicular: true, line }))
}

pub fn has(node: Node, class: &str) -> bool {
    node.attribute("class").is_some_and(|all| all.split(' ').any(|c| c == class))
}

pub fn having<'a>(node: Node<'a, 'a>, class: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |n| has(*n, class))
}

pub fn data<'a>(node: Node<'a, 'a>, name: &str) -> &'a str {
    let full = format!("data-{name}");
    node.attribute(full.as_str()).unwrap_or_else(|| panic!("{full} is missing"))
}

/// The centre of the circle by which a point is marked.
pub fn circle(group: Node) -> Mm2 {
    let circle =
        group.descendants().find(|n| n.has_tag_name("circle")).expect("a point is marked by a circle");
    let number = |name| -> f64 { circle.attribute(name).unwrap().parse().unwrap() };
    [number("cx"), -number("cy")]
}

/// The centre of an arc `M x y A r r 0 large sweep x y` (SVG 1.1, F.6.5).
fn centre_of_arc(node: Node) -> Option<Mm2> {
    let d = node.attribute("d")?;
    let (start, arc) = d.strip_prefix('M')?.split_once(" A")?;
    let numbers =
        |text: &str| -> Vec<f64> { text.split(' ').map(|piece| piece.parse().expect("a number")).collect() };
    let (start, arc) = (numbers(start), numbers(arc));
    let [r, _, _, large, sweep, x, y] = arc[..] else { panic!("{d}: an arc has seven numbers") };
    let half = [(start[0] - x) / 2.0, (start[1] - y) / 2.0];
    let square = half[0] * half[0] + half[1] * half[1];
    let sign = if large == sweep { -1.0 } else { 1.0 };
    let c = sign * ((r * r - square) / square).max(0.0).sqrt();
    Some([c * half[1] + f64::midpoint(start[0], x), -(f64::midpoint(start[1], y) - c * half[0])])
}

/// The places of a path of straight strokes.
pub fn path(node: Node) -> Vec<Mm2> {
    let d = node.attribute("d").expect("a path has data");
    let numbers: Vec<f64> = d
        .split(['M', 'L', 'Z', ' '])
        .filter(|piece| !piece.is_empty())
        .map(|piece| piece.parse().unwrap_or_else(|_| panic!("{d}: only straight strokes are read")))
        .collect();
    numbers.chunks_exact(2).map(|p| [p[0], -p[1]]).collect()
}

/// The characters of a text; what is set smaller and higher than its neighbour is an exponent.
pub fn text_of(text: Node) -> String {
    let mut out = String::new();
    let mut base = 0.0_f64;
    for run in text.children().filter(|n| n.has_tag_name("tspan")) {
        let size: f64 = run.attribute("font-size").unwrap().parse().unwrap();
        base = base.max(size);
        if size < 0.9 * base {
            out.push('^');
        }
        out.push_str(run.text().unwrap_or(""));
    }
    // Thin blanks part the thousands of one number.
    out.replace(['\u{2009}', '\u{202f}'], "").replace(['\u{a0}', '\u{2002}'], " ").replace('−', "-")
}

/// A printed number: 50, 2.5, 2.5 × 10^6.
fn number(words: &[&str]) -> f64 {
    let plain = |word: &str| -> f64 { word.parse().unwrap_or_else(|_| panic!("{word} is no number")) };
    match words {
        [one] => plain(one),
        [mantissa, "×", power] => {
            let exponent = power.strip_prefix("10^").expect("a power of ten");
            plain(&format!("{mantissa}e{exponent}"))
        }
        _ => panic!("{words:?} is no number"),
    }
}

/// The number that ends a list of words.
pub fn last_number(words: &[&str]) -> f64 {
    let count = if words.last().is_some_and(|w| w.starts_with("10^")) { 3 } else { 1 };
    number(&words[words.len() - count..])
}

/// Reality per paper of `scale 1 : 10`.
pub fn printed_ratio(caption: &str) -> f64 {
    let (paper, real) = caption.split_once(" : ").expect("the skeleton has a printed scale");
    let paper: Vec<&str> = paper.split_whitespace().collect();
    let real: Vec<&str> = real.split_whitespace().collect();
    number(&real) / last_number(&paper)
}

/// SI units per millimetre of `scale 50 cm/s ≡ 1 cm`.
fn printed_scale(caption: &str) -> f64 {
    let real = caption.strip_suffix(" ≡ 1 cm").expect("a polygon has a printed scale");
    let words: Vec<&str> = real.split_whitespace().collect();
    let (unit, words) = words.split_last().unwrap();
    last_number(words) * unit_si(unit) / 10.0
}

/// SI units per `cm/s²`.
fn unit_si(unit: &str) -> f64 {
    let (length, time) = unit.split_once('/').expect("a unit of velocity or acceleration");
    let length = match length {
        "nm" => 1e-9,
        "um" | "µm" => 1e-6,
        "mm" => 1e-3,
        "cm" => 1e-2,
        "m" => 1.0,
        "km" => 1e3,
        "in" => 0.0254,
        "ft" => 0.3048,
        _ => panic!("unknown unit {unit}"),
    };
    let (time, squared) = match time.strip_suffix('²') {
        Some(time) => (time, true),
        None => (time, false),
    };
    let time = match time {
        "ms" => 1e-3,
        "s" => 1.0,
        "min" => 60.0,
        _ => panic!("unknown unit {unit}"),
    };
    if squared { length / (time * time) } else { length / time }
}

#[test]
fn printed_scales_are_read() {
    assert!((printed_scale("(b) Velocity diagram, scale 50 cm/s ≡ 1 cm") - 0.05).abs() < 1e-15);
    assert!((printed_scale("(c) x, scale 2.5 × 10^6 mm/s² ≡ 1 cm") - 250.0).abs() < 1e-12);
    assert_eq!(printed_ratio("(a) Kinematic skeleton, scale 1 : 10"), 10.0);
    assert_eq!(printed_ratio("(a) Kinematic skeleton, scale 5 : 1"), 0.2);
}
