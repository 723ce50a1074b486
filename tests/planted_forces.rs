//! Students of the test's own making balance slider-cranks, four-bars and turning-moment diagrams, with a pencil that
//! slips and one mistake each. Everything here is in closed form: no diagram, group or balance is shared with the grader.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeMap;

use linkgram::grade::{self, Verdict};
use linkgram::scene;

use crate::common::plane::{Xy, cross, long as size, minus, plus, times, unit};

/// Dice.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as f64) / f64::from(1_u32 << 31)
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.roll()
    }
}

/// A number of a scene, as it is written there.
fn rounded(value: f64, digits: i32) -> f64 {
    let ten = (0..digits.abs()).fold(1.0, |ten, _| 10.0 * ten);
    let one = if digits < 0 { 1.0 / ten } else { ten };
    (value * one).round() / one
}

/// What one student does otherwise than he should.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Mistake {
    None,
    AlongAcceleration,
    OtherSide,
    WithAlpha,
    WeightAsMass,
    MassAsWeight,
    Reaction,
    HandedOn,
    ArmToPin,
    DrawingArm,
    OutOfPolygon,
    OutOfMoments,
    LeftOut,
    NotSquare,
    Given,
    NoStatic,
    LoadsInShaking,
}

impl Mistake {
    const ALL: [Self; 16] = [
        Self::AlongAcceleration,
        Self::OtherSide,
        Self::WithAlpha,
        Self::WeightAsMass,
        Self::MassAsWeight,
        Self::Reaction,
        Self::HandedOn,
        Self::ArmToPin,
        Self::DrawingArm,
        Self::OutOfPolygon,
        Self::OutOfMoments,
        Self::LeftOut,
        Self::NotSquare,
        Self::Given,
        Self::NoStatic,
        Self::LoadsInShaking,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::None => "(right)",
            Self::AlongAcceleration => "inertia-along-acceleration",
            Self::OtherSide => "offset-other-side",
            Self::WithAlpha => "inertia-torque-with-alpha",
            Self::WeightAsMass => "weight-as-mass",
            Self::MassAsWeight => "mass-as-weight",
            Self::Reaction | Self::HandedOn => "reaction-for-action",
            Self::ArmToPin => "arm-to-pin",
            Self::DrawingArm => "arm-in-drawing-units",
            Self::OutOfPolygon | Self::OutOfMoments | Self::LeftOut => "force-left-out",
            Self::NotSquare => "guide-force-not-square",
            Self::Given => "given-for-needed",
            Self::NoStatic => "static-part-left-out",
            Self::LoadsInShaking => "loads-in-shaking-force",
        }
    }
}

impl Mistake {
    fn told(self) -> &'static str {
        match self {
            Self::None => "slider-crank (right)",
            Self::AlongAcceleration => "slider-crank: inertia along the acceleration",
            Self::OtherSide => "slider-crank: h to the other side",
            Self::WithAlpha => "slider-crank: torque with the acceleration",
            Self::WeightAsMass => "slider-crank: weight as mass",
            Self::MassAsWeight => "slider-crank: mass as weight",
            Self::Reaction => "slider-crank: reaction written down",
            Self::HandedOn => "slider-crank: reaction used",
            Self::ArmToPin => "slider-crank: arm to the pin",
            Self::DrawingArm => "slider-crank: arm of the drawing",
            Self::OutOfPolygon => "slider-crank: left out of a polygon",
            Self::OutOfMoments => "slider-crank: left out of moments",
            Self::LeftOut => "slider-crank: left out of a body's polygon",
            Self::NotSquare => "slider-crank: guide not square",
            Self::Given => "slider-crank: given for needed",
            Self::NoStatic => "slider-crank: without static part",
            Self::LoadsInShaking => "slider-crank: loads in the shaking force",
        }
    }

    fn of_four_bar(self) -> &'static str {
        match self {
            Self::None => "four-bar (right)",
            Self::AlongAcceleration => "four-bar: inertia along the acceleration",
            Self::OtherSide => "four-bar: h to the other side",
            Self::Reaction => "four-bar: reaction written down",
            Self::ArmToPin => "four-bar: arm to the pin",
            Self::OutOfMoments => "four-bar: left out of moments",
            Self::NoStatic => "four-bar: without static part",
            _ => "four-bar: another",
        }
    }
}

/// Paper: 1:2, so many newtons for a millimetre, and the largest slip of the pencil, mm.
const SCALE: f64 = 2.0;
const NEWTONS: f64 = 5.0;
const SLIP: f64 = 0.15;
const G: f64 = 9.81;

