//! Every name that a scene may ask for, with the truth of it, in SI units.

use super::jet::Moving;
use super::mechanism::{FRAME, Kind, Mechanism, Path, Place, cross, dot, left, length, minus, plus, unit};
use super::statement::Said;
use super::truth::State;
use crate::extremes::dice::Dice;

/// What is true.
#[derive(Clone, Debug)]
pub(crate) enum Truth {
    Scalar(f64),
    Vector(Place),
    /// Radians, any number of turns.
    Angle(f64),
    /// Direction of a centre at infinity, either way.
    AtInfinity(Place),
}

/// A name with its truth, and how far the truth may be off.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) name: String,
    pub(crate) truth: Truth,
    pub(crate) off: f64,
}

/// The truth's relative error.
const EXACT: f64 = 1e-9;

struct Asker<'a> {
    m: &'a Mechanism,
    state: &'a State,
    said: &'a Said,
    asked: Vec<Asked>,
    /// Largest of each order: lengths, by time, by time squared; then turning.
    scales: [f64; 5],
}

impl Asker<'_> {
    fn add(&mut self, name: String, truth: Truth, lengths: i32, times: usize) {
        let (l, t) = (self.said.units.length.1, self.said.units.time.1);
        let si = if lengths == 1 { l } else { 1.0 } / [1.0, t, t * t][times];
        let scale =
            if lengths == 1 { self.scales[times] } else { [1.0, self.scales[3], self.scales[4]][times] };
        let truth = match truth {
            Truth::Scalar(x) => Truth::Scalar(x * si),
            Truth::Vector(x) => Truth::Vector(x.map(|x| x * si)),
            other => other,
        };
        self.asked.push(Asked { name, truth, off: EXACT * scale * si });
    }
}

/// What may be asked of a mechanism as it was said; some of it, at random.
pub(crate) fn ask(m: &Mechanism, state: &State, said: &Said, dice: &mut Dice) -> Vec<Asked> {
    let size = m.size();
    let far = m.points.iter().fold(size, |s, p| s.max(length(p.at)));
    let turns: Vec<_> = (0..m.bodies.len()).map(|b| state.turn(b)).collect();
    let moving: Vec<_> = m.points.iter().map(|p| state.place(p.of[0], p.at)).collect();
    let w = turns.iter().fold(0.0_f64, |s, t| s.max(t.rate.abs()));
    let e = turns.iter().fold(0.0_f64, |s, t| s.max(t.second.abs())).max(w * w);
    let v = moving.iter().fold(0.0_f64, |s, p| s.max(length(p.velocity())));
    let a = moving.iter().fold(0.0_f64, |s, p| s.max(length(p.acceleration())));
    let a = a.max(e * size).max(v * v / size);
    let scales = [far, v.max(w * size), a, w.max(v / size), e.max(a / size)];
    let mut ask = Asker { m, state, said, asked: vec![], scales };
    for (i, p) in m.points.iter().enumerate() {
        let name = &p.name;
        if ask.m.is_fixed(i) {
            continue;
        }
        ask.add(format!("v({name})"), Truth::Vector(moving[i].velocity()), 1, 1);
        ask.add(format!("a({name})"), Truth::Vector(moving[i].acceleration()), 1, 2);
        ask.add(format!("x({name})"), Truth::Vector(p.at), 1, 0);
        let pivoted: Vec<usize> =
            p.of.iter().copied().filter(|b| m.bodies[*b].joins.iter().any(|q| m.is_fixed(*q))).collect();
        if let [body] = pivoted.as_slice() {
            let pivot = m.bodies[*body].joins.iter().find(|q| m.is_fixed(**q));
            if let Some(pivot) = pivot {
                let arm = minus(p.at, m.at(*pivot));
                let turn = turns[*body];
                ask.add(format!("an({name})"), Truth::Vector(arm.map(|x| -x * turn.rate * turn.rate)), 1, 2);
                ask.add(format!("at({name})"), Truth::Vector(left(arm).map(|x| x * turn.second)), 1, 2);
            }
        }
        if let (Some(radius), [b, c]) = (said.journals[i], p.of.as_slice()) {
            let rub = (turns[*b].rate - turns[*c].rate).abs() * radius;
            ask.add(format!("rub({name})"), Truth::Scalar(rub), 1, 1);
        }
    }
    for (i, body) in m.bodies.iter().enumerate().skip(1) {
        if body.kind == Kind::Particle {
            continue;
        }
        let n = body.number;
        ask.add(format!("omega({n})"), Truth::Scalar(turns[i].rate), 0, 1);
        ask.add(format!("alpha({n})"), Truth::Scalar(turns[i].second), 0, 2);
        if body.kind == Kind::Link && said.own[i].sure {
            ask.add(format!("angle({n})"), Truth::Angle(said.own[i].angle), 0, 0);
        }
        for _ in 0..2 {
            if body.joins.len() < 2 {
                continue;
            }
            let (p, q) = (dice.of(&body.joins), dice.of(&body.joins));
            if p == q {
                continue;
            }
            let arm = minus(m.at(p), m.at(q));
            let turn = turns[i];
            let pair = format!("{}/{}", m.points[p].name, m.points[q].name);
            let both: Vec<usize> =
                m.points[p].of.iter().copied().filter(|b| m.points[q].of.contains(b)).collect();
            if both.len() == 1 {
                let an = arm.map(|x| -x * turn.rate * turn.rate);
                ask.add(format!("an({pair})"), Truth::Vector(an), 1, 2);
                let at = left(arm).map(|x| x * turn.second);
                ask.add(format!("at({pair})"), Truth::Vector(at), 1, 2);
            }
        }
    }
    for _ in 0..3 {
        let (p, q) = (dice.below(m.points.len()), dice.below(m.points.len()));
        if p != q {
            let pair = format!("{}/{}", m.points[p].name, m.points[q].name);
            let by = |f: fn(Moving) -> Place| minus(f(moving[p]), f(moving[q]));
            ask.add(format!("v({pair})"), Truth::Vector(by(Moving::velocity)), 1, 1);
            ask.add(format!("a({pair})"), Truth::Vector(by(Moving::acceleration)), 1, 2);
        }
    }
    let named: Vec<usize> = (0..m.bodies.len()).filter(|b| m.bodies[*b].kind != Kind::Particle).collect();
    for _ in 0..3 {
        let (b, c) = (dice.of(&named), dice.of(&named));
        if b == c {
            continue;
        }
        let (i, j) = (m.bodies[b].number, m.bodies[c].number);
        let turn = turns[b] - turns[c];
        if c != FRAME {
            ask.add(format!("omega({i}/{j})"), Truth::Scalar(turn.rate), 0, 1);
            ask.add(format!("alpha({i}/{j})"), Truth::Scalar(turn.second), 0, 2);
        }
        centre(&mut ask, b, c);
    }
    transmissions(&mut ask);
    for slide in &m.slides {
        let (point, _) = m.rider(slide);
        let on = slide.on;
        let pair = format!("{}/{}", m.points[point].name, m.bodies[on].number);
        // Seen from the guiding body.
        let turn = turns[on];
        let here = state.place(on, m.at(point));
        let slip = minus(moving[point].velocity(), here.velocity());
        let coriolis = left(slip).map(|x| 2.0 * turn.rate * x);
        let apparent = minus(minus(moving[point].acceleration(), here.acceleration()), coriolis);
        ask.add(format!("slip({pair})"), Truth::Vector(slip), 1, 1);
        ask.add(format!("aslip({pair})"), Truth::Vector(apparent), 1, 2);
        ask.add(format!("coriolis({pair})"), Truth::Vector(coriolis), 1, 2);
        if let Path::Arc { centre, .. } = slide.path {
            let normal = unit(minus(m.at(point), centre));
            let n = dot(normal, apparent);
            ask.add(format!("aslipn({pair})"), Truth::Vector(normal.map(|x| x * n)), 1, 2);
            let t = dot(left(normal), apparent);
            ask.add(format!("aslipt({pair})"), Truth::Vector(left(normal).map(|x| x * t)), 1, 2);
        }
    }
    let mut asked = ask.asked;
    asked.dedup_by(|a, b| a.name == b.name);
    let mut seen = std::collections::BTreeSet::new();
    asked.retain(|a| seen.insert(a.name.clone()));
    // Most scenes ask for something only.
    if dice.chance(0.5) {
        let part = dice.between(0.1, 0.9);
        asked.retain(|_| dice.chance(part));
    }
    if dice.chance(0.5) {
        dice.shuffle(&mut asked);
    }
    asked
}

