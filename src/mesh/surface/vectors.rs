//! Plain arithmetic on places: only what is rounded alike on every machine.

pub(super) type Place = [f64; 3];

pub(super) fn less(a: Place, b: Place) -> Place {
    [0, 1, 2].map(|i| a[i] - b[i])
}

pub(super) fn plus(a: Place, b: Place, factor: f64) -> Place {
    [0, 1, 2].map(|i| a[i] + factor * b[i])
}

pub(super) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Place, b: Place) -> Place {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(super) fn length(a: Place) -> f64 {
    dot(a, a).sqrt()
}

pub(super) fn unit(a: Place) -> Place {
    let length = length(a);
    a.map(|x| x / length)
}

/// The angle of (x, y), y at least 0, from the x axis: 0 to pi. Roots and a series, since the
/// platform's arc tangent is the platform's own.
pub(super) fn angle_of(x: f64, y: f64) -> f64 {
    if y <= 0.0 {
        return if x < 0.0 { std::f64::consts::PI } else { 0.0 };
    }
    let length = (x * x + y * y).sqrt();
    // The tangent of half the angle, and of its half, four times over: below 0.1.
    let mut tangent = if x > 0.0 {
        y / (length + x)
    } else {
        (length - x) / y
    };
    let mut factor = 2.0;
    for _ in 0..4 {
        tangent /= 1.0 + (1.0 + tangent * tangent).sqrt();
        factor *= 2.0;
    }
    let square = tangent * tangent;
    let series = (0..12).rev().fold(0.0, |sum, k| {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        sum * square + sign / f64::from(2 * k + 1)
    });
    factor * tangent * series
}

/// The place on the piece from `a` to `b` that is nearest to `p`.
pub(super) fn nearest_on(p: Place, a: Place, b: Place) -> Place {
    let along = less(b, a);
    let t = dot(less(p, a), along) / dot(along, along);
    plus(a, along, t.clamp(0.0, 1.0))
}

/// The distance between the pieces from `a` to `b` and from `c` to `d`, none of length 0.
pub(super) fn between([a, b]: [Place; 2], [c, d]: [Place; 2]) -> f64 {
    let to_piece = |p, [from, to]: [Place; 2]| length(less(p, nearest_on(p, from, to)));
    let ends = [
        to_piece(a, [c, d]),
        to_piece(b, [c, d]),
        to_piece(c, [a, b]),
        to_piece(d, [a, b]),
    ];
    let nearest = ends.into_iter().fold(f64::MAX, f64::min);
    // Nearer than any end only where the common perpendicular meets both.
    let (u, v, w) = (less(b, a), less(d, c), less(a, c));
    let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
    let (uw, vw) = (dot(u, w), dot(v, w));
    let divisor = uu * vv - uv * uv;
    if divisor <= 1e-12 * uu * vv {
        return nearest;
    }
    let s = (uv * vw - vv * uw) / divisor;
    let t = (uu * vw - uv * uw) / divisor;
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        return nearest.min(length(less(plus(a, u, s), plus(c, v, t))));
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_arc_tangent() {
        for at in 0..=1000 {
            let angle = std::f64::consts::PI * f64::from(at) / 1000.0;
            let (sin, cos) = angle.sin_cos();
            let off = angle_of(3.0 * cos, 3.0 * sin) - angle;
            assert!(off.abs() < 1e-14, "{angle} is off by {off}");
        }
    }

    #[test]
    fn distances_between_pieces() {
        let a = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        let crossing = between(a, [[1.0, -1.0, 0.5], [1.0, 1.0, 0.5]]);
        let beyond = between(a, [[5.0, 4.0, 0.0], [9.0, 4.0, 0.0]]);
        let beside = between(a, [[0.5, 2.0, 0.0], [9.0, 2.0, 0.0]]);
        for (found, right) in [(crossing, 0.5), (beyond, 5.0), (beside, 2.0)] {
            assert!((found - right).abs() < 1e-12, "{found} for {right}");
        }
    }
}
