//! No sorting: any order gives the same picture (Reeves 1983, section 2.5).

use motes::cpu::draw::splat::{Onto, splat};
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
        let sums = LightSums::new(plan.width, plan.height);
        let onto = Onto {
            light: &sums,
            nearness: &[],
        };
        particles.sort_by_key(|particle| {
            let words = [particle.position_and_index, particle.velocity_and_birth].concat();
            words.iter().fold(salt, |sum, word| hash(sum ^ word))
        });
        for particle in &particles {
            splat(particle, &inputs, &inputs.rows, onto, false);
        }
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
