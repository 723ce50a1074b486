//! Problem 3-1 of the textbook as a hand-made construction: six links, crank 2, coupler 3, straight
//! two-arm lever 4, rod 5, slider 6. For tests of the sheet only; every number is worked out here by
//! plain vector algebra, independently of both solvers.

use crate::graphical::construction::{
    Act, Calculation, Claim, Construction, ConstructionLine, Equation, Image, Label, LinkImage, Mm2, Polygon,
    Reading, Reference, Space, Step, Term, TermDirection, Vector, VectorKind,
};
use crate::mechanism::quantity::{Answer, Asked, Order, Quantity, Unit};
use crate::mechanism::{
    Direction, Form, Given, Guide, GuidePoint, Input, Link, LinkId, Mechanism, Path, Pin, Place, Point,
    PointId, Rider, Slide,
};
use crate::scene::{Scene, SheetOptions, Title, Units};

const O2: PointId = PointId(0);
const O4: PointId = PointId(1);
const A: PointId = PointId(2);
const B: PointId = PointId(3);
const C: PointId = PointId(4);
const D: PointId = PointId(5);
const L2: LinkId = LinkId(1);
const L3: LinkId = LinkId(2);
const L4: LinkId = LinkId(3);
const L5: LinkId = LinkId(4);
const L6: LinkId = LinkId(5);

fn cm(value: f64) -> Given {
    Given::read(value * 0.01)
}

fn unit(symbol: &str, si: f64) -> Unit {
    Unit { symbol: symbol.to_owned(), si }
}

fn mechanism() -> Mechanism {
    let fixed = |x, y| Place::Fixed([cm(x), cm(y)]);
    let point = |name: &str, place, links: &[LinkId]| Point {
        name: name.to_owned(),
        place,
        links: links.to_vec(),
        journal: (name == "B").then(|| cm(0.5)),
    };
    let link = |number, points: &[PointId], form, block| Link { number, points: points.to_vec(), form, block };
    let asked = [
        ("v(A)", Quantity::Velocity(A), "cm/s", 0.01),
        ("v(B)", Quantity::Velocity(B), "cm/s", 0.01),
        ("v(B/A)", Quantity::RelativeVelocity(B, A), "cm/s", 0.01),
        ("v(C)", Quantity::Velocity(C), "cm/s", 0.01),
        ("v(D/C)", Quantity::RelativeVelocity(D, C), "cm/s", 0.01),
        ("v(D)", Quantity::Velocity(D), "cm/s", 0.01),
        ("omega(3)", Quantity::Omega(L3), "rad/s", 1.0),
        ("omega(4)", Quantity::Omega(L4), "rad/s", 1.0),
        ("omega(5)", Quantity::Omega(L5), "rad/s", 1.0),
        ("a(A)", Quantity::Acceleration(A), "cm/s^2", 0.01),
        ("a(B)", Quantity::Acceleration(B), "cm/s^2", 0.01),
        ("a(D)", Quantity::Acceleration(D), "cm/s^2", 0.01),
        ("alpha(3)", Quantity::Alpha(L3), "rad/s^2", 1.0),
        ("alpha(4)", Quantity::Alpha(L4), "rad/s^2", 1.0),
        ("alpha(5)", Quantity::Alpha(L5), "rad/s^2", 1.0),
        ("rub(B)", Quantity::Rub(B, L3, L4), "mm/s", 0.001),
    ];
    Mechanism {
        links: vec![
            link(1, &[O2, O4], Form::Placed, false),
            link(2, &[O2, A], Form::Length(cm(15.0)), false),
            link(3, &[A, B], Form::Length(cm(45.0)), false),
            link(4, &[O4, B, C], Form::Line(vec![cm(0.0), cm(30.0), cm(-30.0)]), false),
            link(5, &[C, D], Form::Length(cm(37.0)), false),
            link(6, &[D], Form::Single, true),
        ],
        points: vec![
            point("O2", fixed(0.0, 0.0), &[LinkId::FRAME, L2]),
            point("O4", fixed(45.0, 15.0), &[LinkId::FRAME, L4]),
            point("A", Place::Unknown, &[L2, L3]),
            point("B", Place::Near([0.52, -0.14]), &[L3, L4]),
            point("C", Place::Unknown, &[L4, L5]),
            point("D", Place::Near([0.01, 0.37]), &[L5, L6]),
        ],
        pins: vec![
            Pin { point: O2, links: [LinkId::FRAME, L2] },
            Pin { point: O4, links: [LinkId::FRAME, L4] },
            Pin { point: A, links: [L2, L3] },
            Pin { point: B, links: [L3, L4] },
            Pin { point: C, links: [L4, L5] },
            Pin { point: D, links: [L5, L6] },
        ],
        slides: vec![Slide {
            rider: Rider::Pin { point: D, block: Some(L6) },
            guide: Guide {
                link: LinkId::FRAME,
                path: Path::Straight {
                    through: GuidePoint::Own([cm(0.0), cm(37.0)]),
                    direction: Direction::Angle(Given::exact(0.0)),
                    turned: Given::exact(0.0),
                    offset: Given::exact(0.0),
                },
            },
        }],
        rolls: vec![],
        inputs: vec![Input::Angle {
            link: L2,
            angle: Some(Given::read(std::f64::consts::FRAC_PI_6)),
            omega: Given::read(-10.0),
            alpha: Given::exact(0.0),
        }],
        asked: asked
            .into_iter()
            .map(|(name, quantity, symbol, si)| Asked { name: name.to_owned(), quantity, unit: unit(symbol, si) })
            .collect(),
    }
}