/// A crank, a rod and a block on an inclined guide, with weights, inertia and a load.
struct SliderCrank {
    crank: f64,
    rod: f64,
    to_mass: f64,
    angle: f64,
    omega: f64,
    guide: f64,
    /// Mass of the rod; its weight is given in the scene where `by_weight`.
    mass: f64,
    by_weight: bool,
    inertia: f64,
    block: f64,
    load: f64,
}

impl SliderCrank {
    fn new(dice: &mut Dice, mistake: Mistake) -> Self {
        let by_weight = match mistake {
            Mistake::WeightAsMass => true,
            Mistake::MassAsWeight => false,
            _ => dice.roll() < 0.5,
        };
        let degrees = [dice.between(35.0, 70.0), dice.between(110.0, 150.0)][usize::from(dice.roll() < 0.5)];
        Self {
            crank: rounded(dice.between(0.05, 0.07), 3),
            rod: rounded(dice.between(0.18, 0.26), 3),
            to_mass: rounded(dice.between(0.07, 0.1), 3),
            angle: rounded(degrees, 0).to_radians(),
            omega: rounded(dice.between(25.0, 40.0), 0),
            guide: rounded(dice.between(-25.0, -12.0), 0).to_radians(),
            mass: rounded(dice.between(2.0, 4.0), 2),
            by_weight,
            inertia: rounded(dice.between(0.02, 0.04), 4),
            block: rounded(dice.between(1.0, 2.5), 2),
            load: rounded(dice.between(200.0, 400.0), 0),
        }
    }

