//! Less to draw, where drawing is slow: fewer pixels, and lines for flames (Perry 1994, 1.2 and 4.7:
//! detail is switched off while somebody looks for parameters). What is drawn changes no state.

use crate::scene::{BirthUnit, FlameForm, Scene};

/// How much of a scene's picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Pixels are so many times as wide and as high as the scene's: 1, 2 or 4.
    pub coarseness: u32,
    /// Whether flames are lines.
    pub flame_lines: bool,
}

impl Detail {
    /// From all that there is to the least.
    pub const LEVELS: [Self; 4] = [
        Self::of(1, false),
        Self::of(2, false),
        Self::of(2, true),
        Self::of(4, true),
    ];

    const fn of(coarseness: u32, flame_lines: bool) -> Self {
        Self {
            coarseness,
            flame_lines,
        }
    }

    /// What it is called.
    pub fn name(&self) -> &'static str {
        match (self.coarseness, self.flame_lines) {
            (1, false) => "full",
            (2, false) => "half the width and height",
            (1 | 2, _) => "half the width and height, flames as lines",
            _ => "a quarter of the width and height, flames as lines",
        }
    }

    /// As `--set` has it, for that scene.
    pub(super) fn sets(self, scene: &Scene) -> Vec<String> {
        let mut sets = Vec::new();
        if self.coarseness > 1 {
            let size = [("width", scene.image.width), ("height", scene.image.height)];
            sets.extend(
                size.map(|(key, px)| format!("image.{key}={}", px.div_ceil(self.coarseness))),
            );
        }
        if self.flame_lines {
            let fires = scene.fires.iter();
            let with = fires.filter(|fire| fire.form == FlameForm::Particles);
            sets.extend(with.map(|fire| format!("fire.{}.form=line", fire.name)));
        }
        sets
    }
}

/// Whether what happens in the scene hangs on how many pixels its picture has.
pub(super) fn hangs_on_pixels(scene: &Scene) -> bool {
    let by_area = |births: &crate::scene::Births| births.per == BirthUnit::ScreenArea;
    scene.systems.iter().any(|system| by_area(&system.births))
}