/// The scene as its reader would deliver it.
pub(super) fn scene() -> Scene {
    Scene {
        title: Title {
            plain: Some("Problem 3-1: four-bar, two-arm rocker, rod and slider".to_owned()),
            by_language: vec![],
        },
        units: Units {
            length: unit("cm", 0.01),
            angle: unit("deg", std::f64::consts::PI / 180.0),
            time: unit("s", 1.0),
        },
        mechanism: mechanism(),
        published: vec![],
        errata: vec![],
        expect: None,
        sheet: SheetOptions::default(),
    }
}

fn add(a: Mm2, b: Mm2) -> Mm2 {
    [a[0] + b[0], a[1] + b[1]]
}

fn sub(a: Mm2, b: Mm2) -> Mm2 {
    [a[0] - b[0], a[1] - b[1]]
}

fn mul(a: Mm2, k: f64) -> Mm2 {
    [a[0] * k, a[1] * k]
}

fn left(a: Mm2) -> Mm2 {
    [-a[1], a[0]]
}

fn size(a: Mm2) -> f64 {
    libm::hypot(a[0], a[1])
}

/// s and t of s u + t v = w.
fn solve(u: Mm2, v: Mm2, w: Mm2) -> (f64, f64) {
    let det = u[0] * v[1] - u[1] * v[0];
    ((w[0] * v[1] - w[1] * v[0]) / det, (u[0] * w[1] - u[1] * w[0]) / det)
}

/// Metres per millimetre, and m/s, m/s² per millimetre, at which the problem is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scales {
    pub(super) length: f64,
    pub(super) velocity: f64,
    pub(super) acceleration: f64,
}

/// The scales of the book.
pub(super) const BOOK: Scales = Scales { length: 0.01, velocity: 0.05, acceleration: 0.5 };
/// The scales that fill an A4 page.
pub(super) const LARGE: Scales = Scales { length: 0.01, velocity: 0.025, acceleration: 0.25 };