    fn scene(&self) -> String {
        let heavy = match self.by_weight {
            true => format!("\"weight\": {}", self.mass * G),
            false => format!("\"mass\": {}", self.mass),
        };
        format!(
            r#"{{ "units": {{ "length": "mm", "torque": "N*m" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": {} }}, "3": {{ "joins": ["A", "B"], "length": {} }} }},
            "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, 0], "angle": {} }} }} ],
            "near": {{ "B": [{}, {}] }}, "input": {{ "link": 2, "angle": {}, "omega": "{} rad/s ccw" }},
            "gravity": {{}}, "masses": {{ "3": {{ {heavy}, "inertia": {}, "at": [{}, 0] }}, "4": {{ "mass": {} }} }},
            "loads": [ {{ "name": "P", "on": 4, "force": {}, "direction": {} }} ],
            "sheet": {{ "scales": {{ "length": "1:2", "force": "{} N per cm" }} }},
            "find": ["Fin(3)", "Tin(3)", "h(3)", "Fin(4)", "FS", "F(1,4)", "F(3,4)", "F(2,3)", "F(1,2)", "T(2)"] }}"#,
            self.crank * 1e3,
            self.rod * 1e3,
            self.guide.to_degrees().round(),
            self.rod * 1e3 * libm::cos(self.guide),
            self.rod * 1e3 * libm::sin(self.guide),
            self.angle.to_degrees().round(),
            self.omega,
            self.inertia,
            self.to_mass * 1e3,
            self.block,
            self.load,
            self.guide.to_degrees().round() + 180.0,
            NEWTONS * 10.0,
        )
    }

    /// What a student hands in who makes this mistake; `slip` gives what the pencil adds.
    fn answers(&self, mistake: Mistake, slip: &mut dyn FnMut() -> f64) -> Vec<(&'static str, Vec<f64>)> {
        let along = unit(self.guide);
        let square = unit(self.guide + std::f64::consts::FRAC_PI_2);
        let a = times(unit(self.angle), self.crank);
        // B at s along the guide: |sB − A| = rod.
        let (ahead, aside) = (a[0] * along[0] + a[1] * along[1], cross(along, a));
        let s = ahead + (self.rod * self.rod - aside * aside).sqrt();
        let b = times(along, s);
        let rod = minus(b, a);
        let left = |v: Xy| [-v[1], v[0]];
        // A velocity: v_B along the guide = v_A + ω3 × rod.
        let va = times(left(a), self.omega);
        let omega3 =
            -(va[0] * square[0] + va[1] * square[1]) / (left(rod)[0] * square[0] + left(rod)[1] * square[1]);
        let aa = times(a, -self.omega * self.omega);
        let normal = times(rod, -omega3 * omega3);
        let known = plus(aa, normal);
        let alpha3 = -(known[0] * square[0] + known[1] * square[1])
            / (left(rod)[0] * square[0] + left(rod)[1] * square[1]);
        let ab = plus(known, times(left(rod), alpha3));
        let to_mass = times(rod, self.to_mass / self.rod);
        let ag = plus(aa, plus(times(to_mass, -omega3 * omega3), times(left(to_mass), alpha3)));
        let g3 = plus(a, to_mass);

        let mut pencil = |v: Xy| plus(v, [slip() * NEWTONS, slip() * NEWTONS]);
        let factor = match mistake {
            Mistake::WeightAsMass => G,
            Mistake::MassAsWeight => 1.0 / G,
            _ => 1.0,
        };
        let turned = if mistake == Mistake::AlongAcceleration { 1.0 } else { -1.0 };
        let fin3 = pencil(times(ag, turned * self.mass * factor));
        let block_factor = if mistake == Mistake::MassAsWeight { factor } else { 1.0 };
        let fin4 = pencil(times(ab, -self.block * block_factor));
        let tin3 = if mistake == Mistake::WithAlpha { 1.0 } else { -1.0 } * self.inertia * alpha3;
        let couple = if mistake == Mistake::OtherSide { -tin3 } else { tin3 };
        let (w3, w4) = ([0.0, -self.mass * G], [0.0, -self.block * G]);
        let p = times(along, -self.load);
        let given = if mistake == Mistake::NoStatic { 0.0 } else { 1.0 };
        let (w3, w4, p) = (times(w3, given), times(w4, given), times(p, given));
        // Moments of rod and block about A.
        let in_moments = match mistake {
            Mistake::OutOfMoments | Mistake::LeftOut => 0.0,
            _ => 1.0,
        };
        let in_polygon = match mistake {
            Mistake::OutOfPolygon => 0.0,
            _ => 1.0,
        };
        let loaded = if mistake == Mistake::LeftOut { 0.0 } else { 1.0 };
        let moment = cross(to_mass, fin3)
            + couple
            + cross(to_mass, w3)
            + cross(rod, plus(plus(fin4, w4), times(p, in_moments)));
        let pressing = if mistake == Mistake::NotSquare { [0.0, 1.0] } else { square };
        let f14 = pencil(times(pressing, -moment / cross(rod, pressing)));
        let f34 = pencil(times(plus(plus(f14, times(p, loaded)), plus(fin4, w4)), -1.0));
        let f43 = times(f34, if mistake == Mistake::HandedOn { 1.0 } else { -1.0 });
        let f23 = pencil(times(plus(plus(f43, fin3), times(w3, in_polygon)), -1.0));
        let f32 = times(f23, -1.0);
        let f12 = f23;
        let arm = cross(a, f32) / size(f32) + slip() * 1e-3 * SCALE;
        let torque = match mistake {
            Mistake::ArmToPin => -arm.signum() * size(f32) * self.crank,
            Mistake::DrawingArm => -arm * size(f32) / SCALE,
            Mistake::Given => arm * size(f32),
            _ => -arm * size(f32),
        };
        let mut shaking = plus(fin3, fin4);
        if mistake == Mistake::LoadsInShaking {
            shaking = plus(shaking, p);
        }
        let told = if mistake == Mistake::Reaction { times(f23, -1.0) } else { f23 };
        let _ = g3;
        vec![
            ("Fin(3)", fin3.to_vec()),
            ("Tin(3)", vec![tin3 * (1.0 + slip() * 0.02)]),
            ("h(3)", vec![(tin3 / size(fin3)).abs() * 1e3 * (1.0 + slip() * 0.02)]),
            ("Fin(4)", fin4.to_vec()),
            ("FS", shaking.to_vec()),
            ("F(1,4)", f14.to_vec()),
            ("F(3,4)", f34.to_vec()),
            ("F(2,3)", told.to_vec()),
            ("F(1,2)", f12.to_vec()),
            ("T(2)", vec![torque]),
        ]
    }
}

/// A four-bar with a load on its rocker, inertia of coupler and rocker.
struct FourBar {
    bars: [f64; 4],
    angle: f64,
    omega: f64,
    mass: [f64; 2],
    inertia: [f64; 2],
    load: f64,
    toward: f64,
}

impl FourBar {
    const MISTAKES: [Mistake; 6] = [
        Mistake::AlongAcceleration,
        Mistake::OtherSide,
        Mistake::Reaction,
        Mistake::ArmToPin,
        Mistake::OutOfMoments,
        Mistake::NoStatic,
    ];

    fn new(dice: &mut Dice) -> Self {
        Self {
            bars: [
                rounded(dice.between(0.18, 0.2), 3),
                rounded(dice.between(0.05, 0.06), 3),
                rounded(dice.between(0.17, 0.2), 3),
                rounded(dice.between(0.12, 0.14), 3),
            ],
            angle: rounded(dice.between(60.0, 110.0), 0).to_radians(),
            omega: rounded(dice.between(20.0, 30.0), 0),
            mass: [rounded(dice.between(2.0, 3.0), 2), rounded(dice.between(2.0, 3.0), 2)],
            inertia: [rounded(dice.between(0.02, 0.03), 4), rounded(dice.between(0.03, 0.05), 4)],
            load: rounded(dice.between(200.0, 300.0), 0),
            toward: rounded(dice.between(10.0, 40.0), 0).to_radians(),
        }
    }

