//! Neighbours by the grid against neighbours by looking at everybody.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU32, Ordering};

use motes::backend::{Backend, BackendError};
use motes::cpu::flock::steer::each_range;
use motes::cpu::grid::{cell_coordinates, cell_index};
use motes::gpu::GpuOptions;
use motes::layout::Boid;
use motes::plan::{FrameInputs, Plan, Stage};

use crate::common::*;
use crate::support::*;

/// A flock of 10,000 with all rules, flat or deep, on a torus or not.
fn crowd(deep: bool, torus: bool) -> String {
    let (depth, radius) = if deep { (40, 12) } else { (0, 20) };
    let corners = format!("min = [0, 0, -{depth}], max = [500, 300, {depth}]");
    let kind = if torus { "torus" } else { "wrap" };
    with(
        &flocking(),
        &[
            ("count", "10_000"),
            ("dimensions", if deep { "3" } else { "2" }),
            ("region", &format!("{{ {corners} }}")),
            ("edges", &format!("{{ kind = \"{kind}\", {corners} }}")),
            ("perception_radius", &radius.to_string()),
        ],
    )
}

/// The same inputs with one cell for each flock, so that everybody looks at everybody.
pub(crate) fn without_grid(inputs: &FrameInputs) -> FrameInputs {
    let mut one_cell = inputs.clone();
    for (slot, flock) in one_cell.flocks.iter_mut().enumerate() {
        flock.grid = [1, 1, 1, slot as u32];
        flock.cells_per_unit = [0.0, 0.0, 0.0, flock.cells_per_unit[3]];
    }
    one_cell
}

/// Whom a boid looks at; `by_cell` are indices of boids sorted by cell, `starts` where cells begin.
fn candidates(inputs: &FrameInputs, boid: &Boid, by_cell: &[u32], starts: &[u32]) -> BTreeSet<u32> {
    let flock = &inputs.flocks[0];
    let reach = inputs.relations[0].cohesion[3];
    let mut found = BTreeSet::new();
    each_range(flock, starts, boid.position().into(), reach, |range| {
        for member in &by_cell[range] {
            assert!(found.insert(*member), "a boid is looked at twice");
        }
    });
    found
}

#[test]
fn f17_the_grid_finds_whom_brute_force_finds() {
    for (deep, torus) in [(false, false), (false, true), (true, false), (true, true)] {
        let plan = plan(&scene(&[&crowd(deep, torus)]));
        let mut cpu = on_cpu(&plan);
        step(&mut cpu, &plan.inputs(0));
        let all = boids(&mut cpu);
        let flock = plan.inputs(0).flocks[0];
        let cells: u32 = flock.grid[..3].iter().product();
        assert!(cells > 50, "{:?}", flock.grid);
        let cell_of = |at: &u32| {
            let cell = cell_coordinates(&flock, all[*at as usize].position().into());
            cell_index(&flock, cell.x, cell.y, cell.z)
        };
        let mut by_cell: Vec<u32> = (0..all.len() as u32).collect();
        by_cell.sort_by_key(cell_of);
        let start = |cell: u32| by_cell.partition_point(|at| cell_of(at) < cell) as u32;
        let starts: Vec<u32> = (0..=cells).map(start).collect();
        let radius = plan.inputs(0).relations[0].reach[1];
        let extents = [500.0, 300.0, if deep { 80.0 } else { 0.0 }];
        let is_near = |a: &Boid, b: &Boid| {
            let squares = (0..3).map(|axis| {
                let mut way = (f64::from(a.position()[axis]) - f64::from(b.position()[axis])).abs();
                if torus && extents[axis] > 0.0 {
                    way = way.min(extents[axis] - way);
                }
                way * way
            });
            squares.sum::<f64>() < f64::from(radius).powi(2)
        };
        let mut most = 0;
        for boid in &all {
            let found = candidates(&plan.inputs(0), boid, &by_cell, &starts);
            let near = (0..).zip(&all).filter(|(_, other)| is_near(boid, other));
            for (other, _) in near {
                assert!(found.contains(&other), "deep: {deep}, torus: {torus}");
            }
            most = most.max(found.len());
        }
        assert!(most < all.len() / 10, "the grid spares most of the looking");
    }
}

#[test]
fn f17_sums_do_not_depend_on_the_grid() {
    for (deep, torus) in [(false, false), (false, true), (true, false), (true, true)] {
        let plan = plan(&scene(&[&crowd(deep, torus)]));
        let (mut by_grid, mut by_force) = (on_cpu(&plan), on_cpu(&plan));
        for frame in 0..3 {
            let inputs = plan.inputs(frame);
            step(&mut by_grid, &inputs);
            step(&mut by_force, &without_grid(&inputs));
        }
        assert_eq!(
            states_of(&boids(&mut by_grid)),
            states_of(&boids(&mut by_force)),
            "deep: {deep}, torus: {torus}"
        );
    }
}

