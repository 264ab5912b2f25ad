//! What flames throw on surfaces (Perry 1994, 3.2.4).

use glam::{Vec3, Vec4};

use super::meshes::MeshTables;
use super::spread::SpreadTables;
use crate::exact::{dot3, length3, reciprocal, snap};
use crate::layout::{AgeLook, FLAME_LIGHTS, FLAME_STEPS, FireFrame};
use crate::scene::{Fire, LightFrom, Roots, Scene};

/// Area of a regular polygon of 20 corners on the unit circle.
const FAN_AREA: f32 = 3.090_17;
/// 1 / pi: what falls on a white surface is sent back in all directions.
const PER_HALF_SPACE: f32 = std::f32::consts::FRAC_1_PI;
/// A light's extent as a share of its flames' height: nearer than that, light hardly grows.
const EXTENT: f32 = 0.2;
/// How far wind may carry a flame, in heights.
const CARRIED: f32 = 8.0;

/// [`FireFrame::light`](crate::layout::FireFrame::light) and
/// [`FireFrame::light_scale`](crate::layout::FireFrame::light_scale).
pub(super) struct Light {
    pub(super) color: [f32; 4],
    pub(super) scale: [f32; 4],
}

/// The first and the last age that the place of a light is made of.
fn ages(from: LightFrom) -> [u32; 2] {
    match from {
        LightFrom::Mean => [0, FLAME_STEPS - 1],
        LightFrom::Middle => [FLAME_STEPS / 2; 2],
        LightFrom::Tip => [FLAME_STEPS - 1; 2],
    }
}

/// [`FireFrame::lights`](crate::layout::FireFrame::lights): no more than the fire has flames, unless it
/// spreads.
pub(super) fn ages_of(fire: &Fire, first: u32) -> [u32; 4] {
    let [youngest, oldest] = ages(fire.lights.from);
    let most = if fire.spread.is_some() {
        FLAME_LIGHTS
    } else {
        fire.count()
    };
    let count = fire.lights.count.min(most);
    [first, count, youngest, oldest]
}

/// The light of a fire whose particles look like that.
pub(super) fn light_of(fire: &Fire, looks: &[AgeLook], meshes: &MeshTables) -> Light {
    let half = |width: f32| 0.5 * width;
    let widest = fire.width.mean + fire.width.var;
    let own = fire.listed.iter().map(|flame| {
        let half_width = half(flame.width.unwrap_or(widest));
        flame.brightness * half_width * half_width
    });
    let has_widest = fire.roots.count() > 0 || fire.spread.is_some();
    let of_roots = half(widest) * half(widest) * f32::from(u8::from(has_widest));
    let most = fire.brightness * own.fold(of_roots, f32::max);
    let sum: Vec3 = looks.iter().map(|look| mean_light(fire, look)).sum();
    let light = sum * (FAN_AREA * PER_HALF_SPACE * fire.lights.gain * most);
    let highest = fire.height.mean + fire.height.var;
    let heights = fire.listed.iter().filter_map(|flame| flame.height);
    let reach = extent_of(fire, meshes) + CARRIED * heights.fold(highest, f32::max);
    let extent = part_of(fire).max(EXTENT * fire.height.mean);
    let [youngest, oldest] = ages(fire.lights.from);
    let ages = (oldest - youngest + 1) as f32;
    Light {
        color: [light.x, light.y, light.z, extent * extent].map(snap),
        scale: [
            reciprocal(most),
            reach,
            0.5 * reciprocal(reach),
            reciprocal(ages),
        ]
        .map(snap),
    }
}

/// The light of a particle, a mean over its polygon at scale 1.
fn mean_light(fire: &Fire, look: &AgeLook) -> Vec3 {
    let [center, rim] = [look.center, look.rim].map(Vec4::from);
    let inward = (center - rim).truncate();
    let (outside, more) = (rim.w, center.w - rim.w);
    // Means of s, of its square, and of the inner layer's share alone and times s, where s falls
    // linearly from 1 at the centre to 0 at the rim.
    let of_one = rim.truncate() * (outside + more / 3.0) + inward * (outside / 3.0 + more / 6.0);
    let radius = fire.inner_radius;
    let (alone, with_share) = (
        radius * radius / 3.0,
        radius * radius / 3.0 - radius * radius * radius / 6.0,
    );
    let of_inner = (rim.truncate() * alone + inward * with_share) * (center.w * fire.inner_alpha);
    (of_one + of_inner) * (look.scale[0] * look.scale[1])
}

/// How far from a point light of a fire that spreads flames are that it stands for: the radius of a
/// disc as large as its part of what burns. Nearer than that there is no point that light comes from, and
/// none is to be seen on what is close.
fn part_of(fire: &Fire) -> f32 {
    let Some(spread) = &fire.spread else {
        return 0.0;
    };
    let lights = f64::from(fire.lights.count.clamp(1, FLAME_LIGHTS));
    (spread.surface.area() / (std::f64::consts::PI * lights)).sqrt() as f32
}

/// How far two roots of the fire may be apart.
fn extent_of(fire: &Fire, meshes: &MeshTables) -> f32 {
    let of_roots = match &fire.roots {
        Roots::Listed => 0.0,
        Roots::Line { length, .. } => 0.5 * length,
        Roots::Circle { radius, .. } | Roots::Disc { radius, .. } => *radius,
        Roots::Mesh { mesh, scale, .. } => meshes.reach_of(mesh) * scale,
    };
    let listed = fire.listed.iter();
    let of_listed = listed.map(|flame| length3(Vec3::from(flame.position)));
    let spread = fire.spread.iter();
    let of_spread = spread.map(|spread| spread.surface.extent() as f32);
    2.0 * of_listed.chain(of_spread).fold(of_roots, f32::max)
}

/// Places that the point lights of fires that spread are counted from: of each as many as it has, far
/// from each other on what burns.
pub(super) fn light_roots(
    now: &Scene,
    fires: &[FireFrame],
    tables: &SpreadTables,
) -> Vec<[f32; 4]> {
    let mut roots = Vec::new();
    let mut of_spreads = tables.light_places();
    for (fire, frame) in now.fires.iter().zip(fires) {
        let places = fire.spread.as_ref().and_then(|_| of_spreads.next());
        let rows = [
            frame.world_from_fire_x,
            frame.world_from_fire_y,
            frame.world_from_fire_z,
        ];
        let all = places.into_iter().flatten().copied();
        // A mesh may have fewer places than the fire lights.
        let all = all.chain(std::iter::repeat([0.0; 3]));
        roots.extend(all.take(frame.lights[1] as usize).map(|place| {
            let place = Vec3::from(place);
            let [x, y, z] = rows.map(|row| snap(dot3(Vec3::from_slice(&row), place) + row[3]));
            [x, y, z, 0.0]
        }));
    }
    roots
}