    fn scene(&self) -> String {
        let mm = self.bars.map(|bar| bar * 1e3);
        format!(
            r#"{{ "units": {{ "length": "mm", "torque": "N*m" }}, "fixed": {{ "O2": [0, 0], "O4": [{}, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": {} }}, "3": {{ "joins": ["A", "B"], "length": {} }},
              "4": {{ "joins": ["O4", "B", "C"], "line": [0, {}, {}] }} }},
            "near": {{ "B": [{}, {}] }}, "input": {{ "link": 2, "angle": {}, "omega": "{} rad/s ccw" }},
            "masses": {{ "3": {{ "mass": {}, "inertia": {}, "at": [{}, 0] }}, "4": {{ "mass": {}, "inertia": {}, "at": [{}, 0] }} }},
            "loads": [ {{ "name": "P", "on": 4, "at": "C", "force": {}, "direction": {} }} ],
            "sheet": {{ "scales": {{ "length": "1:2", "force": "{} N per cm" }} }},
            "find": ["Fin(3)", "h(3)", "Fin(4)", "h(4)", "F(3,4)", "F(1,4)", "F(2,3)", "F(1,2)", "T(2)"] }}"#,
            mm[0],
            mm[1],
            mm[2],
            mm[3],
            mm[3] * 1.5,
            mm[0] + 0.3 * mm[3],
            0.9 * mm[3],
            self.angle.to_degrees().round(),
            self.omega,
            self.mass[0],
            self.inertia[0],
            mm[2] / 2.0,
            self.mass[1],
            self.inertia[1],
            mm[3] / 2.0,
            self.load,
            self.toward.to_degrees().round(),
            NEWTONS * 10.0,
        )
    }

    fn answers(&self, mistake: Mistake, slip: &mut dyn FnMut() -> f64) -> Answers {
        let left = |v: Xy| [-v[1], v[0]];
        let [frame, crank, coupler, rocker] = self.bars;
        let a = times(unit(self.angle), crank);
        let o4 = [frame, 0.0];
        // B by the triangle A, O4, B, above.
        let between = minus(o4, a);
        let d = size(between);
        let along = (coupler * coupler - rocker * rocker + d * d) / (2.0 * d);
        let up = (coupler * coupler - along * along).sqrt();
        let b = plus(a, plus(times(between, along / d), times(left(between), up / d)));
        let (r3, r4) = (minus(b, a), minus(b, o4));
        // ω₃ r₃⊥ − ω₄ r₄⊥ = −v_A, and the same of accelerations.
        let solve = |target: Xy| {
            let (p, q) = (left(r3), times(left(r4), -1.0));
            let det = cross(p, q);
            [cross(target, q) / det, cross(p, target) / det]
        };
        let va = times(left(a), self.omega);
        let [w3, w4] = solve(times(va, -1.0));
        let aa = times(a, -self.omega * self.omega);
        let normals = plus(plus(aa, times(r3, -w3 * w3)), times(r4, w4 * w4));
        let [e3, e4] = solve(times(normals, -1.0));
        let of_mass =
            |base: Xy, to: Xy, w: f64, e: f64| plus(base, plus(times(to, -w * w), times(left(to), e)));
        let (g3, g4) = (times(r3, 0.5), times(r4, 0.5));
        let mut pencil = |v: Xy| plus(v, [slip() * NEWTONS, slip() * NEWTONS]);
        let sign = if mistake == Mistake::AlongAcceleration { 1.0 } else { -1.0 };
        let fin3 = pencil(times(of_mass(aa, g3, w3, e3), sign * self.mass[0]));
        let fin4 = pencil(times(of_mass([0.0; 2], g4, w4, e4), -self.mass[1]));
        let tin = [-self.inertia[0] * e3, -self.inertia[1] * e4];
        let turned = if mistake == Mistake::OtherSide { -tin[1] } else { tin[1] };
        let to_load = times(r4, 1.5);
        let p = times(unit(self.toward), if mistake == Mistake::NoStatic { 0.0 } else { self.load });
        let moment = match mistake {
            Mistake::ArmToPin => cross(to_load, p).signum() * size(to_load) * size(p),
            Mistake::OutOfMoments => 0.0,
            _ => cross(to_load, p),
        };
        // Moments of 4 about O4 and of 3 about A.
        let m4 = cross(g4, fin4) + turned + moment;
        let m3 = cross(g3, fin3) + tin[0];
        let det = cross(r4, r3);
        // r4 × F34 = −m4, r3 × F34 = m3.
        let f34 = pencil([(-m4 * r3[0] - m3 * r4[0]) / det, (-m4 * r3[1] - m3 * r4[1]) / det]);
        let f14 = pencil(times(plus(plus(f34, fin4), p), -1.0));
        let f23 = pencil(minus(f34, fin3));
        let arm = cross(a, times(f23, -1.0)) / size(f23) + slip() * 1e-3 * SCALE;
        let told = if mistake == Mistake::Reaction { times(f34, -1.0) } else { f34 };
        vec![
            ("Fin(3)", fin3.to_vec()),
            ("h(3)", vec![(tin[0] / size(fin3)).abs() * 1e3 * (1.0 + slip() * 0.02)]),
            ("Fin(4)", fin4.to_vec()),
            ("h(4)", vec![(tin[1] / size(fin4)).abs() * 1e3 * (1.0 + slip() * 0.02)]),
            ("F(3,4)", told.to_vec()),
            ("F(1,4)", f14.to_vec()),
            ("F(2,3)", f23.to_vec()),
            ("F(1,2)", f23.to_vec()),
            ("T(2)", vec![-arm * size(f23)]),
        ]
    }
}

