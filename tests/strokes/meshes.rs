//! Strokes that stand on meshes, and surfaces that hide them.

use motes::gpu::GpuOptions;
use motes::plan::Plan;
use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::common::{assert_twins, frames_of};
use crate::support::{BLADES, dot, particles, scene, unit};

/// Half the width of the cube that blades stand on.
const HALF: f64 = 0.4;

/// Blades on a cube, which is or is not a surface.
fn on_a_cube(picture: &str, is_surface: bool) -> Scene {
    let cube = motes::mesh::builtin("cube")
        .expect("it is built in")
        .expect("it is right");
    let corners = (0..cube.triangles().len()).flat_map(|face| cube.corners(face));
    let half = f64::from(corners.flatten().fold(0.0, |a: f32, b| a.max(b.abs())));
    let mesh = format!("mesh = \"cube\", scale = {}", HALF / half);
    let blades = BLADES
        .replace(
            "{ kind = \"circle\", radius = 1 }",
            &format!("{{ kind = \"mesh\", {mesh} }}"),
        )
        .replace("rotation_degrees = [-90, 0]\n", "")
        .replace("ejection_angle_degrees = 60", "ejection_angle_degrees = 25")
        .replace(
            "speed = { mean = 0.06, var = 0.03 }",
            "speed = { mean = 0.008, var = 0.003 }",
        )
        .replace("[0.0005, -0.002, 0.0003]", "[0, -0.0002, 0]")
        .replace("initial_mean_parts = 40", "initial_mean_parts = 600");
    let surface = if is_surface {
        format!("\nsurface = [{{ {mesh}, color = [0.5, 0.1, 0.1] }}]")
    } else {
        String::new()
    };
    scene(
        &format!("camera.target = [0, 0, 0]\ncamera.position = [0, 0, 2.6]{picture}{surface}"),
        &[&blades],
    )
}

#[test]
fn r80_strokes_stand_all_over_a_mesh_and_leave_it() {
    let mut on_sides = [0; 6];
    for state in particles(&on_a_cube("", false), 3) {
        let place = state.position.map(f64::from);
        let side = (0..3).find(|i| (place[*i].abs() - HALF).abs() < 1e-5);
        let side = side.unwrap_or_else(|| panic!("{place:?} is on no face"));
        assert!(
            place.iter().all(|part| part.abs() < HALF + 1e-5),
            "{place:?}"
        );
        let mut normal = [0.0; 3];
        normal[side] = place[side].signum();
        // Within the cone about the face's normal.
        let along = dot(unit(state.velocity.map(f64::from)), normal);
        assert!(along > 25f64.to_radians().cos() - 0.01, "{along}");
        on_sides[2 * side + usize::from(place[side] > 0.0)] += 1;
    }
    println!("{on_sides:?}");
    // Six standard deviations of a sixth of them.
    assert!(
        on_sides.iter().all(|count| (45..=155).contains(count)),
        "{on_sides:?}"
    );
}

#[test]
fn r80_a_surface_hides_the_strokes_behind_it() {
    let image = |scene: &Scene| {
        let options = Options {
            adapter: AdapterChoice::Cpu,
            ..Options::default()
        };
        let mut run = Simulation::new(scene, &options).expect("the scene can be planned");
        run.seek(3).expect("it steps");
        run.draw().expect("it draws");
        run.image().expect("it can be read")
    };
    // Blades have no red light at all here, and the cube has no green one.
    let picture = "\nlight = { direction = [0, 0, 1], color = [0, 0, 0], ambient = [1, 1, 1] }";
    let scene_of = |is_surface: bool, z: f64| {
        let mut scene = on_a_cube(picture, is_surface);
        scene.systems[0].color.initial.mean = [0.0, 0.6, 0.0];
        if let Some(surface) = scene.surfaces.first_mut() {
            surface.color = [0.5, 0.0, 0.0];
        }
        // Blades alone go; the surface stays.
        scene.systems[0].position = [0.0, 0.0, z as f32];
        scene
    };
    // What is in the middle of the face that is seen, where green is that of blades.
    let green = |scene: &Scene| {
        let bytes = image(scene);
        let mut count = 0;
        for y in 80..100 {
            for x in 150..170 {
                count += u32::from(bytes[(y * 320 + x) * 4 + 1] > 20);
            }
        }
        count
    };
    let [open, before, behind] = [(false, -1.5), (true, 1.0), (true, -1.5)]
        .map(|(is_surface, z)| green(&scene_of(is_surface, z)));
    println!("{open} pixels without the surface, {before} before it, {behind} behind it");
    assert!(
        open > 20 && before > 20 && behind == 0,
        "{open}, {before}, {behind}"
    );
}

#[test]
fn strokes_on_a_surface_are_the_same_stage_by_stage() {
    let mut scene = on_a_cube(
        "\nlight = { direction = [0.3, 1, 0.5], color = [0.6, 0.6, 0.5], ambient = [0.2, 0.2, 0.3] }",
        true,
    );
    (scene.image.width, scene.image.height) = (93, 61);
    let plan = Plan::new(&scene, 4).expect("the scene can be planned");
    let frames = frames_of(&plan, 4);
    let options = GpuOptions {
        workgroup_size: 24,
        cover_slice: 1024,
        page_bytes: 2048 * 32,
        ..GpuOptions::default()
    };
    assert_twins(&plan, &frames, &options);
}
