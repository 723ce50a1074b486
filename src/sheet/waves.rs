//! Torques by sums of waves: the sum of several cylinders, its slope and its integral, as they are written.

use super::human;
use super::rich::Rich;
use crate::mechanism::curve::Curve;
use crate::mechanism::cycle::Cycle;

/// A constant with sines and cosines of multiples of the input's angle, N m or J.
#[derive(Debug, Clone)]
pub(super) struct Waves {
    pub(super) constant: f64,
    /// Order, and the sizes of its sine and its cosine; no order stands twice.
    terms: Vec<[f64; 3]>,
}

impl Waves {
    /// A curve of harmonics with all its copies, over the angle of the input; none of a table.
    pub(super) fn of(curve: &Curve, cycle: &Cycle) -> Option<Self> {
        let Curve::Harmonics { constant, sin, cos } = curve else { return None };
        let mut sum = Self { constant: constant.value * f64::from(cycle.copies.number), terms: Vec::new() };
        let waves = sin.iter().map(|wave| (wave, [wave.size.value, 0.0]));
        for (wave, [sine, cosine]) in waves.chain(cos.iter().map(|wave| (wave, [0.0, wave.size.value]))) {
            for copy in 0..cycle.copies.number {
                // A copy comes later in the sense of the motion.
                let later = f64::from(copy) * cycle.copies.shift.value * wave.order.value;
                let (s, c) = libm::sincos(if cycle.falling { -later } else { later });
                sum.add([wave.order.value, sine * c + cosine * s, cosine * c - sine * s]);
            }
        }
        let size = sin.iter().chain(cos).fold(0.0, |most: f64, wave| most.max(wave.size.value.abs()));
        sum.clear(size);
        Some(sum)
    }

    fn add(&mut self, [order, sine, cosine]: [f64; 3]) {
        match self.terms.iter_mut().find(|term| term[0] == order) {
            Some(term) => {
                term[1] += sine;
                term[2] += cosine;
            }
            None => self.terms.push([order, sine, cosine]),
        }
    }

    /// Takes out what cancels but for rounding.
    fn clear(&mut self, size: f64) {
        for part in self.terms.iter_mut().flat_map(|term| &mut term[1..]) {
            if part.abs() <= 1e-12 * size {
                *part = 0.0;
            }
        }
        self.terms.retain(|term| term[1] != 0.0 || term[2] != 0.0);
    }

    /// So many times as large.
    pub(super) fn times(mut self, by: f64) -> Self {
        self.constant *= by;
        self.terms.iter_mut().for_each(|term| {
            term[1] *= by;
            term[2] *= by;
        });
        self
    }

    /// The sum of both.
    pub(super) fn plus(mut self, other: Self) -> Self {
        let size = self.size().max(other.size());
        self.constant += other.constant;
        other.terms.into_iter().for_each(|term| self.add(term));
        self.clear(size);
        self
    }

    /// The largest of its waves.
    pub(super) fn size(&self) -> f64 {
        self.terms.iter().fold(0.0, |most, term| most.max(term[1].abs()).max(term[2].abs()))
    }

    /// Its value at an angle, rad.
    pub(super) fn at(&self, angle: f64) -> f64 {
        self.terms.iter().fold(self.constant, |sum, [order, sine, cosine]| {
            let (s, c) = libm::sincos(order * angle);
            sum + sine * s + cosine * c
        })
    }

    /// How it grows with the angle.
    pub(super) fn slope(&self) -> Self {
        let terms = self.terms.iter().map(|[order, sine, cosine]| [*order, -order * cosine, order * sine]);
        Self { constant: 0.0, terms: terms.collect() }
    }

    /// The integral of its waves over the angle.
    pub(super) fn integral(&self) -> Self {
        let terms = self.terms.iter().map(|[order, sine, cosine]| [*order, cosine / order, -sine / order]);
        Self { constant: 0.0, terms: terms.collect() }
    }

    /// As it is written in a unit of this size, each number by `write`.
    pub(super) fn told(&self, unit: f64, write: fn(f64) -> Rich) -> Rich {
        let mut sum = if self.constant == 0.0 { Rich::default() } else { write(self.constant / unit) };
        let mut first = self.constant == 0.0;
        for [order, sine, cosine] in &self.terms {
            for (size, name) in [(sine, "sin"), (cosine, "cos")] {
                if *size == 0.0 {
                    continue;
                }
                let sign = match (first, *size < 0.0) {
                    (true, false) => "",
                    (true, true) => "−",
                    (false, false) => " +\u{a0}",
                    (false, true) => " −\u{a0}",
                };
                first = false;
                sum = sum.up(sign).then(&write(size.abs() / unit)).up(&format!("\u{a0}{name}\u{a0}"));
                if *order != 1.0 {
                    sum = sum.then(&human::stated(*order));
                }
                sum = sum.it("θ");
            }
        }
        sum
    }
}

/// A size of a wave: as it is stated, or with four figures.
pub(super) fn rounded(value: f64) -> Rich {
    human::given(value, 0).0
}