/// What somebody does otherwise where pairs rub.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rubbing {
    None,
    OtherTangent,
    OtherLean,
    Journal,
}

impl Rubbing {
    const ALL: [Self; 4] = [Self::None, Self::OtherTangent, Self::OtherLean, Self::Journal];

    fn name(self) -> &'static str {
        match self {
            Self::None => "rubbing: (right)",
            Self::OtherTangent => "rubbing: other-tangent",
            Self::OtherLean => "rubbing: friction-angle-reversed",
            Self::Journal => "rubbing: journal-for-friction-circle",
        }
    }
}

/// A slider-crank at which every pair rubs, without inertia.
struct Rough {
    crank: f64,
    rod: f64,
    angle: f64,
    load: f64,
    radius: f64,
    f: f64,
    guide: f64,
}

impl Rough {
    fn new(dice: &mut Dice) -> Self {
        Self {
            crank: rounded(dice.between(0.05, 0.07), 3),
            rod: rounded(dice.between(0.18, 0.24), 3),
            angle: rounded(dice.between(40.0, 75.0), 0).to_radians(),
            load: rounded(dice.between(250.0, 400.0), 0),
            radius: rounded(dice.between(0.018, 0.024), 3),
            f: rounded(dice.between(0.15, 0.2), 2),
            guide: rounded(dice.between(0.15, 0.25), 2),
        }
    }

