//! The box of cells in which clouds throw shadows on themselves (Reeves 1983, 5).

use glam::Vec3;

use crate::exact::{cross3, dot3, normalize_exact, reciprocal, snap};
use crate::layout::ShadeBox;
use crate::scene::{Blend, Scene, Shading, System};

fn is_cloud(system: &System) -> bool {
    system.blend == Blend::Over && system.shading == Shading::LitCloud
}

/// Cells each way, 0 if nothing throws shadows.
pub(super) fn cells_of(scene: &Scene) -> u32 {
    match scene.light.shadow_radius {
        Some(_) if scene.systems.iter().any(is_cloud) => scene.light.shadow_cells,
        _ => 0,
    }
}

/// The box, if anything throws shadows in it.
pub(super) fn box_of(scene: &Scene) -> Vec<ShadeBox> {
    let cells = cells_of(scene);
    let Some(radius) = scene.light.shadow_radius.filter(|_| cells > 0) else {
        return Vec::new();
    };
    let from = normalize_exact(Vec3::from(scene.light.direction));
    let upright = from.y.abs() > 0.9;
    let across = normalize_exact(cross3(if upright { Vec3::X } else { Vec3::Y }, from));
    let aside = cross3(from, across);
    let center = Vec3::from(scene.light.shadow_center);
    let count = cells as f32;
    let scale = 0.5 * count * reciprocal(radius);
    let row = |way: Vec3| {
        let [x, y, z] = (way * scale).to_array();
        [x, y, z, 0.5 * count - dot3(way, center) * scale].map(snap)
    };
    vec![ShadeBox {
        across: row(across),
        aside: row(aside),
        along: row(-from),
        look: [scale * scale, 0.0, 0.0, 0.0].map(snap),
        kinds: [cells, 0, 0, 0],
    }]
}
