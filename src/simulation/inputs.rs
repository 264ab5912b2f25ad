//! Whether inputs of the caller's making fit the plan.

use crate::layout::{
    FLAME_LIGHTS, FLAME_STEPS, FireFrame, FlockFrame, Ground, Ignition, MOST_NEAREST,
    OBSTACLE_MESH, ROOTS_MESH, SHAPE_CURVE, SHAPE_MESH, SPREAD_BLOCKS, ShadeBox, StrokeLight,
    SurfaceFrame, SurfaceLight, SystemFrame, SystemRow,
};
use crate::plan::{FrameInputs, Plan, PlanError};

/// Whether lists of the caller's making are as long as the plan's, or as they can be.
pub(super) fn check_sizes(plan: &Plan, inputs: &FrameInputs) -> Result<(), PlanError> {
    let refuse = |message: String, help: String| {
        Err(PlanError {
            message,
            help,
            key: None,
        })
    };
    let slots = plan.own_system_count as usize;
    let of_tree = if plan.tree_levels > 0 { slots } else { 0 };
    let lists = [
        inputs.poses.len(),
        inputs.broods.len(),
        inputs.row_spreads.len(),
    ];
    if lists.iter().any(|len| *len != of_tree) {
        return refuse(
            "inputs for other systems that bear systems than the plan's".into(),
            format!("{of_tree} poses, broods and spreads of rows"),
        );
    }
    if inputs.systems.len() != slots || inputs.rows.len() != slots {
        return refuse(
            format!(
                "inputs for {} systems and {} rows",
                inputs.systems.len(),
                inputs.rows.len()
            ),
            format!("this plan has {slots} of each"),
        );
    }
    for (what, count, most) in [
        ("bounds", inputs.bounds.len(), Plan::MOST_BOUNDS),
        ("winds", inputs.winds.len(), Plan::MOST_WINDS),
        ("obstacles", inputs.obstacles.len(), Plan::MOST_OBSTACLES),
        ("planets", inputs.planets.len(), u32::from(plan.uses.planet)),
        ("lamps", inputs.lamps.len(), Plan::MOST_LAMPS),
        ("grounds", inputs.grounds.len(), u32::from(plan.uses.ground)),
        ("pillars", inputs.pillars.len(), Plan::MOST_PILLARS),
        ("layer planes", inputs.layer_planes.len(), Plan::MOST_LAYERS),
    ] {
        if count > most as usize {
            return refuse(format!("{count} {what}"), format!("at most {most}"));
        }
    }
    if !meshes_fit(plan, inputs) {
        return refuse(
            "inputs with other surfaces than the plan's".into(),
            "surfaces of the plan, on its triangles, and what falls on them counts what is listed"
                .into(),
        );
    }
    if !surfaces_fit(inputs) {
        return refuse(
            "inputs with a ground that counts others than there are".into(),
            format!(
                "its lamps and pillars as listed, and point lights of flames within {FLAME_LIGHTS}"
            ),
        );
    }
    let end = |system: &SystemFrame| u64::from(system.first_bound) + u64::from(system.bound_count);
    let last = inputs.systems.iter().map(end).max().unwrap_or(0);
    if last > inputs.bounds.len() as u64 {
        return refuse(
            format!("a system's bounds end at {last}"),
            format!("there are {}", inputs.bounds.len()),
        );
    }
    if !flocks_fit(plan, inputs) {
        return refuse(
            "inputs with other flocks than the plan's".into(),
            "flocks, boids and relations of the plan, and grids of no more cells".into(),
        );
    }
    if !spreads_fit(plan, inputs) {
        return refuse(
            "inputs with other spreads of fires than the plan's".into(),
            "a spread for each fire of the plan that spreads, and rings of the plan's on its faces"
                .into(),
        );
    }
    if !fires_fit(plan, inputs) {
        return refuse(
            "inputs with other fires than the plan's".into(),
            "fires and flames of the plan, on its meshes, with a look for each age".into(),
        );
    }
    let is_right = |light: &StrokeLight| light.kinds[0] as usize <= inputs.lamps.len();
    let has_light = inputs.stroke_lights.len() == usize::from(plan.uses.strokes);
    if !has_light || !inputs.stroke_lights.iter().all(is_right) {
        return refuse(
            "inputs whose light is not that of the plan's strokes".into(),
            "one record of it if the plan has strokes, with its lamps as listed".into(),
        );
    }
    let has_cells = |shade_box: &ShadeBox| shade_box.kinds[0] == plan.shade_cells;
    let has_box = inputs.shade_boxes.len() == usize::from(plan.shade_cells > 0);
    if !has_box || !inputs.shade_boxes.iter().all(has_cells) {
        return refuse(
            "inputs with another box of shadows than the plan's".into(),
            format!(
                "one of {} cells each way, or none if that is 0",
                plan.shade_cells
            ),
        );
    }
    let is_stored = |row: &SystemRow| {
        let [_, first, len, _] = row.shape;
        let stored = plan.curve_points.len() as f32;
        row.kinds[0] != SHAPE_CURVE || (first >= 0.0 && len >= 1.0 && first + len < stored)
    };
    if !inputs.rows.iter().all(is_stored) {
        return refuse(
            "a row names points of curves that the plan has not".into(),
            "give the plan a system that is born on that curve".into(),
        );
    }
    let has_faces = |row: &SystemRow| {
        let [_, first, count, _] = row.shape;
        let stored = plan.meshes.choices.len() as f32;
        row.kinds[0] != SHAPE_MESH || (first >= 0.0 && count >= 1.0 && first + count <= stored)
    };
    if !inputs.rows.iter().all(has_faces) {
        return refuse(
            "a row names faces of meshes that the plan has not".into(),
            "give the plan a system that is born on that mesh".into(),
        );
    }
    Ok(())
}

