//! Inputs that no scene would give: extreme, random, and legal for the backends all the same.

use motes::exact::snap;
use motes::layout::{Bound, SHAPE_CURVE, SHAPE_MESH, SystemFrame, SystemRow, Wind};
use motes::plan::{FrameInputs, Plan, Turn};

use super::{hash, scene_of};

/// Random numbers in the order that they are asked for.
struct Dice(u32);

impl Dice {
    fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        hash(self.0)
    }

    fn below(&mut self, end: u32) -> u32 {
        ((u64::from(self.word()) * u64::from(end)) >> 32) as u32
    }

    /// Uniform in -1 .. 1.
    fn signed(&mut self) -> f32 {
        (self.word() >> 8) as f32 / 8_388_608.0 - 1.0
    }

    /// Most often within `usual`; one in four has any magnitude from 2^-45 to `most`, and one in
    /// sixteen is zero.
    fn extreme(&mut self, usual: f32, most: f32) -> f32 {
        let x = self.signed();
        let value = match self.below(16) {
            0 => 0.0,
            1..4 => {
                let span = most.log2() + 45.0;
                let exponent = self.below(span as u32 + 1) as i32 - 45;
                x.signum() * (1.0 + x.abs()) * 0.5 * 2f32.powi(exponent)
            }
            _ => x * usual,
        };
        snap(value)
    }

    /// As [`Dice::extreme`], never negative.
    fn magnitude(&mut self, usual: f32, most: f32) -> f32 {
        self.extreme(usual, most).abs()
    }
}

/// A multiple of four, so that buffers of a word for each have no room to spare.
const SYSTEMS: u32 = 8;

