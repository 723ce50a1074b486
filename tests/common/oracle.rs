//! Closed forms of simple mechanisms in the hundred-digit arithmetic. Dimensions are decimal text: what the
//! scene says is what the oracle reads.

use super::exact::Exact;

/// A four-bar with its crank's pivot at `at`, lengths in metres: frame (along +x), crank, coupler, rocker.
/// B is the higher of its two places.
#[derive(Debug, Clone)]
pub(crate) struct FourBar {
    pub(crate) at: [String; 2],
    pub(crate) lengths: [String; 4],
    pub(crate) angle: String,
    /// `deg` or `rad`.
    pub(crate) unit: &'static str,
    /// ω in rad/s and ε in rad/s².
    pub(crate) rates: [String; 2],
}

/// What [`FourBar::closed_form`] tells, in order.
pub(crate) const FOUR_BAR_QUANTITIES: [&str; 7] =
    ["x(B)", "v(B)", "a(B)", "omega(3)", "omega(4)", "alpha(3)", "alpha(4)"];

impl FourBar {
    pub(crate) fn scene(&self) -> String {
        let [x, y] = &self.at;
        let [ground, crank, coupler, rocker] = &self.lengths;
        let (angle, unit, [omega, alpha]) = (&self.angle, self.unit, &self.rates);
        let far = (Exact::decimal(x) + Exact::decimal(ground)).to_decimal(80);
        let size = ground.parse::<f64>().unwrap();
        // Next to a dead centre the two places are one for a hint from afar.
        let near = match self.closed_form() {
            Some(truth) => [truth[0][0].near(), truth[0][1].near()],
            None => [x, y].map(|t| t.parse::<f64>().unwrap() + size),
        };
        format!(
            r#"{{ "units": {{ "angle": "{unit}" }}, "fixed": {{ "O2": [{x}, {y}], "O4": [{far}, {y}] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": {crank} }},
                            "3": {{ "joins": ["A", "B"], "length": {coupler} }},
                            "4": {{ "joins": ["O4", "B"], "length": {rocker} }} }},
                 "near": {{ "B": [{}, {}] }},
                 "input": {{ "link": 2, "angle": {angle}, "omega": "{omega} rad/s", "alpha": "{alpha} rad/s^2" }},
                 "find": {FOUR_BAR_QUANTITIES:?} }}"#,
            near[0], near[1]
        )
    }

    /// From the loop equations; `None` where the chain does not close, or just so.
    pub(crate) fn closed_form(&self) -> Option<Vec<Vec<Exact>>> {
        let [r1, r2, r3, r4] = [0, 1, 2, 3].map(|i| Exact::decimal(&self.lengths[i]));
        let [w2, e2] = [0, 1].map(|i| Exact::decimal(&self.rates[i]));
        let theta = match self.unit {
            "deg" => Exact::decimal(&self.angle) * Exact::pi() / Exact::ratio(180, 1),
            _ => Exact::decimal(&self.angle),
        };
        let [cos, sin] = theta.cos_sin();
        let a = [&r2 * &cos, &r2 * &sin];
        let d = [&r1 - &a[0], -a[1].clone()];
        let square = &d[0] * &d[0] + &d[1] * &d[1];
        let along = (&square + &r3 * &r3 - &r4 * &r4) / (Exact::ratio(2, 1) * &square);
        let h = &r3 * &r3 / &square - &along * &along;
        if h.abs().near() < 1e-80 || h < Exact::zero() {
            return None;
        }
        let across = if d[0] >= Exact::zero() { h.sqrt() } else { -h.sqrt() };
        let ab = [&d[0] * &along - &d[1] * &across, &d[1] * &along + &d[0] * &across];
        let b = [&a[0] + &ab[0], &a[1] + &ab[1]];
        let ob = [&b[0] - &r1, b[1].clone()];
        // i ω₂ a + i ω₃ ab = i ω₄ ob, and its derivative; solved by Cramer's rule.
        let cross = |p: &[Exact; 2], q: &[Exact; 2]| &p[0] * &q[1] - &p[1] * &q[0];
        let det = cross(&ab, &ob);
        let w3 = &w2 * &cross(&ob, &a) / &det;
        let w4 = &w2 * &cross(&ab, &a) / &det;
        let right: Vec<Exact> = (0..2)
            .map(|k| {
                let turned = if k == 0 { -a[1].clone() } else { a[0].clone() };
                &w2 * &w2 * &a[k] + &w3 * &w3 * &ab[k] - &w4 * &w4 * &ob[k] - &e2 * &turned
            })
            .collect();
        let dot = |p: &[Exact; 2]| &p[0] * &right[0] + &p[1] * &right[1];
        let (e3, e4) = (dot(&ob) / &det, dot(&ab) / &det);
        let v = vec![-(&w4 * &ob[1]), &w4 * &ob[0]];
        let acc = vec![-(&e4 * &ob[1]) - &w4 * &w4 * &ob[0], &e4 * &ob[0] - &w4 * &w4 * &ob[1]];
        let place = [&b[0] + Exact::decimal(&self.at[0]), &b[1] + Exact::decimal(&self.at[1])];
        Some(vec![place.to_vec(), v, acc, vec![w3], vec![w4], vec![e3], vec![e4]])
    }
}

/// A slider-crank in line: crank, rod in metres, the guide along +x through the crank's pivot.
#[derive(Debug, Clone)]
pub(crate) struct Slider {
    pub(crate) lengths: [String; 2],
    /// Radians.
    pub(crate) angle: String,
    pub(crate) omega: String,
}

/// What [`Slider::closed_form`] tells, in order.
pub(crate) const SLIDER_QUANTITIES: [&str; 4] = ["x(B)", "v(B)", "a(B)", "omega(3)"];

impl Slider {
    pub(crate) fn scene(&self) -> String {
        let ([crank, rod], angle, omega) = (&self.lengths, &self.angle, &self.omega);
        // Next to the end of the guide's reach the two places are one for a hint from afar.
        let near = self.closed_form()[0][0].near();
        format!(
            r#"{{ "units": {{ "angle": "rad" }}, "fixed": {{ "O2": [0, 0] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": {crank} }},
                            "3": {{ "joins": ["A", "B"], "length": {rod} }} }},
                 "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }} ],
                 "near": {{ "B": [{near}, 0] }},
                 "input": {{ "link": 2, "angle": {angle}, "omega": "{omega} rad/s" }},
                 "find": {SLIDER_QUANTITIES:?} }}"#
        )
    }

    pub(crate) fn closed_form(&self) -> Vec<Vec<Exact>> {
        let [r, l] = [0, 1].map(|i| Exact::decimal(&self.lengths[i]));
        let w = Exact::decimal(&self.omega);
        let [cos, sin] = Exact::decimal(&self.angle).cos_sin();
        let (ax, ay) = (&r * &cos, &r * &sin);
        let dx = (&l * &l - &ay * &ay).sqrt();
        // The rod falls from A to the guide.
        let w3 = -(&w * &ax) / &dx;
        let v = -(&w * &ay) + &w3 * &ay;
        let e3 = (&w * &w * &ay - &w3 * &w3 * &ay) / &dx;
        let a = -(&w * &w * &ax) + &e3 * &ay - &w3 * &w3 * &dx;
        let zero = Exact::zero;
        vec![vec![&ax + &dx, zero()], vec![v, zero()], vec![a, zero()], vec![w3]]
    }
}
