//! Shadows of strokes on the ground.

use motes::layout::Cover;
use motes::scene::Scene;

use crate::support::{
    BLADES, HEIGHT, Vector, WIDTH, distance, dot, drawn, ends, particles, plus, records, scene,
    seen, unit,
};

const FROM: Vector = [0.6, 0.9, -0.3];
const NORMAL: Vector = [0.1, 1.0, 0.05];

fn shaded(more: &str) -> Scene {
    let lines = format!("{BLADES}\nstroke_shadow = 0.4\ntransparency = 0.25");
    let picture = format!(
        "light.direction = {FROM:?}\n light.color = [0.9, 0.8, 0.7]\n light.ambient = [0.2, 0.3, 0.4]
         ground = {{ position = [0, -0.1, 0], normal = {NORMAL:?}, radius = 8, color = [0.8, 0.6, 0.4] }}
         {more}"
    );
    scene(&picture, &[&lines])
}

/// Those of shadows, stroke by stroke.
fn shadows(scene: &Scene) -> Vec<Vec<Cover>> {
    let (plan, mut backend) = drawn(scene, 0);
    let all = records(&plan, &mut backend);
    all.into_iter().map(|[shadow, _]| shadow).collect()
}

#[test]
fn shadows_are_where_light_past_the_parabola_meets_the_ground() {
    let scene = shaded("");
    let (normal, from) = (unit(NORMAL), unit(FROM));
    let bend = scene.systems[0].acceleration.map(f64::from);
    let mut count = 0;
    for (pieces, state) in shadows(&scene).iter().zip(particles(&scene, 0)) {
        let birth = state.position.map(f64::from);
        let first = state.velocity.map(f64::from);
        let curve: Vec<[f64; 2]> = (0..=2000)
            .map(|at| {
                let frames = f64::from(state.lifetime) * f64::from(at) / 2000.0;
                let place = plus(plus(birth, first, frames), bend, 0.5 * frames * frames);
                let height = dot(normal, plus(place, [0.0, -0.1, 0.0], -1.0));
                let ground = plus(place, from, -height / dot(normal, from));
                assert!(dot(normal, plus(ground, [0.0, -0.1, 0.0], -1.0)).abs() < 1e-9);
                seen(&scene, ground).0
            })
            .collect();
        for piece in pieces {
            let [a, b] = ends(piece);
            let middle = [0, 1].map(|i| (a[i] + b[i]) / 2.0);
            let [x, y] = middle;
            if x < 2.0 || y < 2.0 || x > f64::from(WIDTH) - 2.0 || y > f64::from(HEIGHT) - 2.0 {
                continue;
            }
            for place in [a, middle, b] {
                let spans = curve.windows(2).map(|two| distance(place, two[0], two[1]));
                let off = spans.fold(f64::INFINITY, f64::min);
                assert!(off < 0.5, "{off} px");
            }
            count += 1;
            // What the ground sends back of the light from everywhere.
            let got = [0, 1, 2].map(|i| f32::from_bits(piece.color[i]));
            let wanted = [0.8 * 0.2, 0.6 * 0.3, 0.4 * 0.4];
            assert!((0..3).all(|i| (got[i] - wanted[i]).abs() < 1e-5), "{got:?}");
            let alpha = f32::from_bits(piece.color[3]);
            assert!(alpha > 0.2 && alpha <= 0.4 * 0.75 + 1e-3, "{alpha}");
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn there_are_no_shadows_without_light_or_ground() {
    let is_dark = |scene: &Scene| shadows(scene).iter().all(Vec::is_empty);
    assert!(!is_dark(&shaded("")));
    let mut low = shaded("");
    low.light.direction = [1.0, -0.2, 0.0];
    assert!(is_dark(&low), "the light comes from below");
    let mut bare = shaded("");
    bare.ground = None;
    assert!(is_dark(&bare), "there is no ground");
}