/// Runs the frames on each adapter in lockstep with the processor.
fn assert_twins(plan: &Plan, frames: &[FrameInputs], options: &GpuOptions) {
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, plan, options);
        if let Err(difference) = compare_run(frames, &mut gpu, &mut on_cpu(plan)) {
            panic!("{name}: {difference}");
        }
    });
}

#[test]
fn f17_a_grid_of_many_cells_and_one_of_one_are_the_same_on_devices() {
    let plan = plan(&scene(&[&with(&crowd(false, true), &[("count", "3000")])]));
    let frames = frames_of(&plan, 2);
    let options = GpuOptions {
        workgroup_size: 32,
        ..GpuOptions::default()
    };
    assert_twins(&plan, &frames, &options);
    let one_cell: Vec<FrameInputs> = frames.iter().map(without_grid).collect();
    assert_twins(&plan, &one_cell, &options);
}

#[test]
fn f18_coincident_boids_are_the_same_everywhere() {
    let lines = with(
        &flocking(),
        &[
            ("region", "{ min = [7, 7, 0], max = [7, 7, 0] }"),
            ("start_speed", "0"),
        ],
    );
    let plan = plan(&scene(&[&lines]));
    assert_twins(&plan, &frames_of(&plan, 4), &GpuOptions::default());
}