/// Angles at the pins of two bars.
fn transmissions(ask: &mut Asker) {
    let m = ask.m;
    for (i, pin) in m.points.iter().enumerate() {
        let [b, c] = pin.of.as_slice() else { continue };
        let ends = [*b, *c].map(|b| match m.bodies[b].joins.as_slice() {
            [p, q] if *p == i => Some(*q),
            [p, q] if *q == i => Some(*p),
            _ => None,
        });
        let [Some(p), Some(q)] = ends else { continue };
        if m.points[p].of.len() < 2 || m.points[q].of.len() < 2 {
            continue;
        }
        let (arm, other) = (minus(m.at(p), pin.at), minus(m.at(q), pin.at));
        let between = libm::atan2(cross(arm, other).abs(), dot(arm, other));
        let name = format!("transmission({}/{})", m.bodies[*b].number, m.bodies[*c].number);
        ask.add(name, Truth::Scalar(between), 0, 0);
    }
}

/// The instant centre of two bodies.
fn centre(ask: &mut Asker, b: usize, c: usize) {
    let (m, state) = (ask.m, ask.state);
    let name = format!("I({},{})", m.bodies[b].number, m.bodies[c].number);
    let at = m.points[0].at;
    let apart = |f: fn(Moving) -> Place| minus(f(state.place(b, at)), f(state.place(c, at)));
    // At a momentary rest of everything, accelerations are as velocities a moment later.
    let rest = m.inputs.iter().all(|i| i.rate == 0.0);
    // Nor has it a centre by nature where several inputs rest.
    if m.inputs.len() > 1 && rest {
        return;
    }
    let ((turn, apart), (v, w)) = if rest {
        let turn = state.turn(b).second - state.turn(c).second;
        ((turn, apart(Moving::acceleration)), (ask.scales[2], ask.scales[4]))
    } else {
        let turn = state.turn(b).rate - state.turn(c).rate;
        ((turn, apart(Moving::velocity)), (ask.scales[1], ask.scales[3]))
    };
    let far = ask.scales[0];
    if turn.abs() < 1e-9 * w {
        if length(apart) > 1e-6 * v {
            let direction = unit(left(apart));
            let off = EXACT * v / length(apart);
            ask.asked.push(Asked { name, truth: Truth::AtInfinity(direction), off });
        }
        return;
    }
    if turn.abs() < 1e-3 * w {
        return;
    }
    // v + ω × r = 0.
    let arm = left(apart).map(|x| x / turn);
    let place = plus(at, arm, 1.0);
    let off = (w / turn.abs()) * (1.0 + length(arm) / far);
    ask.add(name, Truth::Vector(place), 1, 0);
    if let Some(last) = ask.asked.last_mut() {
        last.off *= off;
    }
}
