//! Meshes that are seen: their triangles, once, and where they are in a frame.

use std::collections::HashMap;

use glam::Vec3;

use super::PlanError;
use super::fire::noise_key;
use super::planet::lamps_of;
use super::spread::grain_of;
use super::system::pose_of;
use crate::exact::{normalize_exact, snap};
use crate::layout::{Ground, Planet, SurfaceFrame, SurfaceLight};
use crate::mesh::{MOST_TRIANGLES, Mesh};
use crate::scene::{LitSurface, Projection, Scene};
use crate::transcendental::cos_turns;

/// Corners in one place whose triangles are looked at for one normal, at most; where there are more,
/// each has its own.
const MOST_AROUND: usize = 256;

/// The triangles of every mesh of a run that is seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceTables {
    /// Three a triangle: the bits of its place, and the word of its normal.
    pub corners: Vec<[u32; 4]>,
    /// Digest and crease, first triangle and number of triangles of each mesh.
    stored: Vec<((u64, u32), u32, u32)>,
}

fn key_of(surface: &LitSurface) -> (u64, u32) {
    (surface.mesh.digest(), surface.crease_degrees.to_bits())
}

impl SurfaceTables {
    /// The tables of all meshes that are seen in the scenes.
    pub(super) fn new(scenes: &[&Scene]) -> Result<Self, PlanError> {
        let mut tables = Self::default();
        for (at, surface) in scenes
            .iter()
            .flat_map(|one| one.surfaces.iter().enumerate())
        {
            if tables.place_of(surface).is_none() {
                let key = || format!("surface.{at}.mesh");
                tables.add(surface).map_err(|error| error.of_key(key()))?;
            }
        }
        Ok(tables)
    }

    /// The first triangle of a surface's mesh and how many it has.
    fn place_of(&self, surface: &LitSurface) -> Option<(u32, u32)> {
        let known = self.stored.iter().find(|own| own.0 == key_of(surface));
        known.map(|(_, first, count)| (*first, *count))
    }

    fn add(&mut self, surface: &LitSurface) -> Result<(), PlanError> {
        let first = self.corners.len() / 3;
        let count = surface.mesh.triangles().len();
        if first + count > MOST_TRIANGLES {
            return Err(too_many(first + count));
        }
        let cosine = f64::from(cos_turns(surface.crease_degrees / 360.0));
        let normals = corner_normals(&surface.mesh, cosine);
        for (face, normals) in (0..count).zip(normals) {
            for ([x, y, z], normal) in surface.mesh.corners(face).into_iter().zip(normals) {
                let [x, y, z] = [x, y, z].map(|at| snap(at).to_bits());
                self.corners.push([x, y, z, word_of(normal)]);
            }
        }
        self.stored
            .push((key_of(surface), first as u32, count as u32));
        Ok(())
    }
}

fn too_many(count: usize) -> PlanError {
    PlanError {
        message: format!("this scene's surfaces have {count} triangles"),
        help: format!("at most {MOST_TRIANGLES} in all"),
        key: None,
    }
}

/// The word of a unit vector, to the nearest step of an octahedron unfolded to a square.
fn word_of([x, y, z]: [f64; 3]) -> u32 {
    let sum = x.abs() + y.abs() + z.abs();
    let (mut u, mut v) = (x / sum, y / sum);
    if z < 0.0 {
        let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
        (u, v) = ((1.0 - v.abs()) * sign(u), (1.0 - u.abs()) * sign(v));
    }
    let step = |x: f64| ((x + 1.0) * 32_767.5 + 0.5) as u32;
    step(u).min(0xffff) | (step(v).min(0xffff) << 16)
}

/// The unit normals at the corners of each triangle: sums of those that meet there by less than the
/// angle of that cosine, by their areas.
fn corner_normals(mesh: &Mesh, cosine: f64) -> Vec<[[f64; 3]; 3]> {
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let count = mesh.triangles().len();
    let areas: Vec<[f64; 3]> = (0..count).map(|face| mesh.doubled_area(face)).collect();
    let units: Vec<[f64; 3]> = areas.iter().map(|area| unit(*area)).collect();
    // What is in one place is one corner, whatever its index.
    let mut around: HashMap<[u32; 3], Vec<usize>> = HashMap::new();
    let place = |corner: [f32; 3]| corner.map(|x| snap(x).to_bits());
    for face in 0..count {
        for corner in mesh.corners(face) {
            around.entry(place(corner)).or_default().push(face);
        }
    }
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let of = |face: usize| {
        mesh.corners(face).map(|corner| {
            let faces = &around[&place(corner)];
            if faces.len() > MOST_AROUND {
                return units[face];
            }
            let mut sum = [0.0; 3];
            for &other in faces {
                if other == face || dot(units[face], units[other]) > cosine {
                    sum = [0, 1, 2].map(|i| sum[i] + areas[other][i]);
                }
            }
            if dot(sum, sum) > 0.0 {
                unit(sum)
            } else {
                units[face]
            }
        })
    };
    (0..count).map(of).collect()
}

