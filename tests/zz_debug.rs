//! debug
mod common;
use common::*;
use motes::backend::Backend;
use motes::layout::*;
use motes::gpu::*;
use motes::plan::*;
use motes::cpu::draw::splat::splat;
use motes::cpu::light::LightSums;
use motes::cpu::particle::*;
use motes::exact::*;
#[test]
fn debug() {
    let (plan, frames) = adversarial(0, 65530, 10);
    let device = open("llvmpipe");
    let mut cpu = on_cpu(&plan);
    let mut gpu = on_gpu(&device, &plan, &GpuOptions { page_bytes: 64 << 10, workgroup_size: 64, ..GpuOptions::default() });
    for inputs in &frames[..7] { for info in STAGES { cpu.run_stage(info.stage, inputs).unwrap(); gpu.run_stage(info.stage, inputs).unwrap(); } }
    let inputs = &frames[6];
    let mut rows = vec![SystemRow::default(); (plan.system_count*plan.row_count) as usize];
    for inputs in &frames[..7] { for (s, r) in inputs.rows.iter().enumerate() { rows[row_index(s as u32, inputs.frame.frame, inputs.frame.row_mask)] = *r; } }
    let ps: Vec<Particle> = bytemuck::pod_collect_to_vec(&cpu.read("particles").unwrap());
    assert_eq!(cpu.read("particles").unwrap(), gpu.read("particles").unwrap());
    for slot in 0..6u32 {
        let mut i2 = inputs.clone();
        for (k, s) in i2.systems.iter_mut().enumerate() { if k as u32 != slot { s.world_from_system_z = [0.0,0.0,0.0,1e6]; } }
        cpu.run_stage(Stage::Splat, &i2).unwrap(); gpu.run_stage(Stage::Splat, &i2).unwrap();
        println!("slot {slot}: {:?}", first_difference(&gpu.read("light_low").unwrap(), &cpu.read("light_low").unwrap()));
        // per particle intensity
        if first_difference(&gpu.read("light_low").unwrap(), &cpu.read("light_low").unwrap()).is_some() {
            let inputs = &i2;
            for p in ps.iter().filter(|p| p.slot() == slot) {
                let (who, age) = identity_of(p, inputs);
                let row = &rows[row_index(p.slot(), who.birth_frame, inputs.frame.row_mask)];
                let look = appearance_of(who, row, age+1);
                let w = motes::cpu::draw::splat::world_of(&inputs.systems[slot as usize], p.position().into());
                let light = LightSums::new(96, 54);
                splat(p, inputs, &rows, &light);
                let f = &inputs.frame;
                let z = f.view_from_world_z; let x = f.view_from_world_x; let y = f.view_from_world_y;
                let d = |r: [f32;4]| r[0]*w.x+r[1]*w.y+r[2]*w.z+r[3];
                let sc = f.focal_px * reciprocal(d(z));
                println!("  {:?} birth {} age {} kinds {:?} scale {:?} view {:?} {:?} {:?} px {:?} {:?} color {:?} {} size {} v {:?} lit {:?}", p.position(), who.birth_frame, age, row.kinds, sc, d(x), d(y), d(z), 48.0+d(x)*sc, 27.0-d(y)*sc, look.color, look.transparency, look.size*sc, p.velocity(), light.limbs(0));
            }
            println!("{:?} {:?}", inputs.systems[slot as usize], inputs.frame);
        }
    }
}
