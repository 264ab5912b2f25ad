//! Looking around: a camera that circles what it looks at, comes nearer and moves aside. The run
//! does not change by it, even where births go by screen area.

use glam::{Quat, Vec3};

use crate::scene::Camera;

/// Nearer than this part of the first distance it does not come.
const NEAREST: f32 = 0.01;

/// How the camera differs from the scene's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Turns around the scene's up, radians.
    pub yaw: f32,
    /// Turns above the horizon, radians.
    pub pitch: f32,
    /// Factor of the distance.
    pub distance: f32,
    /// Moves aside and up, in distances.
    pub pan: [f32; 2],
}

impl Orbit {
    /// The scene's own view.
    pub const STILL: Self = Self {
        yaw: 0.0,
        pitch: 0.0,
        distance: 1.0,
        pan: [0.0; 2],
    };

    /// Drags by a part of the picture's height: around and over.
    pub fn turn(&mut self, across: f32, up: f32) {
        self.yaw -= across * std::f32::consts::PI;
        self.pitch = (self.pitch + up * std::f32::consts::PI).clamp(-1.5, 1.5);
    }

    /// Drags aside by a part of the picture's height.
    pub fn shift(&mut self, across: f32, up: f32) {
        self.pan[0] -= across;
        self.pan[1] -= up;
    }

    /// Comes nearer by so many notches of a wheel, or goes away.
    pub fn zoom(&mut self, notches: f32) {
        self.distance = (self.distance * (-0.1 * notches).exp()).clamp(NEAREST, 100.0);
    }

    /// The camera that is looked through; `None` for the scene's own.
    pub fn camera(&self, own: &Camera) -> Option<Camera> {
        if *self == Self::STILL {
            return None;
        }
        let target = Vec3::from(own.target);
        let up = Vec3::from(own.up).normalize_or(Vec3::Y);
        let away = Vec3::from(own.position) - target;
        let right = up.cross(away).normalize_or(Vec3::X);
        // Over the top it would stand on its head.
        let now = away.angle_between(up);
        let pitch = self.pitch.clamp(now - 3.1, now - 0.04);
        let turned = Quat::from_axis_angle(up, self.yaw) * Quat::from_axis_angle(right, -pitch);
        let away = turned * away * self.distance;
        let aside = up.cross(away).normalize_or(Vec3::X);
        let over = away.cross(aside).normalize_or(up);
        let moved = (aside * self.pan[0] + over * self.pan[1]) * away.length();
        Some(Camera {
            position: (target + moved + away).into(),
            target: (target + moved).into(),
            view_height: own.view_height * self.distance,
            ..*own
        })
    }
}