/// A plan of eight systems with room for 2,600 particles and 96 × 54 pixels, and `count` frames of
/// hand-made inputs that begin at frame `first`: transforms, speeds, sizes and accelerations from
/// 2^-45 to 10^9, births from none to more than fit, rows that change every frame.
pub(crate) fn adversarial(seed: u32, first: u32, count: u32) -> (Plan, Vec<FrameInputs>) {
    let systems: String = (0..SYSTEMS)
        .map(|slot| {
            // Kernels leave out what no system of the plan uses: this one uses everything.
            let shape = ["streak", "rectangle", "sphere"][slot as usize % 3];
            format!(
                "[[system]]\nname = \"s{slot}\"\ninitial_mean_parts = 1\nspeed = 1\n\
                 generation_shape = {{ kind = \"sphere\", radius = 1 }}\nlifetime = 7\n\
                 position = [0, 1, 0]\ncolor = {{ mean = [1, 1, 1], rate_var = [1, 1, 1] }}\nsize = 1\n\
                 particle_shape = \"{shape}\"\nintensity_threshold = 0.1\ndrag = 0.5\n\
                 integration = \"parabola\"\nlight_distance = 1\nblend = \"over\"\n[[system.extinction]]\n\
                 kind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nkills = \"inside\"\n"
            )
        })
        .collect();
    let systems = systems.replacen(
        "kind = \"sphere\", radius",
        "kind = \"attractor\", attractor = \"lorenz\", radius",
        1,
    );
    let systems = systems.replacen(
        "kind = \"sphere\", radius",
        "kind = \"mesh\", mesh = \"cylinder\", scale",
        1,
    );
    let scene = scene_of(&format!(
        "capacity = 2600\n[image]\nwidth = 96\nheight = 54\n[camera]\nposition = [0, 0, 5]\n\
         target = [0, 0, 0]\n[[layer]]\nname = \"a\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n\
         [[wind]]\nkind = \"noise\"\nstrength = 1\nabsolute = true\n\
         [[wind]]\nkind = \"vortex\"\nspeed = 1\nradius = 1\nposition = [0, 0, 0]\naxis = [0, 0, 1]\n\
         [[wind]]\nkind = \"curl\"\nstrength = 1\noctaves = 2\n{systems}"
    ));
    // A turn, so that rows are kept for eight frames.
    let turns = [Turn {
        frame: 1,
        scene: scene.clone(),
    }];
    let plan = Plan::with_turns(&scene, &turns, 8).expect("the scene can be planned");
    let mut dice = Dice(seed.wrapping_mul(0x0100_0000));
    let frames = (0..count)
        .map(|at| {
            let mut inputs = plan.inputs(at);
            inputs.frame.frame = first.wrapping_add(at);
            inputs.frame.shutter = dice.magnitude(1.0, 4.0);
            inputs.frame.near = snap(dice.magnitude(1.0, 16.0).max(1e-6));
            inputs.frame.focal_px *= 1.0 + dice.signed() * 0.9;
            inputs.frame.background = [0; 4].map(|_: u32| dice.magnitude(0.2, 1.0));
            inputs.systems = (0..SYSTEMS)
                .map(|slot| system_frame(&mut dice, seed, slot))
                .collect();
            inputs.rows = (0..SYSTEMS).map(|_| system_row(&mut dice)).collect();
            let view = |dice: &mut Dice| [0; 4].map(|_: u32| dice.extreme(1.0, 1e4));
            inputs.frame.closing_view_from_world_x = view(&mut dice);
            inputs.frame.closing_view_from_world_y = view(&mut dice);
            inputs.frame.closing_focal_px *= 1.0 + dice.signed() * 0.9;
            inputs.frame.exposure = dice.magnitude(2.0, 1e3);
            inputs.frame.light_from = view(&mut dice);
            inputs.frame.light_color = [0; 4].map(|_: u32| dice.magnitude(1.0, 1e3));
            inputs.frame.ambient_color = [0; 4].map(|_: u32| dice.magnitude(1.0, 1e3));
            inputs.frame.flags = dice.below(4);
            inputs.bounds = (0..2 * SYSTEMS).map(|_| bound(&mut dice)).collect();
            let count = dice.below(6);
            inputs.winds = (0..count).map(|_| wind(&mut dice)).collect();
            inputs.frame.wind_count = count;
            inputs.layer_planes = (0..3).map(|_| view(&mut dice)).collect();
            inputs.frame.layer_plane_count = 3;
            // Most frames are drawn whole.
            inputs.frame.layer = dice.below(12).saturating_sub(7);
            inputs
        })
        .collect();
    (plan, frames)
}

fn system_frame(dice: &mut Dice, seed: u32, slot: u32) -> SystemFrame {
    let mut row = |axis: usize| {
        let mut row = [0; 4].map(|_: u32| dice.extreme(0.5, 1e4));
        row[axis] = snap(row[axis] + 1.0);
        row
    };
    let mut rows = || [row(0), row(1), row(2)];
    let [x, y, z] = rows();
    let closing = rows();
    let earlier = rows();
    let birth = rows();
    let mut acceleration = [0; 4].map(|_: u32| dice.extreme(0.1, 1e9));
    acceleration[3] = dice.extreme(0.5, 1.0).clamp(0.0, 1.0);
    SystemFrame {
        world_from_system_x: x,
        world_from_system_y: y,
        world_from_system_z: z,
        closing_world_from_system_x: closing[0],
        closing_world_from_system_y: closing[1],
        closing_world_from_system_z: closing[2],
        earlier_system_from_birth_x: earlier[0],
        earlier_system_from_birth_y: earlier[1],
        earlier_system_from_birth_z: earlier[2],
        system_from_birth_x: birth[0],
        system_from_birth_y: birth[1],
        system_from_birth_z: birth[2],
        acceleration,
        mean_parts: match dice.below(24) {
            0 => 3e7,
            1 => dice.extreme(1.0, 1e30),
            2 => 0.0,
            _ => dice.extreme(90.0, 500.0),
        },
        var_parts: dice.magnitude(40.0, 400.0),
        key: hash(seed ^ slot << 20),
        // One in eight counts for each pixel of its area.
        flags: [0, 1, 1, 4, 5, 5, 4, 2 + 1][dice.below(8) as usize],
        bounding_sphere: [
            dice.extreme(1.0, 1e4),
            dice.extreme(1.0, 1e4),
            dice.extreme(1.0, 1e4),
            dice.magnitude(0.1, 1e4),
        ],
        first_bound: 2 * slot,
        bound_count: dice.below(3),
        burst_parts: dice.extreme(2.0, 50.0),
        burst_var: dice.magnitude(2.0, 10.0),
    }
}