    fn scene(&self) -> String {
        let pin = format!("{{ \"radius\": {}, \"f\": {} }}", self.radius * 1e3, self.f);
        format!(
            r#"{{ "units": {{ "length": "mm", "torque": "N*m" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": {} }}, "3": {{ "joins": ["A", "B"], "length": {} }} }},
            "slides": [ {{ "pin": "B", "block": 4, "f": {}, "on": {{ "link": 1, "through": [0, 0], "angle": 0 }} }} ],
            "near": {{ "B": [{}, 0] }}, "input": {{ "link": 2, "angle": {}, "omega": "10 rad/s ccw" }},
            "pins": {{ "O2": {pin}, "A": {pin}, "B": {pin} }},
            "loads": [ {{ "name": "P", "on": 4, "at": "B", "force": {}, "direction": 0 }} ],
            "sheet": {{ "scales": {{ "length": "1:1", "force": "{} N per cm" }} }},
            "find": ["F(3,4)", "F(1,4)", "F(1,2)", "T(2)"] }}"#,
            self.crank * 1e3,
            self.rod * 1e3,
            self.guide,
            (self.crank + self.rod) * 1e3,
            self.angle.to_degrees().round(),
            self.load,
            NEWTONS * 10.0,
        )
    }

    fn answers(&self, rubbing: Rubbing, slip: &mut dyn FnMut() -> f64) -> Answers {
        let a = times(unit(self.angle), self.crank);
        let b = [a[0] + (self.rod * self.rod - a[1] * a[1]).sqrt(), 0.0];
        let rod = minus(b, a);
        // ω₂ = 1: ω₃ from the vertical velocity of B, which is zero.
        let omega3 = -a[0] / rod[0];
        let vb = -a[1] - omega3 * rod[1];
        let circle = match rubbing {
            Rubbing::Journal => self.radius,
            _ => self.radius * libm::sin(libm::atan(self.f)),
        };
        let side = if rubbing == Rubbing::OtherTangent { -1.0 } else { 1.0 };
        let lean = if rubbing == Rubbing::OtherLean { -1.0 } else { 1.0 } * self.guide;
        // A force on what turns by so much faster passes its pin so that it turns against that.
        let touch = |pin: Xy, force: Xy, faster: f64| {
            let left = times([-force[1], force[0]], 1.0 / size(force));
            plus(pin, times(left, circle * side * faster.signum()))
        };
        let p = [self.load, 0.0];
        // F34 along the rod, at first through both pins.
        let mut along = times(rod, 1.0 / size(rod));
        let (mut f34, mut f14) = ([0.0_f64; 2], [0.0_f64; 2]);
        for _ in 0..200 {
            // P + F34 + F14 = 0, F14 leaning against the sliding.
            let press = |up: f64| [-vb.signum() * lean, up];
            let up = along[1].signum();
            let normal = press(up);
            let det = cross(along, normal);
            let k = -cross(p, normal) / det;
            f34 = times(along, k);
            f14 = times(plus(p, f34), -1.0);
            // On the rod at A acts F23 = F34, at B F43 = −F34.
            let at_a = touch(a, f34, omega3 - 1.0);
            let at_b = touch(b, times(f34, -1.0), omega3);
            let line = minus(at_b, at_a);
            along = times(line, 1.0 / size(line));
        }
        let f32 = times(f34, -1.0);
        let f12 = f34;
        let at_a = touch(a, f34, omega3 - 1.0);
        let at_o = touch([0.0; 2], f12, 1.0);
        let torque = -cross(minus(at_a, at_o), f32);
        let mut pencil = |v: Xy| plus(v, [slip() * NEWTONS, slip() * NEWTONS]);
        let told = [pencil(f34), pencil(f14), pencil(f12)];
        vec![
            ("F(3,4)", told[0].to_vec()),
            ("F(1,4)", told[1].to_vec()),
            ("F(1,2)", told[2].to_vec()),
            ("T(2)", vec![torque * (1.0 + 0.02 * slip())]),
        ]
    }
}

/// A turning-moment diagram of three humps in two turns, two of them near each other.
struct Humps {
    /// Angles in degrees and torques of the knots.
    knots: Vec<[f64; 2]>,
    omega: f64,
}

impl Humps {
    const MISTAKES: [(&'static str, &'static str); 4] = [
        ("cycle (right)", RIGHT),
        ("cycle: largest area", "largest-area"),
        ("cycle: one turn for two", "one-turn-for-two"),
        ("cycle: half the fluctuation", "half-fluctuation"),
    ];

    fn new(dice: &mut Dice) -> Self {
        let tops = [
            rounded(dice.between(700.0, 900.0), -1),
            rounded(dice.between(700.0, 900.0), -1),
            rounded(dice.between(500.0, 650.0), -1),
        ];
        let knots = vec![
            [0.0, 0.0],
            [70.0, tops[0]],
            [150.0, 0.0],
            [220.0, tops[1]],
            [300.0, 0.0],
            [480.0, 0.0],
            [520.0, tops[2]],
            [560.0, 0.0],
            [720.0, 0.0],
        ];
        Self { knots, omega: rounded(dice.between(30.0, 60.0), 0) }
    }

    fn scene(&self) -> String {
        let knots: Vec<String> = self.knots.iter().map(|[at, torque]| format!("[{at}, {torque}]")).collect();
        format!(
            r#"{{ "links": {{}}, "units": {{ "torque": "N*m" }}, "input": {{ "omega": "{} rad/s" }},
            "cycle": {{ "torque": {{ "table": [{}] }}, "period": 720, "fluctuation": 0.04 }},
            "find": ["Tmean", "power", "Ef", "If"] }}"#,
            self.omega,
            knots.join(", ")
        )
    }

    fn answers(&self, kind: &str) -> Answers {
        let area = |mean: f64, from: usize, to: usize| -> f64 {
            let legs = self.knots[from..=to].windows(2);
            let all =
                legs.map(|leg| (leg[1][0] - leg[0][0]).to_radians() * ((leg[0][1] + leg[1][1]) / 2.0 - mean));
            all.sum()
        };
        let last = self.knots.len() - 1;
        let mean = area(0.0, 0, last) / 720_f64.to_radians();
        // Levels at the crossings, leg by leg.
        let (mut level, mut levels, mut areas, mut before) = (0.0, vec![], vec![], None);
        for leg in self.knots.windows(2) {
            let [a, b] = [leg[0], leg[1]];
            let width = (b[0] - a[0]).to_radians();
            let heights = [a[1] - mean, b[1] - mean];
            if heights[0] * heights[1] < 0.0 {
                let part = heights[0] / (heights[0] - heights[1]);
                let here = level + heights[0] / 2.0 * part * width;
                levels.push(here);
                if let Some(before) = before.replace(here) {
                    areas.push(here - before);
                }
            }
            level += (heights[0] + heights[1]) / 2.0 * width;
        }
        areas.push(levels[0] - levels[levels.len() - 1]);
        let (most, least) = (
            levels.iter().copied().fold(f64::MIN, f64::max),
            levels.iter().copied().fold(f64::MAX, f64::min),
        );
        let largest = areas.iter().map(|area| area.abs()).fold(0.0, f64::max);
        let fluctuation = if kind == "largest-area" { largest } else { most - least };
        let range = if kind == "half-fluctuation" { 0.02 } else { 0.04 };
        let doubled = if kind == "one-turn-for-two" { 2.0 } else { 1.0 };
        vec![
            ("Tmean", vec![mean * doubled]),
            ("power", vec![mean * doubled * self.omega]),
            ("Ef", vec![fluctuation]),
            ("If", vec![fluctuation / (range * self.omega * self.omega)]),
        ]
    }
}

