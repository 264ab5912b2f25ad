//! The scene `white-sand`.

use motes::backend::Backend;
use motes::layout::{NODE_FREE, Node};
use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::support::{drawn, records};

fn white_sand() -> Scene {
    let small = ["image.width=320".into(), "image.height=180".into()];
    motes::scene::load_with("white-sand", &small).expect("it is built in")
}

/// The bed and its clumps alone.
fn bed() -> Scene {
    let mut scene = white_sand();
    scene
        .systems
        .retain(|system| ["bed", "clump"].contains(&system.name.as_str()));
    scene
}

#[test]
fn r81_grass_is_green_and_dark_green() {
    let mut scene = bed();
    // White light from everywhere: colours as they are.
    scene.light.ambient = [1.0; 3];
    scene.light.color = [0.0; 3];
    let (plan, mut backend) = drawn(&scene, 0);
    let (mut dark, mut light, mut count) = (0, 0, 0);
    for [_, pieces] in records(&plan, &mut backend) {
        for piece in pieces {
            let [red, green, blue, _] = piece.color.map(f32::from_bits);
            // Hues from yellow green to the middle of the greens.
            assert!(green > red && blue < 0.5 * green, "{red} {green} {blue}");
            dark += usize::from(green < 0.3);
            light += usize::from(green > 0.45);
            count += 1;
        }
    }
    assert!(count > 20_000, "{count}");
    assert!(
        dark > count / 10 && light > count / 10,
        "{dark} dark, {light} light of {count}"
    );
}

#[test]
fn r82_a_bed_is_of_a_hundred_clumps_and_more_and_hides_its_ground() {
    let mut scene = bed();
    scene.systems[1].stroke_shadow = 0.0;
    // From above, straight.
    scene.systems[0].rotation_degrees = [-90.0, 0.0];
    let [x, _, z] = scene.systems[0].position;
    scene.camera.position = [x, 9.0, z];
    scene.camera.target = [x, 0.0, z];
    scene.camera.up = [0.0, 0.0, -1.0];
    let (plan, mut backend) = drawn(&scene, 0);
    let words = backend.read("nodes").expect("it can be read");
    let nodes: Vec<Node> = bytemuck::pod_collect_to_vec(&words);
    let clumps = nodes
        .iter()
        .filter(|node| node.spans[0] != NODE_FREE)
        .count();
    assert!(clumps >= 100, "{clumps}");
    let half_angle = f64::from(scene.camera.vertical_fov_degrees).to_radians() / 2.0;
    let scale = f64::from(plan.height) / 2.0 / half_angle.tan() / 9.0;
    let motes::scene::GenerationShape::Rectangle { length, width } =
        scene.systems[0].generation_shape
    else {
        panic!("it is a rectangle");
    };
    let words = backend.read("cover_bt").expect("it can be read");
    let (mut covered, mut all) = (0.0, 0.0);
    for (at, bt) in words.chunks(2).enumerate() {
        let column = at as u32 % plan.width;
        let row = at as u32 / plan.width;
        let right = (f64::from(column) + 0.5 - f64::from(plan.width) / 2.0) / scale;
        let down = (f64::from(row) + 0.5 - f64::from(plan.height) / 2.0) / scale;
        if right.abs() < f64::from(length) / 2.0 && down.abs() < f64::from(width) / 2.0 {
            covered += 1.0 - f64::from(f32::from_bits(bt[1]));
            all += 1.0;
        }
    }
    let share = covered / all;
    println!("{clumps} clumps cover {share} of {all} pixels");
    assert!(all > 3000.0 && share > 0.9, "{share}");
}

#[test]
fn r83_white_sand_is_the_same_in_every_frame() {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut run = Simulation::new(&white_sand(), &options).expect("the scene can be planned");
    let mut digests = Vec::new();
    for frame in [0, 1, 7, 23] {
        run.seek(frame).expect("it steps");
        run.draw().expect("it draws");
        digests.push(run.image_digest().expect("it can be told"));
        let lines = run.take_statistics().expect("they can be read");
        let last = lines.last().expect("frames were stepped");
        assert_eq!((last.dropped, last.died), (0, 0));
        assert!(last.live > 15_000, "{}", last.live);
    }
    assert!(
        digests.iter().all(|digest| *digest == digests[0]),
        "{digests:x?}"
    );
    // Sky, sand and grass are there.
    let bytes = run.image().expect("it can be read");
    let is = |of: fn([u8; 3]) -> bool| {
        let (pixels, _) = bytes.as_chunks::<4>();
        pixels
            .iter()
            .filter(|pixel| of([pixel[0], pixel[1], pixel[2]]))
            .count()
    };
    let all = bytes.len() / 4;
    assert!(is(|[r, g, b]| b > r && b > g && b > 150) > all / 10, "sky");
    assert!(
        is(|[r, g, b]| r >= g && g > b && r > 140) > all / 10,
        "sand"
    );
    assert!(is(|[r, g, b]| g > r && g > b) > all / 20, "grass");
}