/// Triangles of all surfaces, those of a mesh that is seen twice counted twice.
pub(super) fn face_count(scene: &Scene) -> Result<u32, PlanError> {
    let counts = scene.surfaces.iter();
    let count = counts.map(|one| one.mesh.triangles().len()).sum();
    if count > MOST_TRIANGLES {
        let largest = (0..scene.surfaces.len())
            .max_by_key(|at| scene.surfaces[*at].mesh.triangles().len())
            .unwrap_or(0);
        return Err(too_many(count).of_key(format!("surface.{largest}.mesh")));
    }
    Ok(count as u32)
}

/// What of the surfaces holds for a whole run.
pub(super) fn fixed_of(scene: &Scene) -> Vec<(u64, u32)> {
    scene.surfaces.iter().map(key_of).collect()
}

/// What is seen of a surface is seen from a place.
pub(super) fn check_surfaces(scene: &Scene) -> Result<(), PlanError> {
    if scene.surfaces.is_empty() || scene.camera.projection == Projection::Perspective {
        return Ok(());
    }
    Err(PlanError {
        message: "this scene has a surface and an orthographic camera".into(),
        help: "a camera in perspective, or no `surface`".into(),
        key: Some("camera.projection".into()),
    })
}

/// The surfaces as a frame sees them, and what falls on them; `lights` is how many point lights
/// flames have.
pub(super) fn surfaces_of(
    scene: &Scene,
    tables: &SurfaceTables,
    (planets, grounds): (&[Planet], &[Ground]),
    lights: u32,
) -> (Vec<SurfaceFrame>, Vec<SurfaceLight>) {
    if scene.surfaces.is_empty() && scene.pillars.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let with = |v: [f32; 3]| [v[0], v[1], v[2], 0.0].map(snap);
    let mut before = 0;
    let seen = |surface: &LitSurface| {
        let (first, count) = tables.place_of(surface).unwrap_or_default();
        let rows = pose_of(surface.position, surface.rotation_degrees);
        let scaled = |[x, y, z, at]: [f32; 4]| {
            let [x, y, z] = [x, y, z].map(|part| snap(part * surface.scale));
            [x, y, z, at]
        };
        let [x, y, z] = rows.map(scaled);
        let (kind, [x_of, y_of, z_of, scale], shape) = grain_of(surface.grain.as_ref());
        let [strength, shift, noise_scale, _] = shape;
        let number = before;
        before += count;
        SurfaceFrame {
            world_from_mesh_x: x,
            world_from_mesh_y: y,
            world_from_mesh_z: z,
            color: with(surface.color),
            faces: [first, count, number, 0],
            grain: [x_of, y_of, z_of, scale * surface.scale].map(snap),
            grain_shape: [strength, shift, noise_scale * surface.scale, 0.0].map(snap),
            grain_kind: [kind, noise_key(scene.seed), 0, 0],
        }
    };
    let surfaces: Vec<SurfaceFrame> = scene.surfaces.iter().map(seen).collect();
    let light = &scene.light;
    let (lamps, lamps_from) = lamps_of(scene);
    let mut on_all = SurfaceLight {
        eye: with(scene.camera.position),
        light_from: with(normalize_exact(Vec3::from(light.direction)).to_array()),
        light_color: with(light.color),
        ambient: with(light.ambient),
        lamps_from: with(lamps_from.to_array()),
        kinds: [
            lamps.len() as u32,
            lights,
            scene.pillars.len() as u32,
            planets.len() as u32,
        ],
        counts: [surfaces.len() as u32, 0, 0, 0],
        ..SurfaceLight::default()
    };
    if let Some(planet) = planets.first() {
        let [x, y, z, _] = planet.place;
        on_all.planet = [x, y, z, planet.eye[3]];
    }
    if let Some(ground) = grounds.first() {
        on_all.plane = ground.plane;
        on_all.middle = ground.middle;
    }
    (surfaces, vec![on_all])
}
