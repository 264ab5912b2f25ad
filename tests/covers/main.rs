//! What covers: coverage, order, and the same bits however it is cut into tiles and rounds.
#[path = "../common/mod.rs"]
mod common;

mod coverage;
mod order;
mod sorted;
mod twins;

use common::hash;
use glam::{Vec2, Vec3, Vec4};
use motes::cpu::draw::cover::{Pixels, cover};
use motes::cpu::shape::{Look, disc_of, segment_of, square_of, stroke_of, triangle_of};
use motes::layout::{COVER_NONE, Cover, Frame};
use motes::plan::{FrameInputs, Plan};

/// A plan with room for so many records of every kind, and its first frame.
fn plan_for(width: u32, height: u32, records: u32) -> (Plan, FrameInputs) {
    let scene = common::scene_of(&format!(
        "capacity = {records}\nimage = {{ width = {width}, height = {height} }}
        camera = {{ position = [0, 0, 5], target = [0, 0, 0] }}
        [[system]]\nname = \"one\"\nblend = \"over\"\ninitial_mean_parts = 1
        generation_shape = {{ kind = \"sphere\", radius = 1 }}
        speed = 0\nlifetime = 9\ncolor = [1, 1, 1]\nsize = 1"
    ));
    let mut plan = Plan::new(&scene, 1).expect("the scene can be planned");
    plan.uses.triangles = true;
    plan.uses.streaks = true;
    plan.uses.rectangles = true;
    plan.uses.strokes = true;
    let inputs = plan.inputs(0);
    (plan, inputs)
}

/// Red, green, blue and what shows through, of each pixel.
fn drawn(covers: &[Cover], frame: &Frame) -> Vec<[f32; 4]> {
    let pixels = (frame.width * frame.height) as usize;
    let (mut rg, mut bt) = (vec![[0; 2]; pixels], vec![[0; 2]; pixels]);
    let pixels = Pixels {
        rg: &mut rg,
        bt: &mut bt,
        front: &mut [],
    };
    cover(covers, frame, &[], pixels);
    let pixel = |(rg, bt): (&[u32; 2], &[u32; 2])| [rg[0], rg[1], bt[0], bt[1]].map(f32::from_bits);
    rg.iter().zip(&bt).map(pixel).collect()
}

/// A frame of that size and nothing else.
fn frame_of(width: u32, height: u32) -> Frame {
    Frame {
        width,
        height,
        light_from: [0.0, 0.0, 1.0, 0.0],
        ..Frame::default()
    }
}

/// What has that alpha and depth, white and flat.
fn white(alpha: f32, depth: f32) -> Look {
    Look {
        depth,
        color: Vec4::new(1.0, 1.0, 1.0, alpha),
        lit: Vec3::ZERO,
    }
}

/// Random numbers from 0 to 1, by another generator than the one under test.
struct Random(u32);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 += 1;
        hash(self.0) as f32 / u32::MAX as f32
    }

    fn within(&mut self, low: f32, high: f32) -> f32 {
        low + self.unit() * (high - low)
    }
}

/// Records of every kind, some of nothing, many at the same depth: in a picture of that size and
/// around it.
fn anything(count: usize, width: u32, height: u32, seed: u32) -> Vec<Cover> {
    let mut random = Random(seed.wrapping_mul(0x0100_0000));
    let reach = width.max(height) as f32;
    (0..count)
        .map(|_| {
            let look = Look {
                depth: (random.within(1.0, 40.0) * 4.0).floor() / 4.0,
                color: Vec4::new(
                    random.within(0.0, 2.0),
                    random.unit(),
                    random.unit(),
                    random.unit(),
                ),
                lit: Vec3::splat(random.unit()),
            };
            let mut place = || {
                let x = random.within(-0.2 * reach, 1.2 * reach);
                Vec2::new(x, random.within(-0.2 * reach, 1.2 * reach))
            };
            let (a, b, c) = (place(), place(), place());
            let size = random.unit().powi(3) * 0.4 * reach;
            match (random.unit() * 8.0) as u32 {
                0 => disc_of(a.x, a.y, size, 0.0, &look),
                1 => disc_of(a.x, a.y, size, random.unit(), &look),
                2 => square_of(a.x, a.y, size, &look),
                3 => segment_of(a, a + (b - a) * 0.3, 0.1 * size, &look),
                4 => triangle_of(a, a + (b - a) * 0.2, a + (c - a) * 0.2, &look),
                5 => triangle_of(a, b, c, &look),
                6 => {
                    let cuts = [random.within(-2.0, 2.0), random.within(-2.0, 5.0)];
                    let halves = [0.1 * size, 0.1 * random.unit() * size];
                    stroke_of(a, a + (b - a) * 0.2, halves, cuts, &look)
                }
                _ => Cover::default(),
            }
        })
        .collect()
}

/// Words of `cover_counts` for such records of particles.
fn counts_of(covers: &[Cover]) -> [u32; 8] {
    let something = covers.iter().filter(|it| it.shape[2] != COVER_NONE).count();
    [something as u32, covers.len() as u32, 0, 0, 0, 0, 0, 0]
}