/// The lone boid of a plan's last flock sees the same on a device.
fn assert_sees_the_same(flocks: &[&str]) {
    let plan = plan(&scene(flocks));
    let inputs = plan.inputs(0);
    let name = &adapters()[0];
    let (mut gpu, mut cpu) = (
        on_gpu(&open(name), &plan, &GpuOptions::default()),
        on_cpu(&plan),
    );
    for stage in [Stage::Hatch, Stage::Cells, Stage::Steer] {
        compare_stage(stage, &inputs, &mut gpu, &mut cpu).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

/// More boids in a cell than drivers let a loop turn.
#[test]
fn fa11_a_cell_has_no_most() {
    assert_sees_the_same(&[
        "name = \"crowd\"\ncount = 66_000\nregion = { min = [0, 0, 0], max = [1, 1, 0] }",
        "name = \"one\"\ncount = 1\nregion = { min = [0.5, 0.5, 0], max = [0.5, 0.5, 0] }\n\
         [[flock.relation]]\nkind = \"flock\"\nother = \"crowd\"",
    ]);
}

/// Where a driver ends a loop over boids before its end, all is looked at once more, more at a time. Where it
/// ends one then, or one over faces behind it, nothing that comes of it is handed out: not the boids, nor
/// statistics, nor a digest.
#[test]
fn fa11_nobody_is_overlooked_in_silence() {
    let crowd = "dimensions = 3\n\
                 region = { min = [0, 0, 0], max = [1, 1, 1] }";
    let one = "name = \"one\"\ncount = 1\ndimensions = 3\n\
               region = { min = [0.5, 0.5, 0.5], max = [0.5, 0.5, 0.5] }\n\
               [[flock.relation]]\nkind = \"flock\"\nother = \"crowd\"\n";
    let mesh = "[[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"torus\"\nscale = 3\nmargin = 2\n";
    let overlooked = AtomicU32::new(0);
    // Boids of the crowd, relations, obstacles, whether there are throngs, and whether a driver that ends loops
    // ends one for good.
    let cases = [
        (69_000, 5, "", false, true),
        (69_000, 5, "", true, false),
        (69_000, 1, "", true, false),
        (140_000, 8, "", true, true),
        (129_000, 8, mesh, true, true),
    ];
    for (count, ties, obstacles, throngs, is_too_much) in cases {
        let crowd = format!("name = \"crowd\"\ncount = {count}\n{crowd}");
        // As many relations, each of which looks at all of the crowd.
        let tie = "[[flock.relation]]\nkind = \"avoid\"\nother = \"crowd\"\n";
        let looking = format!("{one}{}{obstacles}", tie.repeat(ties - 1));
        let mut plan = plan(&scene(&[&crowd, &looking]));
        // Four a turn, and where there are throngs sixteen after that.
        (plan.uses.crowds, plan.uses.throngs) = (true, throngs);
        let inputs = plan.inputs(0);
        let mut cpu = on_cpu(&plan);
        step(&mut cpu, &inputs);
        let expected = cpu.read("boids").expect("it can be read");
        on_each_adapter(|name, device| {
            // To others throngs are crowds.
            if throngs && name != "llvmpipe" {
                return;
            }
            let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
            step(&mut gpu, &inputs);
            let outcomes = [
                gpu.read("boids").err(),
                gpu.take_statistics().err(),
                gpu.state_digest().err(),
                gpu.image_digest().err(),
            ];
            let is_overlooked = outcomes.iter().any(Option::is_some);
            if name == "llvmpipe" {
                assert_eq!(is_overlooked, is_too_much, "{ties} relations");
            }
            if !is_overlooked {
                assert!(gpu.read("boids").expect("as before") == expected, "{name}");
                return;
            }
            println!(
                "{name}: {ties} relations and {} obstacles",
                obstacles.len().min(1)
            );
            overlooked.fetch_add(1, Ordering::Relaxed);
            for outcome in outcomes {
                let Some(BackendError::Unsupported(what)) = outcome else {
                    panic!("{name}: {outcome:?}");
                };
                assert!(what.contains("so crowded that 1 of them"), "{what}");
            }
        });
    }
    println!("loops were ended in {overlooked:?} runs");
}

/// More boids on one side than the limbs of a sum hold, in several cells for the sake of those who
/// see less far.
#[test]
fn fa11_a_sum_has_no_most() {
    if !full() {
        return;
    }
    assert_sees_the_same(&[
        "name = \"crowd\"\ncount = 330_000\nregion = { min = [20, -20, 0], max = [95, 20, 0] }",
        "name = \"few\"\ncount = 2\nregion = { min = [0, 0, 0], max = [1, 1, 0] }\n\
         perception_radius = 25\n[[flock.relation]]\nkind = \"flock\"\nother = \"crowd\"",
        "name = \"one\"\ncount = 1\nregion = { min = [0, 0, 0], max = [0, 0, 0] }\n\
         perception_radius = 100\n[[flock.relation]]\nkind = \"flock\"\nother = \"crowd\"",
    ]);
}

/// A crowd in one row of cells that neighbours in two rows see: the loops of both turn together on
/// software drivers, and they have turns for it once.
#[test]
fn fa11_neighbours_of_two_rows_see_a_whole_crowd() {
    let edges = "edges = { kind = \"wrap\", min = [0, 0, 0], max = [500, 300, 0] }";
    assert_sees_the_same(&[
        &format!(
            "name = \"crowd\"\ncount = 45_000\n{edges}\nregion = {{ min = [100, 125, 0], max = [110, 130, 0] }}"
        ),
        &format!(
            "name = \"few\"\ncount = 20\n{edges}\nregion = {{ min = [95, 105, 0], max = [115, 140, 0] }}\n\
             [[flock.relation]]\nkind = \"flock\"\nother = \"crowd\""
        ),
    ]);
}

/// The greatest speed falls at once: velocities of the frame before are beyond it still.
#[test]
fn fa11_sums_hold_velocities_that_were_allowed_before() {
    let lines = "name = \"boids\"\ncount = 600\nforce = [-50, 0, 0]\n\
         region = { min = [0, 0, 0], max = [1, 1, 0] }\nperception_radius = 100_000\n\
         max_speed = { keys = [[0, 1000], [30, 2]], interpolation = \"step\" }\n\
         [[flock.relation]]\nkind = \"flock\"";
    let plan = plan(&scene(&[lines]));
    assert_twins(&plan, &frames_of(&plan, 32), &GpuOptions::default());
}

#[test]
fn boids_of_a_plane_stay_in_it_whatever_they_see() {
    let plan = plan(&scene(&[
        "name = \"deep\"\ncount = 60\ndimensions = 3\nregion = { min = [0, 0, -40], max = [100, 100, 80] }",
        "name = \"flat\"\ncount = 60\nregion = { min = [0, 0, 0], max = [100, 100, 0] }\n\
         [[flock.relation]]\nkind = \"flock\"\nother = \"deep\"\n\
         [[flock.relation]]\nkind = \"avoid\"\nother = \"deep\"",
    ]));
    let mut cpu = on_cpu(&plan);
    for inputs in frames_of(&plan, 12) {
        step(&mut cpu, &inputs);
    }
    let states = states_of(&boids(&mut cpu));
    let (deep, flat) = states.split_at(60);
    assert!(deep.iter().any(|(place, _)| place[2] != 0.0));
    for (place, velocity) in flat {
        assert_eq!([place[2], velocity[2]], [0.0; 2]);
    }
}

#[test]
fn a_torus_that_is_no_wider_than_nothing_keeps_its_boids() {
    let plan = plan(&scene(&[
        "name = \"boids\"\ncount = 9\nstart_speed = 2\nregion = { min = [0, 0, 0], max = [1e-39, 300, 0] }\n\
         edges = { kind = \"torus\", min = [0, 0, 0], max = [1e-38, 300, 0] }",
    ]));
    let mut cpu = on_cpu(&plan);
    for inputs in frames_of(&plan, 4) {
        step(&mut cpu, &inputs);
    }
    for (place, velocity) in states_of(&boids(&mut cpu)) {
        assert!(
            place.iter().chain(&velocity).all(|x| x.is_finite()),
            "{place:?}"
        );
    }
}
