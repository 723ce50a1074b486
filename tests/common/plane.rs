//! Vectors of the plane, as the tests reckon with them.

pub(crate) type Xy = [f64; 2];

pub(crate) fn plus(a: Xy, b: Xy) -> Xy {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn minus(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn times(a: Xy, k: f64) -> Xy {
    [a[0] * k, a[1] * k]
}

pub(crate) fn dot(a: Xy, b: Xy) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross(a: Xy, b: Xy) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// ω × r.
pub(crate) fn turned(omega: f64, r: Xy) -> Xy {
    [-omega * r[1], omega * r[0]]
}

/// At this angle, radians.
pub(crate) fn unit(angle: f64) -> Xy {
    [libm::cos(angle), libm::sin(angle)]
}

pub(crate) fn long(a: Xy) -> f64 {
    libm::hypot(a[0], a[1])
}