fn handed_in(answers: &[(&'static str, Vec<f64>)]) -> String {
    let number = |value: &f64| format!("{value:.4}");
    let values = answers.iter().map(|(name, numbers)| match &numbers[..] {
        [value] if !name.starts_with('T') || *name == "Tmean" => format!("\"{name}\": {}", number(value)),
        [value] => format!(
            "\"{name}\": \"{} N*m {}\"",
            number(&value.abs()),
            if *value < 0.0 { "cw" } else { "ccw" }
        ),
        all => format!("\"{name}\": [{}]", all.iter().map(number).collect::<Vec<_>>().join(", ")),
    });
    format!("{{ \"values\": {{ {} }} }}", values.collect::<Vec<_>>().join(", "))
}

/// Grades; the names of the first fault's mistakes, and how many answers are wrong.
fn graded(scene: &str, answers: &str) -> (Vec<String>, usize, Vec<(String, Verdict)>) {
    let scene = scene::read(scene, "planted").unwrap_or_else(|why| panic!("{why}\n{scene}"));
    let answers = grade::read_answers(answers, &scene).unwrap();
    let report = grade::grade(&scene, &answers, &grade::GradeSettings::default()).unwrap();
    let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).count();
    let named = report.first_fault().map_or_else(Vec::new, |fault| {
        fault.mistakes.iter().map(|mistake| mistake.kind.name().to_owned()).collect()
    });
    (named, wrong, report.quantities.iter().map(|g| (g.name.clone(), g.verdict)).collect())
}

/// What was planted, how often it was named first, and what was said instead.
type Confusion = BTreeMap<&'static str, (usize, usize, Vec<String>)>;

/// A problem with its right answers and those of somebody who errs, both without slips and with them.
struct Planted {
    name: &'static str,
    kind: &'static str,
    scene: String,
    right: Answers,
    own: Answers,
    written: Answers,
}

type Answers = Vec<(&'static str, Vec<f64>)>;

impl Planted {
    /// Whether anybody could see the mistake.
    fn is_seen(&self) -> bool {
        let vectors = self.right.iter().filter(|(_, n)| n.len() == 2);
        let largest = vectors.map(|(_, n)| size([n[0], n[1]])).fold(0.0, f64::max);
        self.own.iter().zip(&self.right).any(|((_, a), (_, b))| match (&a[..], &b[..]) {
            ([a], [b]) => (a - b).abs() > 0.15 * b.abs(),
            (a, b) => size([a[0] - b[0], a[1] - b[1]]) > (0.15 * size([b[0], b[1]])).max(0.05 * largest),
        })
    }

    /// A mistake of a four-bar of this seed.
    fn in_four_bar(mistake: Mistake, seed: u64) -> Self {
        let mut slips = Dice(seed * 37 + 11);
        let bars = FourBar::new(&mut Dice(seed * 631 + 17 * mistake as u64 + 3));
        Self {
            name: mistake.of_four_bar(),
            kind: mistake.name(),
            scene: bars.scene(),
            right: bars.answers(Mistake::None, &mut || 0.0),
            own: bars.answers(mistake, &mut || 0.0),
            written: bars.answers(mistake, &mut || slips.between(-SLIP, SLIP)),
        }
    }

    fn count(&self, seed: u64, named: &mut Confusion) {
        if self.kind != RIGHT && !self.is_seen() {
            return;
        }
        let (mistakes, wrong, verdicts) = graded(&self.scene, &handed_in(&self.written));
        let entry = named.entry(self.name).or_default();
        entry.1 += 1;
        let fits = match self.kind {
            RIGHT => wrong == 0,
            kind => mistakes.first().is_some_and(|first| first == kind) && wrong == 1,
        };
        entry.0 += usize::from(fits);
        if !fits {
            entry.2.push(format!("seed {seed}: {mistakes:?}, {wrong} wrong: {verdicts:?}"));
        }
    }
}

/// Nothing was planted.
const RIGHT: &str = "(right)";

/// Plants each mistake so many times.
fn campaign(each: u64) -> Confusion {
    let mut named = Confusion::new();
    for seed in 0..each {
        for mistake in [Mistake::None].into_iter().chain(Mistake::ALL) {
            let mut dice = Dice(seed * 977 + 13 * mistake as u64 + 5);
            let mut slips = Dice(seed * 31 + 7);
            let mut slip = || slips.between(-SLIP, SLIP);
            let crank = SliderCrank::new(&mut dice, mistake);
            let name = mistake.told();
            Planted {
                name,
                kind: mistake.name(),
                scene: crank.scene(),
                right: crank.answers(Mistake::None, &mut || 0.0),
                own: crank.answers(mistake, &mut || 0.0),
                written: crank.answers(mistake, &mut slip),
            }
            .count(seed, &mut named);
        }
        for mistake in [Mistake::None].into_iter().chain(FourBar::MISTAKES) {
            Planted::in_four_bar(mistake, seed).count(seed, &mut named);
        }
        for rubbing in Rubbing::ALL {
            let mut dice = Dice(seed * 419 + 19);
            let mut slips = Dice(seed * 41 + 13);
            let mut slip = || slips.between(-SLIP, SLIP);
            let rough = Rough::new(&mut dice);
            Planted {
                name: rubbing.name(),
                kind: rubbing.name().trim_start_matches("rubbing: "),
                scene: rough.scene(),
                right: rough.answers(Rubbing::None, &mut || 0.0),
                own: rough.answers(rubbing, &mut || 0.0),
                written: rough.answers(rubbing, &mut slip),
            }
            .count(seed, &mut named);
        }
        for (name, kind) in Humps::MISTAKES {
            let humps = Humps::new(&mut Dice(seed * 223 + 29));
            let [right, own] = [humps.answers(RIGHT), humps.answers(kind)];
            let written = own.clone();
            Planted { name, kind, scene: humps.scene(), right, own, written }.count(seed, &mut named);
        }
    }
    named
}

fn told(named: &Confusion) -> String {
    let line = |(mistake, (fit, all, missed)): (&&str, &(usize, usize, Vec<String>))| {
        let missed = missed.iter().take(3).map(|text| format!("\n    {text}")).collect::<String>();
        format!("{mistake}: {fit} of {all}{missed}")
    };
    named.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn mistakes_of_forces_are_named() {
    let named = campaign(3);
    let is_right = |name: &str| name.ends_with(RIGHT);
    let sum = |right: bool, pick: fn(&(usize, usize, Vec<String>)) -> usize| {
        named
            .iter()
            .filter(|(name, _)| is_right(name) == right)
            .map(|(_, counts)| pick(counts))
            .sum::<usize>()
    };
    assert_eq!(sum(true, |c| c.0), sum(true, |c| c.1), "{}", told(&named));
    let (fit, all) = (sum(false, |c| c.0), sum(false, |c| c.1));
    assert!(10 * fit >= 9 * all && all > 60, "{fit} of {all}\n{}", told(&named));
}

/// Of what leads to the same numbers that which is forgotten more often is named first; and a mass used as a weight, by
/// which every inertia force is small, costs one mark.
#[test]
fn what_is_forgotten_comes_first_and_small_forces_follow() {
    let mut named = Confusion::new();
    for seed in 0..4 {
        Planted::in_four_bar(Mistake::OutOfMoments, seed).count(seed, &mut named);
        let mistake = Mistake::MassAsWeight;
        let crank = SliderCrank::new(&mut Dice(seed * 977 + 13 * mistake as u64 + 5), mistake);
        let own = crank.answers(mistake, &mut || 0.0);
        Planted {
            name: mistake.told(),
            kind: mistake.name(),
            scene: crank.scene(),
            right: crank.answers(Mistake::None, &mut || 0.0),
            own: own.clone(),
            written: own,
        }
        .count(seed, &mut named);
    }
    assert!(named.values().all(|(fit, all, _)| fit == all && *all > 2), "{}", told(&named));
}

#[test]
#[ignore = "takes a while"]
fn confusion_of_forces() {
    println!("{}", told(&campaign(40)));
}