/// The solved problem.
pub(super) fn construction(scales: Scales) -> Construction {
    // Places in metres.
    let o4 = [0.45, 0.15];
    let (sin, cos) = libm::sincos(std::f64::consts::FRAC_PI_6);
    let a = [0.15 * cos, 0.15 * sin];
    let d = sub(o4, a);
    let l = size(d);
    let along = (0.45 * 0.45 - 0.30 * 0.30 + l * l) / (2.0 * l);
    let height = (0.45 * 0.45 - along * along).sqrt();
    let e = mul(d, 1.0 / l);
    let b = sub(add(a, mul(e, along)), mul(left(e), height));
    let c = sub(mul(o4, 2.0), b);
    let dy = 0.37 - c[1];
    let d = [c[0] - (0.37_f64 * 0.37 - dy * dy).sqrt(), 0.37];
    // Velocities.
    let va = mul(left(a), -10.0);
    let (w3, w4) = {
        let (s, t) = solve(left(sub(b, a)), mul(left(sub(b, o4)), -1.0), mul(va, -1.0));
        (s, t)
    };
    let vb = mul(left(sub(b, o4)), w4);
    let vc = mul(vb, -1.0);
    let (vdx, w5) = solve([1.0, 0.0], mul(left(sub(d, c)), -1.0), vc);
    let vd = [vdx, 0.0];
    // Accelerations.
    let aa = mul(a, -100.0);
    let normal_ba = mul(sub(b, a), -w3 * w3);
    let normal_b = mul(sub(b, o4), -w4 * w4);
    let (e3, e4) = {
        let rest = sub(normal_b, add(aa, normal_ba));
        let (s, t) = solve(left(sub(b, a)), mul(left(sub(b, o4)), -1.0), rest);
        (s, t)
    };
    let ab = add(normal_b, mul(left(sub(b, o4)), e4));
    let ac = mul(ab, -1.0);
    let normal_dc = mul(sub(d, c), -w5 * w5);
    let (adx, e5) = solve([1.0, 0.0], mul(left(sub(d, c)), -1.0), add(ac, normal_dc));
    let ad = [adx, 0.0];

    let v = |p: Mm2| mul(p, 1.0 / scales.velocity);
    let w = |p: Mm2| mul(p, 1.0 / scales.acceleration);
    let x = |p: Mm2| mul(p, 1.0 / scales.length);
    let places = [[0.0, 0.0], o4, a, b, c, d];
    let image = |point| Label::Image { point, link: None };
    let foot = |point, index| Label::Foot { point, link: None, index };
    let perpendicular = |p, q| Claim::Perpendicular(Reference::Points(p, q));
    let parallel = |p, q| Claim::Parallel(Reference::Points(p, q));
    let vector = |kind, quantity, tail, head, from: Mm2, to: Mm2, claim, step| Vector {
        kind,
        quantity,
        tail,
        head,
        from,
        to,
        claim,
        as_point: size(sub(to, from)) < 1.0,
        step,
    };
    use Quantity as Q;
    use VectorKind::{Absolute, Normal, Relative, Tangential};
    let pole = Label::Pole;
    let zero = [0.0, 0.0];

    let velocity = Polygon {
        order: Order::Velocity,
        si_per_mm: scales.velocity,
        images: [(A, va), (B, vb), (C, vc), (D, vd)].map(|(p, at)| Image { label: image(p), at: v(at) }).to_vec(),
        vectors: vec![
            vector(Absolute, Q::Velocity(A), pole, image(A), zero, v(va), Some(perpendicular(O2, A)), 4),
            vector(Absolute, Q::Velocity(B), pole, image(B), zero, v(vb), Some(perpendicular(O4, B)), 5),
            vector(
                Relative,
                Q::RelativeVelocity(B, A),
                image(A),
                image(B),
                v(va),
                v(vb),
                Some(perpendicular(A, B)),
                5,
            ),
            vector(Absolute, Q::Velocity(C), pole, image(C), zero, v(vc), None, 6),
            vector(
                Absolute,
                Q::Velocity(D),
                pole,
                image(D),
                zero,
                v(vd),
                Some(Claim::Parallel(Reference::Guide(0))),
                7,
            ),
            vector(
                Relative,
                Q::RelativeVelocity(D, C),
                image(C),
                image(D),
                v(vc),
                v(vd),
                Some(perpendicular(C, D)),
                7,
            ),
        ],
        lines: vec![
            ConstructionLine::Ray { from: zero, to: v(vb), claim: Some(perpendicular(O4, B)), step: 5 },
            ConstructionLine::Ray { from: v(va), to: v(vb), claim: Some(perpendicular(A, B)), step: 5 },
            ConstructionLine::Ray {
                from: zero,
                to: v(vd),
                claim: Some(Claim::Parallel(Reference::Guide(0))),
                step: 7,
            },
            ConstructionLine::Ray { from: v(vc), to: v(vd), claim: Some(perpendicular(C, D)), step: 7 },
        ],
        link_images: vec![],
    };
    let b2 = add(aa, normal_ba);
    let d1 = add(ac, normal_dc);
    let acceleration = Polygon {
        order: Order::Acceleration,
        si_per_mm: scales.acceleration,
        images: [
            (image(A), aa),
            (foot(B, 1), normal_b),
            (foot(B, 2), b2),
            (image(B), ab),
            (image(C), ac),
            (foot(D, 1), d1),
            (image(D), ad),
        ]
        .map(|(label, at)| Image { label, at: w(at) })
        .to_vec(),
        vectors: vec![
            vector(Absolute, Q::Acceleration(A), pole, image(A), zero, w(aa), Some(parallel(A, O2)), 8),
            vector(Normal, Q::Normal(B), pole, foot(B, 1), zero, w(normal_b), Some(parallel(B, O4)), 9),
            vector(
                Normal,
                Q::RelativeNormal(B, A),
                image(A),
                foot(B, 2),
                w(aa),
                w(b2),
                Some(parallel(B, A)),
                9,
            ),
            vector(
                Tangential,
                Q::Tangential(B),
                foot(B, 1),
                image(B),
                w(normal_b),
                w(ab),
                Some(perpendicular(O4, B)),
                9,
            ),
            vector(
                Tangential,
                Q::RelativeTangential(B, A),
                foot(B, 2),
                image(B),
                w(b2),
                w(ab),
                Some(perpendicular(A, B)),
                9,
            ),
            vector(Absolute, Q::Acceleration(B), pole, image(B), zero, w(ab), None, 9),
            vector(Relative, Q::RelativeAcceleration(B, A), image(A), image(B), w(aa), w(ab), None, 9),
            vector(Absolute, Q::Acceleration(C), pole, image(C), zero, w(ac), None, 10),
            vector(
                Normal,
                Q::RelativeNormal(D, C),
                image(C),
                foot(D, 1),
                w(ac),
                w(d1),
                Some(parallel(D, C)),
                11,
            ),
            vector(
                Tangential,
                Q::RelativeTangential(D, C),
                foot(D, 1),
                image(D),
                w(d1),
                w(ad),
                Some(perpendicular(C, D)),
                11,
            ),
            vector(
                Absolute,
                Q::Acceleration(D),
                pole,
                image(D),
                zero,
                w(ad),
                Some(Claim::Parallel(Reference::Guide(0))),
                11,
            ),
        ],
        lines: vec![
            ConstructionLine::Ray { from: w(normal_b), to: w(ab), claim: Some(perpendicular(O4, B)), step: 9 },
            ConstructionLine::Ray { from: w(b2), to: w(ab), claim: Some(perpendicular(A, B)), step: 9 },
            ConstructionLine::Ray { from: w(d1), to: w(ad), claim: Some(perpendicular(C, D)), step: 11 },
            ConstructionLine::Ray {
                from: zero,
                to: w(ad),
                claim: Some(Claim::Parallel(Reference::Guide(0))),
                step: 11,
            },
        ],
        link_images: vec![],
    };
    let space = Space {
        metres_per_mm: scales.length,
        places: places.iter().map(|p| Some(x(*p))).collect(),
        lines: vec![
            ConstructionLine::Arc { centre: x(a), radius: 0.45 / scales.length, at: x(b), step: 2 },
            ConstructionLine::Arc { centre: x(o4), radius: 0.30 / scales.length, at: x(b), step: 2 },
            ConstructionLine::Arc { centre: x(c), radius: 0.37 / scales.length, at: x(d), step: 3 },
        ],
    };

    let term = |quantity, magnitude: Option<f64>, direction| Term { quantity, magnitude, direction };
    let found = Some(TermDirection::Found);
    let claim = |c| Some(TermDirection::Claim(c));
    let guide = claim(Claim::Parallel(Reference::Guide(0)));
    let read = |vector, value: Mm2, scale: f64| Act::ReadVector { vector, mm: size(value) / scale, value: size(value) };
    let read_v = |i, value| read(i, value, scales.velocity);
    let read_a = |i, value| read(i, value, scales.acceleration);
    let step = |order, links: &[LinkId], equations, acts| Step { order, links: links.to_vec(), equations, acts };
    let steps = vec![
        step(Order::Position, &[], vec![], vec![Act::MarkPlaces]),
        step(Order::Position, &[L2], vec![], vec![Act::LayOffLink {
            link: L2,
            from: O2,
            to: A,
            angle: std::f64::consts::FRAC_PI_6,
            length: 0.15,
        }]),
        step(Order::Position, &[L3, L4], vec![], vec![
            Act::StrikeArc { centre: A, to: B, radius: 0.45 },
            Act::StrikeArc { centre: O4, to: B, radius: 0.30 },
            Act::MarkIntersection { point: B, crossing: 1.2 },
            Act::TransferPoint { link: L4, point: C },
        ]),
        step(Order::Position, &[L5, L6], vec![], vec![
            Act::DrawGuide { slide: 0 },
            Act::StrikeArc { centre: C, to: D, radius: 0.37 },
            Act::MarkIntersection { point: D, crossing: 1.37 },
        ]),
        step(Order::Velocity, &[], vec![], vec![
            Act::MarkPole,
            Act::Calculate(Calculation::Speed {
                quantity: Q::Velocity(A),
                link: L2,
                ends: [O2, A],
                omega: -10.0,
                length: 0.15,
                value: size(va),
            }),
            Act::LayOffVector { vector: 0, value: size(va), mm: size(va) / scales.velocity },
        ]),
        step(
            Order::Velocity,
            &[L3, L4],
            vec![Equation {
                left: vec![term(Q::Velocity(B), None, claim(perpendicular(O4, B)))],
                right: vec![
                    term(Q::Velocity(A), Some(size(va)), found),
                    term(Q::RelativeVelocity(B, A), None, claim(perpendicular(A, B))),
                ],
            }],
            vec![
                Act::DrawRay { from: pole, claim: perpendicular(O4, B) },
                Act::DrawRay { from: image(A), claim: perpendicular(A, B) },
                Act::MarkMeet { label: image(B), crossing: 1.2 },
                read_v(1, vb),
                read_v(2, sub(vb, va)),
                Act::Calculate(Calculation::Omega {
                    link: L3,
                    quantity: Q::RelativeVelocity(B, A),
                    ends: [A, B],
                    speed: size(sub(vb, va)),
                    length: 0.45,
                    value: w3,
                }),
                Act::Calculate(Calculation::Omega {
                    link: L4,
                    quantity: Q::Velocity(B),
                    ends: [O4, B],
                    speed: size(vb),
                    length: 0.30,
                    value: w4,
                }),
            ],
        ),
        step(Order::Velocity, &[L4], vec![], vec![
            Act::DivideImage { label: image(C), from: pole, to: image(B), ratio: -1.0 },
            read_v(3, vc),
        ]),
        step(
            Order::Velocity,
            &[L5, L6],
            vec![Equation {
                left: vec![term(Q::Velocity(D), None, guide)],
                right: vec![
                    term(Q::Velocity(C), Some(size(vc)), found),
                    term(Q::RelativeVelocity(D, C), None, claim(perpendicular(C, D))),
                ],
            }],
            vec![
                Act::DrawRay { from: pole, claim: Claim::Parallel(Reference::Guide(0)) },
                Act::DrawRay { from: image(C), claim: perpendicular(C, D) },
                Act::MarkMeet { label: image(D), crossing: 1.37 },
                read_v(4, vd),
                read_v(5, sub(vd, vc)),
                Act::Calculate(Calculation::Omega {
                    link: L5,
                    quantity: Q::RelativeVelocity(D, C),
                    ends: [C, D],
                    speed: size(sub(vd, vc)),
                    length: 0.37,
                    value: w5,
                }),
                Act::Calculate(Calculation::Rub {
                    pin: B,
                    links: [L3, L4],
                    radius: 0.005,
                    first: w3,
                    second: w4,
                    value: 0.005 * (w3 - w4).abs(),
                }),
            ],
        ),
        step(Order::Acceleration, &[], vec![], vec![
            Act::MarkPole,
            Act::Calculate(Calculation::Normal {
                quantity: Q::Acceleration(A),
                velocity: Q::Velocity(A),
                ends: [O2, A],
                speed: size(va),
                length: 0.15,
                value: size(aa),
            }),
            Act::LayOffVector { vector: 0, value: size(aa), mm: size(aa) / scales.acceleration },
        ]),
        step(
            Order::Acceleration,
            &[L3, L4],
            vec![Equation {
                left: vec![
                    term(Q::Normal(B), Some(size(normal_b)), claim(parallel(B, O4))),
                    term(Q::Tangential(B), None, claim(perpendicular(O4, B))),
                ],
                right: vec![
                    term(Q::Acceleration(A), Some(size(aa)), found),
                    term(Q::RelativeNormal(B, A), Some(size(normal_ba)), claim(parallel(B, A))),
                    term(Q::RelativeTangential(B, A), None, claim(perpendicular(A, B))),
                ],
            }],
            vec![
                Act::Calculate(Calculation::Normal {
                    quantity: Q::Normal(B),
                    velocity: Q::Velocity(B),
                    ends: [O4, B],
                    speed: size(vb),
                    length: 0.30,
                    value: size(normal_b),
                }),
                Act::LayOffVector { vector: 1, value: size(normal_b), mm: size(normal_b) / scales.acceleration },
                Act::Calculate(Calculation::Normal {
                    quantity: Q::RelativeNormal(B, A),
                    velocity: Q::RelativeVelocity(B, A),
                    ends: [A, B],
                    speed: size(sub(vb, va)),
                    length: 0.45,
                    value: size(normal_ba),
                }),
                Act::LayOffVector {
                    vector: 2,
                    value: size(normal_ba),
                    mm: size(normal_ba) / scales.acceleration,
                },
                Act::DrawRay { from: foot(B, 1), claim: perpendicular(O4, B) },
                Act::DrawRay { from: foot(B, 2), claim: perpendicular(A, B) },
                Act::MarkMeet { label: image(B), crossing: 1.2 },
                read_a(3, sub(ab, normal_b)),
                read_a(4, sub(ab, b2)),
                Act::Calculate(Calculation::Alpha {
                    link: L3,
                    quantity: Q::RelativeTangential(B, A),
                    ends: [A, B],
                    tangential: size(sub(ab, b2)),
                    length: 0.45,
                    value: e3,
                }),
                Act::Calculate(Calculation::Alpha {
                    link: L4,
                    quantity: Q::Tangential(B),
                    ends: [O4, B],
                    tangential: size(sub(ab, normal_b)),
                    length: 0.30,
                    value: e4,
                }),
                read_a(5, ab),
            ],
        ),
        step(Order::Acceleration, &[L4], vec![], vec![
            Act::DivideImage { label: image(C), from: pole, to: image(B), ratio: -1.0 },
            read_a(7, ac),
        ]),
        step(
            Order::Acceleration,
            &[L5, L6],
            vec![Equation {
                left: vec![term(Q::Acceleration(D), None, guide)],
                right: vec![
                    term(Q::Acceleration(C), Some(size(ac)), found),
                    term(Q::RelativeNormal(D, C), Some(size(normal_dc)), claim(parallel(D, C))),
                    term(Q::RelativeTangential(D, C), None, claim(perpendicular(C, D))),
                ],
            }],
            vec![
                Act::Calculate(Calculation::Normal {
                    quantity: Q::RelativeNormal(D, C),
                    velocity: Q::RelativeVelocity(D, C),
                    ends: [C, D],
                    speed: size(sub(vd, vc)),
                    length: 0.37,
                    value: size(normal_dc),
                }),
                Act::LayOffVector {
                    vector: 8,
                    value: size(normal_dc),
                    mm: size(normal_dc) / scales.acceleration,
                },
                Act::DrawRay { from: foot(D, 1), claim: perpendicular(C, D) },
                Act::DrawRay { from: pole, claim: Claim::Parallel(Reference::Guide(0)) },
                Act::MarkMeet { label: image(D), crossing: 1.37 },
                read_a(9, sub(ad, d1)),
                read_a(10, ad),
                Act::Calculate(Calculation::Alpha {
                    link: L5,
                    quantity: Q::RelativeTangential(D, C),
                    ends: [C, D],
                    tangential: size(sub(ad, d1)),
                    length: 0.37,
                    value: e5,
                }),
            ],
        ),
    ];

    let answers = mechanism()
        .asked
        .iter()
        .map(|asked| {
            let v2 = |value: Mm2| Answer::Vector { value, bound: 0.0 };
            let s = |value: f64| Answer::Scalar { value, bound: 0.0 };
            let answer = match asked.quantity {
                Q::Velocity(A) => v2(va),
                Q::Velocity(B) => v2(vb),
                Q::Velocity(C) => v2(vc),
                Q::Velocity(_) => v2(vd),
                Q::RelativeVelocity(B, _) => v2(sub(vb, va)),
                Q::RelativeVelocity(..) => v2(sub(vd, vc)),
                Q::Acceleration(A) => v2(aa),
                Q::Acceleration(B) => v2(ab),
                Q::Acceleration(_) => v2(ad),
                Q::Omega(L3) => s(w3),
                Q::Omega(L4) => s(w4),
                Q::Omega(_) => s(w5),
                Q::Alpha(L3) => s(e3),
                Q::Alpha(L4) => s(e4),
                Q::Alpha(_) => s(e5),
                _ => s(0.005 * (w3 - w4).abs()),
            };
            Reading { answer, drawn_mm: None }
        })
        .collect();
    let link_image = |from: &Polygon, points: &[PointId]| LinkImage {
        link: L4,
        corners: points
            .iter()
            .filter_map(|p| {
                let at = from.images.iter().find(|i| i.label == image(*p)).map(|i| i.at);
                Some((*p, at.or_else(|| (*p == O4).then_some(zero))?))
            })
            .collect(),
    };
    let mut velocity = velocity;
    velocity.link_images.push(link_image(&velocity, &[O4, B, C]));
    let mut acceleration = acceleration;
    acceleration.link_images.push(link_image(&acceleration, &[O4, B, C]));
    Construction { space, velocity: Some(velocity), acceleration: Some(acceleration), steps, answers }
}
