//! Points and directions as three numbers.

pub(crate) type Vector = [f64; 3];

pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a` and `by` times `b`.
pub(crate) fn add(a: Vector, b: Vector, by: f64) -> Vector {
    [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector of a direction; `None` for one without length.
pub(crate) fn unit(a: Vector) -> Option<Vector> {
    let length = norm(a);
    (length > 1e-9 && length.is_finite()).then(|| a.map(|part| part / length))
}

/// The part of a vector across a unit vector.
pub(crate) fn across(a: Vector, axis: Vector) -> Vector {
    add(a, axis, -dot(a, axis))
}
