//! Less to draw, where drawing is slow: fewer pixels, fewer pictures, and lines for flames (Perry 1994,
//! 1.2 and 4.7: detail is switched off while somebody looks for parameters). What is drawn changes no
//! state.

use crate::scene::{BirthUnit, FlameForm, Scene};

/// How much of a run is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Pixels are so many times as wide and as high as the scene's: 1, 2 or 4.
    pub coarseness: u32,
    /// Frames that are stepped for one that is drawn, from 1.
    pub frames_a_picture: u32,
    /// Whether flames are lines.
    pub flame_lines: bool,
}

impl Detail {
    /// All that there is.
    pub const FULL: Self = Self::of(1, 1);

    /// From all that there is to the least, in the order in which it is given up. Lines are not among
    /// them, for it is not by their time alone that one wants them.
    pub const LEVELS: [Self; 5] = [
        Self::FULL,
        Self::of(2, 1),
        Self::of(4, 1),
        Self::of(4, 2),
        Self::of(4, 4),
    ];

    const fn of(coarseness: u32, frames_a_picture: u32) -> Self {
        Self {
            coarseness,
            frames_a_picture,
            flame_lines: false,
        }
    }

    /// The same with flames as lines, or not.
    #[must_use]
    pub const fn with_lines(self, flame_lines: bool) -> Self {
        Self {
            flame_lines,
            ..self
        }
    }

    /// The level that it is of.
    pub(super) fn level(self) -> usize {
        let plain = self.with_lines(false);
        let mut levels = Self::LEVELS.iter();
        levels.position(|level| *level == plain).unwrap_or(0)
    }

    /// That level, with flames as they are.
    pub(super) fn at_level(self, level: usize) -> Self {
        Self::LEVELS[level].with_lines(self.flame_lines)
    }

    /// What its level is called.
    pub fn name(self) -> &'static str {
        match (self.coarseness, self.frames_a_picture) {
            (1, _) => "full",
            (2, _) => "half the width and height",
            (_, 1) => "a quarter of the width and height",
            (_, 2) => "a quarter, every second frame",
            _ => "a quarter, every fourth frame",
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
