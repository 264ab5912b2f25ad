//! Where strokes are: against the closed form, and against particles that fly.

use motes::scene::{Integration, ParticleShape, Scene};

use crate::support::{
    BLADES, HEIGHT, Vector, WIDTH, distance, drawn, ends, particles, plus, records, scene, seen,
};

/// A particle's place after so many frames of its life: p0 + v0 t + a t^2 / 2.
fn parabola(birth: Vector, first: Vector, bend: Vector, frames: f64) -> Vector {
    plus(plus(birth, first, frames), bend, 0.5 * frames * frames)
}

/// Whether a place is in the picture, with some room to its edges.
fn is_inside([x, y]: [f64; 2]) -> bool {
    let (width, height) = (f64::from(WIDTH), f64::from(HEIGHT));
    x > 2.0 && y > 2.0 && x < width - 2.0 && y < height - 2.0
}

/// How far the pieces of all strokes are from their parabolas, and the parabolas from the pieces, pixels,
/// at most; and how many pieces there are.
fn strays(scene: &Scene) -> (f64, usize) {
    let (plan, mut backend) = drawn(scene, 3);
    let all = records(&plan, &mut backend);
    let states = particles(scene, 3);
    assert_eq!(all.len(), states.len());
    let bend = scene.systems[0].acceleration.map(f64::from);
    let (mut most, mut count) = (0.0f64, 0);
    for ([_, pieces], state) in all.iter().zip(&states) {
        let birth = state.position.map(f64::from);
        let first = state.velocity.map(f64::from);
        let frames = f64::from(state.lifetime);
        let curve: Vec<([f64; 2], f64)> = (0..=2000)
            .map(|at| {
                seen(
                    scene,
                    parabola(birth, first, bend, frames * f64::from(at) / 2000.0),
                )
            })
            .collect();
        for piece in pieces {
            let [a, b] = ends(piece);
            for at in 0..=8 {
                let part = f64::from(at) / 8.0;
                let place = [0, 1].map(|i| a[i] + (b[i] - a[i]) * part);
                let spans = curve
                    .windows(2)
                    .map(|two| distance(place, two[0].0, two[1].0));
                if is_inside(place) {
                    most = most.max(spans.fold(f64::INFINITY, f64::min));
                }
            }
        }
        for (place, depth) in &curve {
            if *depth > 0.2 && is_inside(*place) {
                let spans = pieces.iter().map(|piece| {
                    let [a, b] = ends(piece);
                    distance(*place, a, b)
                });
                most = most.max(spans.fold(f64::INFINITY, f64::min));
            }
        }
        count += pieces.len();
    }
    (most, count)
}

#[test]
fn r80_strokes_are_within_half_a_pixel_of_their_parabolas() {
    let (far, of_far) = strays(&scene("", &[BLADES]));
    // Among them, some of them all across the picture.
    let (near, of_near) = strays(&scene("camera.position = [0.1, 0.7, 1.2]", &[BLADES]));
    println!("{far} px with {of_far} pieces, {near} px with {of_near} pieces");
    assert!(far < 0.5 && near < 0.5, "{far} and {near}");
    // No more pieces than that takes.
    assert!(of_far < 40 * 20 && of_near > 300);
}

#[test]
fn r80_too_few_pieces_stray() {
    let few = BLADES.replace("stroke_pieces = 48", "stroke_pieces = 2");
    let (most, count) = strays(&scene("", &[&few]));
    assert!(most > 1.0 && count <= 80, "{most} with {count}");
}

#[test]
fn r80_what_flies_stays_on_its_stroke() {
    for (integration, word) in [
        (Integration::Euler, "euler"),
        (Integration::Parabola, "parabola"),
    ] {
        let lines = BLADES.replace("\"parabola\"", &format!("\"{word}\""));
        let still = scene("", &[&lines]);
        assert_eq!(still.systems[0].integration, integration);
        let (plan, mut backend) = drawn(&still, 0);
        let all = records(&plan, &mut backend);
        let ids: Vec<u32> = particles(&still, 0).iter().map(|state| state.id).collect();
        let mut flying = still.clone();
        flying.systems[0].particle_shape = ParticleShape::Sphere;
        let mut met = 0;
        for frame in [0, 3, 9, 17, 24] {
            for state in particles(&flying, frame) {
                let at = ids.iter().position(|id| *id == state.id);
                let [_, pieces] = &all[at.expect("it is a stroke, too")];
                let (place, depth) = seen(&still, state.position.map(f64::from));
                if depth < 0.2 || !is_inside(place) {
                    continue;
                }
                let spans = pieces.iter().map(|piece| {
                    let [a, b] = ends(piece);
                    distance(place, a, b)
                });
                let off = spans.fold(f64::INFINITY, f64::min);
                assert!(off < 0.5, "{word}, frame {frame}: {off} px");
                met += 1;
            }
        }
        assert!(met > 120, "{met}");
    }
}
