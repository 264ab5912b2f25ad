//! Boids that are cones: the hull of a ball and a point, which is what balls cover that shrink to
//! nothing on their way from one to the other.

use crate::looks::{boids, picture, pixels};
use crate::support::*;

type Vector = [f64; 3];

/// Diameter of the base, world units and pixels.
const SIZE: f64 = 16.0;

/// The balls of a cone in the middle of the picture that points that way: centres, with x to the
/// right, y up and z to the viewer, and radii.
fn balls(way: Vector) -> impl Iterator<Item = (Vector, f64)> {
    (0..=150).map(move |at| {
        let t = f64::from(at) / 150.0;
        let along = (-0.75 + 2.0 * t) * SIZE;
        (way.map(|part| part * along), 0.5 * SIZE * (1.0 - t))
    })
}

/// The nearest of all balls' surfaces at a place of the picture: its normal, if there is any.
fn surface(way: Vector, x: f64, y: f64) -> Option<Vector> {
    let points = balls(way).filter_map(|([cx, cy, cz], radius)| {
        let aside = (x - cx).powi(2) + (y - cy).powi(2);
        let toward = (radius * radius - aside).sqrt();
        (aside < radius * radius).then(|| {
            let normal = [(x - cx) / radius, (y - cy) / radius, toward / radius];
            (cz + toward, normal)
        })
    });
    let nearest = points.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(nearest.1)
}

/// What the red of a pixel should be in this light, of white with an ambient light of a fifth, by 16
/// samples.
fn expected(way: Vector, light: Vector, column: usize, row: usize) -> f64 {
    let samples = (0..16).map(|at| {
        let x = column as f64 + (f64::from(at % 4) + 0.5) / 4.0 - 100.0;
        let y = 50.0 - row as f64 - (f64::from(at / 4) + 0.5) / 4.0;
        surface(way, x, y).map_or(0.0, |normal| {
            let straight: f64 = (0..3).map(|axis| normal[axis] * light[axis]).sum();
            0.2 + 0.8 * straight.max(0.0)
        })
    });
    samples.sum::<f64>() / 16.0
}

fn unit(v: Vector) -> Vector {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// Red, 0 to 1, of a picture of the cone, and the greatest error of a pixel and the mean one where
/// anything is.
fn compared(way: Vector, light: Vector) -> (f64, f64) {
    let lines = format!("shape = \"cone\"\nsize = {SIZE}\ndimensions = 3");
    let mut scene = pixels(&[boids(1, &lines)], "[0, 0, 0]");
    // World y goes down in the picture, and z away from the viewer.
    scene.light.direction = [light[0] as f32, -light[1] as f32, -light[2] as f32];
    scene.light.color = [0.8; 3];
    scene.light.ambient = [0.2; 3];
    let velocity = [way[0] as f32, -way[1] as f32, -way[2] as f32];
    let got = picture(&plan(&scene), &[([100.0, 50.0, 0.0], velocity)]);
    let (mut worst, mut sum, mut count) = (0.0f64, 0.0, 0);
    for (at, [red, ..]) in got.iter().enumerate() {
        let (column, row) = (at % 200, at / 200);
        if column.abs_diff(100) > 40 || row.abs_diff(50) > 40 {
            assert_eq!(*red, 0, "{column}, {row}");
            continue;
        }
        let expected = expected(way, light, column, row);
        let error = (f64::from(*red) / 255.0 - expected).abs();
        worst = worst.max(error);
        if expected > 0.0 {
            (sum, count) = (sum + error, count + 1);
        }
    }
    (worst, sum / f64::from(count))
}

#[test]
fn cones_are_lit_hulls_of_a_ball_and_a_point() {
    let ways = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-0.6, -0.8, 0.0],
        [0.8, 0.2, 0.5],
        [0.5, -0.6, -0.6],
        [0.1, 0.1, 1.0],
        [0.05, 0.0, -1.0],
    ];
    let lights = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.2], [-0.7, 0.3, 0.6]];
    for way in ways.map(unit) {
        for light in lights.map(unit) {
            let (worst, mean) = compared(way, light);
            println!("{way:.2?} in {light:.2?}: {mean:.4}, at most {worst:.3}");
            // Pixels of the outline are lit by their middle.
            assert!(mean < 0.03, "{way:?} in {light:?}: {mean}");
        }
    }
}

/// Those that are smaller than a pixel keep their light.
#[test]
fn small_cones_are_as_much_clearer() {
    let sum = |size: f64| -> f64 {
        let lines = format!("shape = \"cone\"\nsize = {size}\ncolor = [1, 1, 1]");
        let mut scene = pixels(&[boids(1, &lines)], "[0, 0, 0]");
        scene.light.color = [0.0; 3];
        scene.light.ambient = [1.0; 3];
        let mut sum = 0.0;
        for at in 0..8 {
            let x = 100.0 + 0.125 * at as f32;
            let state = ([x, 50.3, 0.0], [1.0, 0.3, 0.0]);
            let picture = picture(&plan(&scene), &[state]);
            sum += picture.iter().map(|[red, ..]| f64::from(*red)).sum::<f64>() / 255.0 / 8.0;
        }
        sum
    };
    // Half the base, and the triangle between it and the apex, of sines and cosines of its angle.
    let area = |size: f64| {
        let (radius, length) = (0.5 * size, 2.0 * size);
        let tangent = (length * length - radius * radius).sqrt();
        radius * tangent + radius * radius * (std::f64::consts::PI - (radius / length).acos())
    };
    for (size, tolerance) in [(8.0, 0.05), (2.0, 0.15), (0.5, 0.5)] {
        let part = sum(size) / area(size);
        println!("{size}: {part}");
        assert!((part - 1.0).abs() < tolerance, "{size}: {part}");
    }
}

/// What is mirrored is lit from the other side.
#[test]
fn mirrored_cones_are_their_own_mirror_images() {
    let lines = "shape = \"cone\"\nsize = 20\nopacity = 0.8\nmirrored = true";
    let mut scene = pixels(&[boids(3, lines)], "[0.5, 0.5, 0.5]");
    scene.light.direction = [1.0, -0.3, -0.5];
    let states = [
        ([60.0, 40.0, 0.0], [1.0, 0.5, 0.0]),
        ([96.0, 60.0, 0.0], [0.2, 1.0, 0.0]),
        ([120.3, 50.0, 0.0], [-1.0, 0.1, 0.0]),
    ];
    let picture = picture(&plan(&scene), &states);
    for row in picture.chunks(200) {
        let mirrored: Vec<[u8; 3]> = row.iter().rev().copied().collect();
        assert_eq!(row, mirrored);
    }
    let lit = |from: usize, to: usize| -> u32 {
        let rows = picture.chunks(200).flat_map(|row| &row[from..to]);
        rows.map(|[red, ..]| u32::from(*red)).sum()
    };
    assert_eq!(lit(0, 100), lit(100, 200));
    assert!(picture.iter().any(|[red, ..]| *red > 200));
}
