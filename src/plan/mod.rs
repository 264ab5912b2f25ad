//! Scene → [`Plan`]: named buffers, stages in frame order, and the inputs of every frame.
//!
//! Pure and static: no device, no clock, no files. Matrices, angles and everything else that needs
//! more than a multiplication is computed here, once, with [`crate::exact`] math, so that every
//! backend starts from the same bits.

mod area;
mod bounds;
mod buffers;
mod inputs;
mod stages;
mod variant;

pub use area::screen_area_px;
pub use buffers::{BUFFERS, Buffer, BufferRole, Count, buffer};
pub use inputs::FrameInputs;
pub use stages::{STAGES, Stage, StageInfo};

use crate::layout::{PARTICLE_RECTANGLE, PARTICLE_STREAK, SystemRow};
use crate::scene::Scene;
use variant::Variant;

/// Why a scene cannot become a plan: it is the scene's fault, and the message says what to change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanError {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
}

impl std::fmt::Display for PlanError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "error: {}\n  = help: {}", self.message, self.help)
    }
}

impl std::error::Error for PlanError {}

/// A parameter change while a scene runs: from `frame` on, the scene is `scene`.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// First frame that it holds for.
    pub frame: u32,
    /// The whole scene as it is from then on: same systems, by number and name.
    pub scene: Scene,
}

/// Which features some system has at some time; kernels leave out what none has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uses {
    /// Extinction by intensity.
    pub thresholds: bool,
    /// Particles drawn as streaks.
    pub streaks: bool,
    /// Particles drawn as rectangles.
    pub rectangles: bool,
}

impl Uses {
    fn of(row: &SystemRow) -> Self {
        Self {
            thresholds: row.size_and_threshold[3] >= 0.0,
            streaks: row.kinds[1] == PARTICLE_STREAK,
            rectangles: row.kinds[1] == PARTICLE_RECTANGLE,
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            thresholds: self.thresholds | other.thresholds,
            streaks: self.streaks | other.streaks,
            rectangles: self.rectangles | other.rectangles,
        }
    }

    /// Whether inputs of the caller's making use no more than this.
    pub fn cover(self, inputs: &FrameInputs) -> bool {
        inputs
            .rows
            .iter()
            .all(|row| self.and(Self::of(row)) == self)
    }
}

/// What a backend needs to know of a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Most particles alive at once.
    pub capacity: u32,
    /// Whether births may be dropped for want of room.
    pub may_drop: bool,
    /// No particle lives longer than this many frames.
    pub lifetime_bound: u32,
    /// Parameter rows kept for each system, a power of two; 1 if no parameter ever changes.
    pub row_count: u32,
    /// Number of systems.
    pub system_count: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// What its systems make use of, at any time.
    pub uses: Uses,
    variants: Vec<Variant>,
}

impl Plan {
    /// Plans `scene` for frames below `frame_end`.
    ///
    /// # Errors
    /// More particles than 10^9, or a bound too costly to find: the scene then has to name its capacity.
    pub fn new(scene: &Scene, frame_end: u32) -> Result<Self, PlanError> {
        Self::with_turns(scene, &[], frame_end)
    }

    /// Plans `scene` and its recorded `turns` for frames below `frame_end`.
    ///
    /// # Errors
    /// As [`Plan::new`]; also when a turn adds, removes or renames systems, or changes the image,
    /// the seed or the capacity, which hold for a whole run.
    pub fn with_turns(scene: &Scene, turns: &[Turn], frame_end: u32) -> Result<Self, PlanError> {
        let mut variants = vec![Variant::new(0, scene)];
        for turn in turns {
            check_turn(scene, turn)?;
            variants.push(Variant::new(turn.frame, &turn.scene));
        }
        variants.sort_by_key(|variant| variant.first_frame);
        let scenes: Vec<&Scene> = std::iter::once(scene)
            .chain(turns.iter().map(|turn| &turn.scene))
            .collect();
        let lifetime_bound = bounds::lifetime_bound(&scenes);
        let bound = bounds::capacity(&variants, lifetime_bound, frame_end.max(scene.frames));
        let (capacity, may_drop) = match scene.capacity {
            Some(capacity) => (capacity, !bound.is_ok_and(|most| most <= capacity)),
            None => (bound?, false),
        };
        let row_count = if turns.is_empty() {
            1
        } else {
            (lifetime_bound + 1).next_power_of_two()
        };
        let uses = variants
            .iter()
            .flat_map(|variant| &variant.systems)
            .map(|system| Uses::of(&system.row))
            .fold(Uses::default(), Uses::and);
        Ok(Self {
            uses,
            capacity,
            may_drop,
            lifetime_bound,
            row_count,
            system_count: scene.systems.len() as u32,
            width: scene.image.width,
            height: scene.image.height,
            variants,
        })
    }

    /// Everything that reaches frame `frame` from outside; pure, so any frame can be asked for.
    pub fn inputs(&self, frame: u32) -> FrameInputs {
        let variant = self
            .variants
            .iter()
            .rev()
            .find(|variant| variant.first_frame <= frame)
            .unwrap_or(&self.variants[0]);
        inputs::frame_inputs(self, variant, frame)
    }

    /// The earliest frame that a run has to step to have every particle of `frame` right, from an
    /// empty start, its deaths included: particles born before it are dead by then
    /// (Reeves 1983, section 3). Where births may be dropped, who is alive depends on all that
    /// came before, and it is frame 0.
    pub fn restart_frame(&self, frame: u32) -> u32 {
        if self.may_drop {
            return 0;
        }
        frame.saturating_sub(self.lifetime_bound)
    }
}

/// Whether the turn leaves alone what holds for a whole run of `scene`.
pub(crate) fn check_turn(scene: &Scene, turn: &Turn) -> Result<(), PlanError> {
    let names = |scene: &Scene| -> Vec<String> {
        scene
            .systems
            .iter()
            .map(|system| system.name.clone())
            .collect()
    };
    let fixed = |scene: &Scene| {
        (
            scene.image.width,
            scene.image.height,
            scene.seed,
            scene.capacity,
        )
    };
    if names(scene) != names(&turn.scene) || fixed(scene) != fixed(&turn.scene) {
        return Err(PlanError {
            message: format!(
                "the change at frame {} alters what holds for a whole run",
                turn.frame
            ),
            help: "the list of systems and their names, the image size, the seed and the capacity \
                   stay as the scene has them"
                .into(),
        });
    }
    Ok(())
}
