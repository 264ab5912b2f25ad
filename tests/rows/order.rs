//! No sorting: any order gives the same picture (Reeves 1983, section 2.5).

use motes::cpu::draw::splat::{View, splat};
use motes::cpu::light::LightSums;
use motes::layout::Particle;
use motes::plan::Plan;
use motes::scene::Scene;

use crate::common::{everything, hash};
use crate::support::{Run, on_every_backend};

#[test]
fn r40_the_order_of_systems_does_not_matter() {
    let scene = everything();
    let reversed = Scene {
        systems: scene.systems.iter().rev().cloned().collect(),
        ..scene.clone()
    };
    on_every_backend(|on| {
        let result = |scene: &Scene| {
            let mut run = Run::new(on, scene, 12);
            run.step_to(11);
            let order: Vec<_> = run.members().iter().map(|member| member.who).collect();
            (order, run.light(), run.image())
        };
        let (first, second) = (result(&scene), result(&reversed));
        assert_ne!(first.0, second.0, "the particles stand in another order");
        assert!(
            first.1 == second.1 && first.2 == second.2,
            "another picture"
        );
    });
}

#[test]
fn r40_the_order_of_particles_does_not_matter() {
    let scene = everything();
    let plan = Plan::new(&scene, 12).expect("the scene can be planned");
    let mut run = Run::of_plan("cpu", plan.clone());
    run.step_to(11);
    let drawn = run.light();
    let mut particles: Vec<Particle> = run.members().iter().map(|member| member.raw).collect();
    assert!(particles.len() > 2000);
    let inputs = plan.inputs(11);
    for salt in 0..4 {
        let mut sums = LightSums::new(plan.width, plan.height);
        let view = View {
            inputs: &inputs,
            rows: &inputs.rows,
            nearness: &[],
            is_behind: false,
        };
        particles.sort_by_key(|particle| {
            let words = [particle.position_and_index, particle.velocity_and_birth].concat();
            words.iter().fold(salt, |sum, word| hash(sum ^ word))
        });
        splat(&particles, view, &mut sums, &mut Vec::new());
        let same = |(at, &steps): (usize, &u64)| {
            let (low, high) = sums.limbs(at);
            steps == u64::from(low) | (u64::from(high) << 32)
        };
        assert!(
            drawn.steps.iter().enumerate().all(same),
            "another picture, salt {salt}"
        );
    }
}

#[test]
fn r40_particles_drawn_together_are_those_drawn_alone() {
    let scene = everything();
    let plan = Plan::new(&scene, 12).expect("the scene can be planned");
    let mut run = Run::of_plan("cpu", plan.clone());
    run.step_to(11);
    let particles: Vec<Particle> = run.members().iter().map(|member| member.raw).collect();
    let inputs = plan.inputs(11);
    let view = View {
        inputs: &inputs,
        rows: &inputs.rows,
        nearness: &[],
        is_behind: false,
    };
    let limbs = |sums: &LightSums| -> Vec<_> { (0..sums.len()).map(|at| sums.limbs(at)).collect() };
    let dark = || LightSums::new(plan.width, plan.height);
    // Sixteen of one birth are taken together: there are such, and others.
    let birth = |particle: &Particle| particle.velocity_and_birth[3];
    let is_of_one = |block: &[Particle]| block.iter().all(|it| birth(it) == birth(&block[0]));
    let starts: Vec<usize> = (0..particles.len() - 17).step_by(16).collect();
    let together = |start: &&usize| is_of_one(&particles[**start..**start + 16]);
    let blocks = starts.iter().filter(together).count();
    assert!(blocks > 20 && blocks < starts.len(), "{blocks}");
    let mut seen = Vec::new();
    for start in starts.into_iter().step_by(3) {
        for count in [1, 15, 16, 17] {
            let some = &particles[start..start + count];
            let (mut all, mut alone) = (dark(), dark());
            splat(some, view, &mut all, &mut seen);
            for particle in some {
                let one = std::slice::from_ref(particle);
                splat(one, view, &mut alone, &mut seen);
            }
            assert!(
                limbs(&all) == limbs(&alone),
                "{count} particles from {start} on"
            );
        }
    }
}
