//! The camera's part of a frame: where the world is seen, when the frame begins and when the
//! shutter closes.

use glam::Vec3;

use crate::exact::{cross3, dot3, normalize_exact, snap};
use crate::layout::{FRAME_EYE, FRAME_ORTHOGRAPHIC, Frame};
use crate::scene::{Camera, Image, Projection, Scene, ShutterWeighting};
use crate::transcendental::{cos_turns, sin_turns};

/// Rows of the transform from world to view space: right, up, forward.
fn view_rows(camera: &Camera) -> [[f32; 4]; 3] {
    let position = Vec3::from(camera.position);
    let forward = normalize_exact(Vec3::from(camera.target) - position);
    let right = normalize_exact(cross3(forward, normalize_exact(Vec3::from(camera.up))));
    let up = cross3(right, forward);
    [right, up, forward].map(|axis| [axis.x, axis.y, axis.z, -dot3(axis, position)].map(snap))
}

/// Pixels per unit of x/z, or of x if the view is orthographic.
fn focal_px(camera: &Camera, image: &Image) -> f32 {
    let half_height_px = 0.5 * image.height as f32;
    match camera.projection {
        Projection::Perspective => {
            let half_turns = camera.vertical_fov_degrees / 720.0;
            half_height_px * (cos_turns(half_turns) / sin_turns(half_turns))
        }
        Projection::Orthographic => half_height_px / (0.5 * camera.view_height),
    }
}

/// What the camera and the image decide of a frame; `closing` is the scene when the shutter closes.
pub(super) fn camera_frame(now: &Scene, closing: &Scene) -> Frame {
    let image = &now.image;
    let [x, y, z] = view_rows(&now.camera);
    let [closing_x, closing_y, closing_z] = view_rows(&closing.camera);
    let from = normalize_exact(Vec3::from(now.light.direction));
    let along = |row: [f32; 4]| dot3(Vec3::from_slice(&row), from);
    let color = |[red, green, blue]: [f32; 3]| [red, green, blue, 0.0].map(snap);
    let [red, green, blue] = image.background;
    let orthographic = match now.camera.projection {
        Projection::Perspective => 0,
        Projection::Orthographic => FRAME_ORTHOGRAPHIC,
    };
    let eye = match image.shutter_weighting {
        ShutterWeighting::Camera => 0,
        ShutterWeighting::Eye => FRAME_EYE,
    };
    Frame {
        view_from_world_x: x,
        view_from_world_y: y,
        view_from_world_z: z,
        closing_view_from_world_x: closing_x,
        closing_view_from_world_y: closing_y,
        closing_view_from_world_z: closing_z,
        background: [red, green, blue, 0.0].map(snap),
        light_from: [along(x), along(y), -along(z), 0.0].map(snap),
        light_color: color(now.light.color),
        ambient_color: color(now.light.ambient),
        focal_px: focal_px(&now.camera, image),
        closing_focal_px: focal_px(&closing.camera, image),
        center_x_px: 0.5 * image.width as f32,
        center_y_px: 0.5 * image.height as f32,
        near: now.camera.near,
        shutter: snap(image.shutter),
        exposure: snap(image.exposure),
        flags: orthographic | eye,
        ..Frame::default()
    }
}

/// The planes between the layers of the picture: unit normal, distance along it.
pub(super) fn layer_planes(scene: &Scene) -> Vec<[f32; 4]> {
    let plane = |layer: &crate::scene::Layer| {
        let normal = normalize_exact(Vec3::from(layer.normal));
        let offset = dot3(normal, Vec3::from(layer.point));
        [normal.x, normal.y, normal.z, offset].map(snap)
    };
    scene.layers.iter().map(plane).collect()
}
