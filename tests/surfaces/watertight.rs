//! Meshes without holes are drawn without: every sample of a closed mesh is covered by as many
//! triangles that face the eye as that do not, and a sample on an edge by one of its two.

use glam::Vec3;
use motes::cpu::raster::{BLOCK_PX, Edges, Polygon};
use motes::layout::Frame;
use motes::mesh::{self, Mesh};

use super::common::hash;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;

/// A camera that looks along z, from the origin.
fn frame() -> Frame {
    Frame {
        width: WIDTH,
        height: HEIGHT,
        focal_px: 60.0,
        center_x_px: 48.0,
        center_y_px: 32.0,
        near: 0.05,
        ..Frame::default()
    }
}

/// How many triangles cover each sample.
fn counts(frame: &Frame, triangles: impl Iterator<Item = [Vec3; 3]>) -> Vec<u32> {
    let mut counts = vec![0; (WIDTH * HEIGHT * 4) as usize];
    for corners in triangles {
        let polygon = Polygon::new(frame, corners);
        let [across, down] = polygon.blocks();
        for (at, block) in
            (0..polygon.triangles()).flat_map(|at| (0..across * down).map(move |block| (at, block)))
        {
            let place = [block % across, block / across];
            let pixel = [0, 1].map(|axis| polygon.first[axis] + place[axis] * BLOCK_PX);
            let edges = Edges::new(polygon.triangle(at), pixel);
            let size = [0, 1].map(|axis| (polygon.end[axis] - pixel[axis]).min(BLOCK_PX));
            let mut touched = false;
            for (down, right) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (y, x))) {
                let first = ((pixel[1] + down) as u32 * WIDTH + (pixel[0] + right) as u32) * 4;
                for (sample, inside) in edges.samples_in(right, down).into_iter().enumerate() {
                    counts[first as usize + sample] += u32::from(inside);
                    touched |= inside;
                }
            }
            assert!(!touched || !edges.misses(size), "a block that is touched");
        }
    }
    counts
}

/// Triangles of a mesh, turned and moved somehow.
fn triangles(mesh: &Mesh, seed: u32, middle: Vec3, scale: f32) -> Vec<[Vec3; 3]> {
    let random = |at: u32| hash(seed * 7 + at) as f32 / 4_294_967_296.0 * std::f32::consts::TAU;
    let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, random(0), random(1), random(2));
    let place = |corner: [f32; 3]| turn * (Vec3::from(corner) * scale) + middle;
    let faces = 0..mesh.triangles().len();
    faces.map(|face| mesh.corners(face).map(place)).collect()
}

fn closed_meshes() -> Vec<Mesh> {
    ["cube", "sphere", "torus", "cylinder"]
        .into_iter()
        .map(|name| {
            mesh::builtin(name)
                .expect("it is built in")
                .expect("it is right")
        })
        .collect()
}

#[test]
fn closed_meshes_have_as_many_fronts_as_backs_in_every_sample() {
    for mesh in closed_meshes() {
        for seed in 0..12 {
            let scale = [1.0, 0.2, 7.0][seed as usize % 3];
            let middle = Vec3::new(0.1, -0.05, 3.0 * scale + 0.3);
            let counts = counts(&frame(), triangles(&mesh, seed, middle, scale).into_iter());
            let odd = counts.iter().filter(|count| **count % 2 == 1).count();
            assert_eq!(odd, 0, "{} {seed}", mesh.name());
            let covered = counts.iter().filter(|count| **count > 0).count();
            assert!(covered > counts.len() / 60, "{} {seed}", mesh.name());
        }
    }
}

#[test]
fn from_inside_a_ball_or_a_cube_there_is_one_wall_everywhere() {
    for mesh in closed_meshes().iter().take(2) {
        for seed in 0..6 {
            // Walls are clipped at the near plane, and far beside the picture.
            let middle = Vec3::new(0.1, 0.0, 0.1);
            for scale in [1.0, 300.0] {
                let counts = counts(&frame(), triangles(mesh, seed, middle, scale).into_iter());
                let wrong = counts.iter().filter(|count| **count != 1).count();
                assert_eq!(wrong, 0, "{} {seed} {scale}", mesh.name());
            }
        }
    }
}

#[test]
fn samples_on_a_shared_edge_are_of_one_triangle() {
    // Corners on whole subpixels of the depth 60: edges go through samples.
    let grid = |x: u32, y: u32| {
        let step = |at: u32, odd: u32| at as f32 * 4.0 + odd as f32 * 0.125;
        Vec3::new(
            step(x, hash(x * 97 + y) % 3) - 40.0,
            step(y, hash(x * 89 + y + 7) % 3) - 28.0,
            60.0,
        )
    };
    let quads = (0..20u32).flat_map(|x| (0..14u32).map(move |y| (x, y)));
    let triangles = quads.flat_map(|(x, y)| {
        let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| grid(x + i, y + j));
        [[a, b, c], [a, d, c]]
    });
    let counts = counts(&frame(), triangles);
    let inside = |sample: usize| {
        let pixel = sample as u32 / 4;
        (10..85).contains(&(pixel % WIDTH)) && (6..58).contains(&(pixel / WIDTH))
    };
    for (sample, count) in counts.iter().enumerate() {
        assert!(*count <= 1, "{sample}: {count}");
        assert!(*count == 1 || !inside(sample), "{sample}");
    }
}

#[test]
fn products_of_edges_are_whole_numbers() {
    let values = [
        -8_000_000, -4096, -4095, -65, -64, -63, -1, 0, 1, 63, 64, 4095, 4096, 7_999_999,
    ];
    for a in values {
        for d in values {
            let (b, c) = (hash(a as u32) as i32 >> 9, hash(d as u32) as i32 >> 9);
            for bias in [0, 1] {
                let whole = i128::from(a) * i128::from(b) - i128::from(c) * i128::from(d);
                let wanted = (whole - i128::from(bias)).div_euclid(64);
                let wanted = wanted.clamp(-(1 << 29), 1 << 29);
                let got = motes::cpu::raster::wide(a, b, c, d, bias);
                assert_eq!(i128::from(got), wanted, "{a} {b} {c} {d}");
            }
        }
    }
}
