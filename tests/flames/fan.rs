//! A particle of a flame is a fan of triangles: the reference that its radial shading is held
//! against.

use motes::cpu::fan::{CORNERS, center_share};
use motes::layout::{FLAME_STEPS, FlameDisc};

use crate::support::*;

/// A vertex: x, y, then red, green, blue and alpha.
pub(crate) type Vertex = [f64; 6];

/// Triangles around a centre, their rim a regular polygon on the unit circle.
fn fan() -> Vec<[[f64; 2]; 3]> {
    let corner = |at: u32| {
        let angle = std::f64::consts::TAU * f64::from(at % CORNERS) / f64::from(CORNERS);
        [angle.cos(), angle.sin()]
    };
    (0..CORNERS)
        .map(|at| [[0.0, 0.0], corner(at), corner(at + 1)])
        .collect()
}

/// Twice the signed area.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Gouraud shading at a place: red, green, blue and alpha linear in the triangle; `None` outside.
pub(crate) fn shaded(triangle: [Vertex; 3], at: [f64; 2]) -> Option<[f64; 4]> {
    let [a, b, c] = triangle.map(|vertex| [vertex[0], vertex[1]]);
    let whole = cross(a, b, c);
    let weights = [cross(at, b, c), cross(a, at, c), cross(a, b, at)].map(|part| part / whole);
    weights.iter().all(|weight| *weight >= 0.0).then(|| {
        [2, 3, 4, 5].map(|i| {
            (0..3)
                .map(|corner| weights[corner] * triangle[corner][i])
                .sum()
        })
    })
}

/// The triangles of particles as they are seen, in pixels: 20 each.
pub(crate) fn fans_of(discs: &[FlameDisc]) -> Vec<[Vertex; 3]> {
    let of_disc = |disc: &FlameDisc| {
        let [place, center, rim] = [disc.place, disc.center, disc.rim]
            .map(|words| words.map(|bits| f64::from(f32::from_bits(bits))));
        let [x, y, inverse_width, inverse_height] = place;
        let vertex = move |at: [f64; 2], light: [f64; 4]| {
            let [x, y] = [x + at[0] / inverse_width, y + at[1] / inverse_height];
            [x, y, light[0], light[1], light[2], light[3]]
        };
        let triangles = fan().into_iter();
        triangles
            .map(move |[middle, a, b]| [vertex(middle, center), vertex(a, rim), vertex(b, rim)])
    };
    discs.iter().flat_map(of_disc).collect()
}

#[test]
fn p21_a_particle_is_a_fan_around_its_place() {
    let fan = fan();
    assert_eq!(fan.len(), 20);
    let mut rims: Vec<[i64; 2]> = fan
        .iter()
        .flat_map(|triangle| [triangle[1], triangle[2]])
        .map(|corner| corner.map(|x| (x * 1e9).round() as i64))
        .collect();
    rims.sort_unstable();
    let twice = rims.chunks(2).all(|two| two[0] == two[1]);
    assert!(
        twice && rims.len() == 40,
        "each rim vertex is in two triangles"
    );
    let area: f64 = fan.iter().map(|[a, b, c]| cross(*a, *b, *c) / 2.0).sum();
    assert!((area - 3.0902).abs() < 1e-4, "{area}");
    // The shading covers the same: shares are 1 in the middle and 0 from the polygon's sides on.
    let cells = 1000;
    let side = 2.0 / f64::from(cells);
    let at = |cell: i32| (f64::from(cell) + 0.5) * side - 1.0;
    let mut covered = 0.0;
    for x in 0..cells {
        for y in 0..cells {
            let share = center_share(at(x) as f32, at(y) as f32);
            covered += f64::from(u8::from(share > 0.0)) * side * side;
        }
    }
    assert!((covered - 3.0902).abs() < 3e-3, "{covered}");
}

#[test]
fn p22_shading_is_that_of_the_triangles() {
    let white = [1.0, 1.0, 1.0, 1.0];
    let vertex =
        |at: [f64; 2], light: [f64; 4]| [at[0], at[1], light[0], light[1], light[2], light[3]];
    for seed in 0..5000 {
        let [x, y] =
            [0, 1].map(|i| f64::from(crate::common::hash(2 * seed + i)) / 2f64.powi(31) - 1.0);
        let lit = fan().iter().find_map(|corners| {
            let center = vertex(corners[0], white);
            let rim = [1, 2].map(|at| vertex(corners[at], [0.0; 4]));
            shaded([center, rim[0], rim[1]], [x, y])
        });
        let wanted = lit.map_or(0.0, |light| light[3]);
        let got = f64::from(center_share(x as f32, y as f32));
        assert!(
            (got - wanted).abs() < 2e-6,
            "{got} instead of {wanted} at {x}, {y}"
        );
    }
    // Nearly linear from the centre to the rim, whichever way.
    for turn in 0..97 {
        let angle = std::f64::consts::TAU * f64::from(turn) / 97.0;
        let share = |r: f64| {
            f64::from(center_share(
                (r * angle.cos()) as f32,
                (r * angle.sin()) as f32,
            ))
        };
        let slope = 1.0 - share(1e-1);
        for r in [0.2, 0.5, 0.9] {
            assert!((1.0 - share(r) - 10.0 * r * slope).abs() < 1e-5);
            assert!(
                (share(r) - (1.0 - r)).abs() < 0.0125,
                "within 1.25 % of a cone"
            );
        }
    }
}

#[test]
fn p26_a_flame_is_25_fans_of_20_triangles_that_accumulate() {
    // Bent, coloured differently inside and at the rim, and opaque at the rim, too.
    let lines = "noisiness = 0.2\nheight = 0.7\nwidth = 0.5\nramp = [\
        { age = 0, center = [1, 0.5, 0.2], rim = [0.2, 0.9, 0.1], alpha = 0.2, rim_alpha = 0.1 },\
        { age = 1, center = [0.3, 0.6, 1], rim = [1, 0, 0.5], alpha = 0.05, rim_alpha = 0.02 }]";
    let scene = flame(lines);
    let drawn = drawn(&scene, 11);
    assert_eq!(drawn.discs.len(), FLAME_STEPS as usize);
    let (width, height) = (scene.image.width as usize, scene.image.height as usize);
    let mut wanted = vec![[0.0; 3]; width * height];
    let mut triangles = 0;
    for disc in &drawn.discs {
        let fan = fans_of(std::slice::from_ref(disc));
        triangles += fan.len();
        for (at, pixel) in wanted.iter_mut().enumerate() {
            let place = [(at % width) as f64 + 0.5, (at / width) as f64 + 0.5];
            if let Some([red, green, blue, alpha]) =
                fan.iter().find_map(|triangle| shaded(*triangle, place))
            {
                *pixel = [0, 1, 2].map(|i| pixel[i] + [red, green, blue][i] * alpha);
            }
        }
    }
    assert_eq!(triangles, 500);
    let lit = wanted.iter().filter(|pixel| pixel[0] > 0.0).count();
    assert!(lit > 1000, "{lit} pixels");
    // A rim that is not black ends at once: a pixel on it may be on either side.
    let differ = |(got, wanted): &(&[f64; 3], &[f64; 3])| length(minus(**got, **wanted)) > 3e-5;
    let off = drawn.light.iter().zip(&wanted).filter(differ).count();
    assert!(off <= 3, "{off} pixels differ");
}
