//! Every stage of flocks on every adapter against the processor, bit for bit.

use motes::gpu::GpuOptions;
use motes::plan::Plan;

use crate::common::*;
use crate::support::*;

fn assert_twins(plan: &Plan, frames: u32, options: &GpuOptions) {
    let frames = frames_of(plan, frames);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, plan, options);
        if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(plan)) {
            panic!("{name}: {difference}");
        }
    });
}

/// Every kind of relation, edge and dimension at once.
fn everything() -> Vec<String> {
    let box_of = "min = [0, 0, -20], max = [300, 200, 20]";
    vec![
        format!(
            "name = \"a\"\ncount = 300\nregion = {{ {box_of} }}\ndimensions = 3\n\
             edges = {{ kind = \"torus\", {box_of} }}\nperception_radius = 18\n\
             [[flock.relation]]\nkind = \"flock\"\n\
             [[flock.relation]]\nkind = \"avoid\"\nother = \"c\"\n"
        ),
        format!(
            "name = \"b\"\ncount = 200\nregion = {{ {box_of} }}\ndimensions = 3\nmass = 3\n\
             force = [0.01, 0, 0.02]\nedges = {{ kind = \"repel\", inward = true, {box_of} }}\n\
             [[flock.relation]]\nkind = \"flock\"\nseparation = \"inverse_distance\"\n\
             [[flock.relation]]\nkind = \"flock\"\nother = \"a\"\nradius = 15\n\
             [[flock.relation]]\nkind = \"approach\"\nother = \"c\"\n"
        ),
        "name = \"c\"\ncount = 7\nregion = { min = [10, 10, 0], max = [200, 200, 0] }\n\
         start_speed = 10\nedges = { kind = \"constrain\", min = [0, 0, 0], max = [200, 200, 0] }"
            .into(),
        format!("{FREE}\nforce = [0, 0.1, 0]"),
    ]
}

#[test]
fn f40_everything_is_the_same_stage_by_stage() {
    let flocks = everything();
    let flocks: Vec<&str> = flocks.iter().map(String::as_str).collect();
    let options = GpuOptions {
        workgroup_size: 64,
        ..GpuOptions::default()
    };
    assert_twins(&plan(&scene(&flocks)), 12, &options);
}