/// Whether grounds count the lamps and pillars that are listed, and lights of flames that there can be.
fn surfaces_fit(inputs: &FrameInputs) -> bool {
    let is_right = |ground: &Ground| {
        ground.kinds[2] as usize <= inputs.lamps.len()
            && ground.kinds[3] <= FLAME_LIGHTS
            && ground.counts[0] as usize == inputs.pillars.len()
    };
    let has_room = |fire: &FireFrame| {
        let [first, count, youngest, oldest] = fire.lights;
        u64::from(first) + u64::from(count) <= u64::from(FLAME_LIGHTS)
            && (count <= fire.members[1] || fire.faces[2] == 1)
            && youngest <= oldest
            && oldest < FLAME_STEPS
    };
    let lights: usize = inputs
        .fires
        .iter()
        .map(|fire| fire.lights[1] as usize)
        .sum();
    inputs.grounds.iter().all(is_right)
        && inputs.fires.iter().all(has_room)
        && inputs.light_roots.len() == lights
}

/// Whether surfaces are the plan's, one after the other, and the light on them counts what is listed.
fn meshes_fit(plan: &Plan, inputs: &FrameInputs) -> bool {
    let mut before = 0u64;
    let mut is_own = |surface: &SurfaceFrame| {
        let [first, count, number, _] = surface.faces.map(u64::from);
        let is_next = number == before;
        before += count;
        is_next && (first + count) * 3 <= plan.surfaces.corners.len() as u64
    };
    let is_right = |light: &SurfaceLight| {
        light.kinds[0] as usize <= inputs.lamps.len()
            && light.kinds[1] <= FLAME_LIGHTS
            && light.kinds[2] as usize <= inputs.pillars.len()
            && light.counts[0] == plan.surface_count
    };
    inputs.surfaces.len() == plan.surface_count as usize
        && inputs.surfaces.iter().all(&mut is_own)
        && before == u64::from(plan.surface_face_count)
        && inputs.surface_lights.len() == usize::from(plan.uses.surfaces)
        && inputs.surface_lights.iter().all(is_right)
}

/// Whether fires have the plan's flames, and what they name is there.
fn fires_fit(plan: &Plan, inputs: &FrameInputs) -> bool {
    let (mut first, mut first_listed) = (0, 0);
    let mut own_flames = |(fire, count): (&FireFrame, u32)| {
        let [at, of_fire, listed_at, listed] = fire.members;
        let is_own = (at, of_fire, listed_at) == (first, count, first_listed);
        first += count;
        first_listed += listed;
        is_own && listed <= count
    };
    let has_faces = |fire: &FireFrame| {
        let [first, count, ..] = fire.faces.map(u64::from);
        fire.kinds[0] != ROOTS_MESH
            || (count >= 1 && first + count <= plan.meshes.choices.len() as u64)
    };
    inputs.fires.len() == plan.fire_count as usize
        && inputs.listed_flames.len() == plan.listed_flame_count as usize
        && inputs.age_looks.len() == (plan.fire_count * FLAME_STEPS) as usize
        && inputs
            .fires
            .iter()
            .zip(plan.flame_counts())
            .all(&mut own_flames)
        && first_listed == plan.listed_flame_count
        && inputs.fires.iter().all(has_faces)
}