fn bound(dice: &mut Dice) -> Bound {
    let place = [0; 4].map(|_: u32| dice.extreme(1.0, 1e6));
    let size = [0; 4].map(|_: u32| dice.magnitude(8.0, 1e6));
    Bound {
        // Mostly such that most particles are allowed.
        place: [place[0], place[1], place[2], place[3].abs() * 4.0].map(snap),
        extent: [0, 1, 2, 3].map(|i| snap(place[i] + size[i])),
        kinds: [dice.below(4), dice.below(2), 0, 0],
    }
}

fn wind(dice: &mut Dice) -> Wind {
    let kind = dice.below(7);
    let octaves = if kind < 4 { 0 } else { 1 + dice.below(3) };
    let mut four = |usual: f32, most: f32| [0; 4].map(|_: u32| dice.extreme(usual, most));
    let (place, aim, scale, offset) = (
        four(1.0, 1e6),
        four(1.0, 1e4),
        four(1.0, 1e4),
        four(9.0, 2e4),
    );
    Wind {
        kinds: [kind, octaves, dice.word(), dice.below(2)],
        place: [place[0], place[1], place[2], place[3].abs()],
        aim,
        scale,
        offset,
    }
}

fn system_row(dice: &mut Dice) -> SystemRow {
    // 9 is none of the generation shapes, 4 none of the others; of strokes, there are only those that a plan
    // has.
    let shape = [0, 1, 2, 4][dice.below(4) as usize];
    let kinds = [dice.below(10), shape, dice.below(3), dice.word()];
    let mut shape = [
        dice.magnitude(2.0, 1e6),
        dice.magnitude(2.0, 1e6),
        dice.magnitude(2.0, 1e6),
        dice.magnitude(1.0, 1e6),
    ];
    if kinds[0] == SHAPE_CURVE {
        // Points that are there: curves are the plan's, not the frame's.
        shape[1] = dice.below(8000) as f32;
        shape[2] = 4096.0;
    }
    if kinds[0] == SHAPE_MESH {
        // The same holds of faces, of which a cylinder has 384.
        shape[1] = dice.below(101) as f32;
        shape[2] = 283.0;
    }
    SystemRow {
        shape,
        ejection_and_light: [
            dice.signed(),
            dice.magnitude(0.5, 0.5),
            dice.magnitude(2.0, 1e4),
            dice.magnitude(0.01, 1e3),
        ],
        speed_and_lifetime: [
            dice.extreme(0.3, 1e9),
            dice.magnitude(0.3, 1e4),
            dice.extreme(6.0, 1e10),
            dice.magnitude(4.0, 20.0),
        ],
        size_and_threshold: [
            dice.magnitude(0.1, 1e4),
            dice.magnitude(0.1, 1e4),
            dice.extreme(0.01, 1e4),
            dice.extreme(0.05, 1e3),
        ],
        color_mean: [
            dice.magnitude(0.5, 1e3),
            dice.magnitude(0.5, 1e3),
            dice.magnitude(0.5, 1e3),
            dice.magnitude(0.5, 1.0),
        ],
        color_var: [0; 4].map(|_: u32| dice.magnitude(0.5, 1e3)),
        color_rate: [0; 4].map(|_: u32| dice.extreme(0.1, 1e3)),
        color_rate_var: [0; 4].map(|_: u32| dice.magnitude(0.1, 1e3)),
        kinds,
    }
}
