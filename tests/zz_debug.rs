//! debug
mod common;
use common::*;
use motes::backend::Backend;
use motes::layout::*;
use motes::plan::STAGES;
use motes::cpu::draw::splat::splat;
use motes::cpu::light::LightSums;
use motes::cpu::particle::*;
#[test]
fn debug() {
    let (plan, frames) = adversarial(0, 65530, 10);
    let mut cpu = on_cpu(&plan);
    for inputs in &frames[..7] { for info in STAGES { cpu.run_stage(info.stage, inputs).unwrap(); } }
    let inputs = &frames[6];
    let mut rows = vec![SystemRow::default(); (plan.system_count*plan.row_count) as usize];
    for inputs in &frames[..7] { for (s, r) in inputs.rows.iter().enumerate() { rows[row_index(s as u32, inputs.frame.frame, inputs.frame.row_mask)] = *r; } }
    let ps: Vec<Particle> = bytemuck::pod_collect_to_vec(&cpu.read("particles").unwrap());
    println!("{:?}", inputs.frame);
    let mut n=0;
    for p in &ps {
        let light = LightSums::new(96, 54);
        splat(p, inputs, &rows, &light);
        if light.limbs(0) != (0,0) {
            n+=1;
            let (who, age) = identity_of(p, inputs);
            let row = &rows[row_index(p.slot(), who.birth_frame, inputs.frame.row_mask)];
            let look = appearance_of(who, row, age+1);
            println!("{:?} {:?} v {:?} {:?} {:?} limbs {:?} {:?}", row.kinds, p.position(), p.velocity(), look, p.slot(), light.limbs(0), light.limbs(3*(96*27+48)));
        }
    }
    for s in &inputs.systems { println!("{s:?}"); }
    println!("{n} of {}", ps.len());
}