/// Whether what spreads is what the plan has, and rings that begin are on its faces.
fn spreads_fit(plan: &Plan, inputs: &FrameInputs) -> bool {
    let mut before = 0u64;
    let due = &inputs.due_ignitions;
    let all: u64 = due.iter().map(|one| u64::from(one.kinds[1])).sum();
    let mut is_right = |one: &Ignition| {
        let [face, count, slot, _] = one.kinds;
        let [of_those_before, ring, of_all, _] = one.order;
        let in_order = u64::from(of_those_before) == before && u64::from(of_all) == all;
        before += u64::from(count);
        let names = (face as usize) < plan.spreads.faces.len()
            && slot < plan.spread_count
            && ring < plan.ring_count;
        // One without points stands for none.
        (in_order && names && count > 0) || all == 0
    };
    inputs.spreads.len() == plan.spread_count as usize
        && (plan.spread_count == 0 || !due.is_empty())
        && due.len() <= plan.ring_count as usize
        && all <= u64::from(plan.ignited_count)
        && due.iter().all(&mut is_right)
        && inputs.spreads.iter().all(|spread| {
            let blocks = spread.kinds[1] & SPREAD_BLOCKS != 0;
            (spread.kinds[0] as usize) < inputs.fires.len() && (plan.blocks || !blocks)
        })
}

/// Whether flocks have the plan's boids, and grids and relations have room in its lists.
fn flocks_fit(plan: &Plan, inputs: &FrameInputs) -> bool {
    let mut first = 0;
    let mut own_boids = |(flock, count): (&FlockFrame, u32)| {
        let [at, of_flock, ..] = flock.members;
        let is_own = at == first && of_flock == count;
        first += count;
        is_own
    };
    let mut with_counts = inputs.flocks.iter().zip(plan.boid_counts());
    let within = |first: u32, count: u64, most: usize| u64::from(first) + count <= most as u64;
    let ties = inputs.relations.len();
    inputs.flocks.len() == plan.flock_count as usize
        && ties <= plan.relation_count as usize
        && with_counts.all(&mut own_boids)
        && inputs.flocks.iter().all(|flock| {
            let [x, y, z, first] = flock.grid;
            let cells = [x, y, z].map(u64::from).iter().product();
            let [first_cover, faces, first_obstacle, obstacles] = flock.drawn;
            let covers = u64::from(flock.members[1]) * u64::from(faces);
            cells > 0
                && faces <= 2
                && within(first_cover, covers, plan.boid_cover_count as usize)
                && cells <= u64::from(u32::MAX)
                && within(first, cells, plan.cell_count as usize)
                && within(flock.ties[0], flock.ties[1].into(), ties)
                && trail_fits(plan, flock)
                && within(first_obstacle, obstacles.into(), inputs.obstacles.len())
        })
        && inputs.obstacles.iter().all(|obstacle| {
            let [kind, _, first, count] = obstacle.kinds;
            let stored = plan.solids.face_count() as usize;
            kind != OBSTACLE_MESH || count > 0 && within(first, count.into(), stored)
        })
        && inputs.relations.iter().all(|tie| {
            let [_, other, _, nearest] = tie.kinds;
            (other as usize) < inputs.flocks.len() && nearest <= MOST_NEAREST
        })
}

/// Whether a flock's trails have room, and are rings of a power of two.
fn trail_fits(plan: &Plan, flock: &FlockFrame) -> bool {
    let [first_place, mask, segments, first_cover] = flock.trail;
    let ring = u64::from(mask) + 1;
    let (count, faces) = (u64::from(flock.members[1]), u64::from(flock.drawn[1]));
    let places = u64::from(first_place) + count * ring;
    let covers = u64::from(first_cover) + count * faces * u64::from(segments);
    segments == 0
        || ring.is_power_of_two()
            && u64::from(segments) <= ring
            && places <= plan.boid_trail_count.into()
            && covers <= plan.boid_cover_count.into()
}
