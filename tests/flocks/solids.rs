//! Meshes that boids stay out of, or inside of.

use glam::{DVec3, Vec3};
use motes::cpu::urge::surface_of;
use motes::mesh::{Mesh, Surface, builtin};
use motes::plan::Plan;

use crate::common::on_cpu;
use crate::support::*;

/// How often the mesh is wound around the place: 1 inside, 0 outside (van Oosterom and Strackee 1983).
fn winding(mesh: &Mesh, p: DVec3) -> f64 {
    let of = |face| {
        let [a, b, c] = mesh.corners(face).map(|it| Vec3::from(it).as_dvec3() - p);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    let sum: f64 = (0..mesh.triangles().len()).map(of).sum();
    sum / (4.0 * std::f64::consts::PI)
}

/// How far its surface is: of each triangle, the foot on it if that is on it, else the nearest of its edges.
fn distance(mesh: &Mesh, p: DVec3) -> f64 {
    let to_segment = |a: DVec3, b: DVec3| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + (b - a) * t)
    };
    let to_face = |face| {
        let [a, b, c] = mesh.corners(face).map(|it| Vec3::from(it).as_dvec3());
        let normal = (b - a).cross(c - a).normalize();
        let foot = p - normal * normal.dot(p - a);
        let is_left = |a: DVec3, b: DVec3| normal.dot((b - a).cross(foot - a)) >= 0.0;
        let edges = to_segment(a, b).min(to_segment(b, c)).min(to_segment(c, a));
        if is_left(a, b) && is_left(b, c) && is_left(c, a) {
            edges.min(p.distance(foot))
        } else {
            edges
        }
    };
    (0..mesh.triangles().len())
        .map(to_face)
        .fold(f64::INFINITY, f64::min)
}

const SCALE: f32 = 40.0;
const MIDDLE: [f32; 3] = [250.0, 150.0, 100.0];

fn mesh(name: &str) -> Mesh {
    builtin(name).expect("it is built in").expect("it is well")
}

/// A flock with such an obstacle, whose lines these are.
fn flock(name: &str, lines: &str, count: u32) -> String {
    let corners = "min = [150, 50, 0], max = [350, 250, 200]";
    let keys = [
        ("count", &*count.to_string()),
        ("dimensions", "3"),
        ("region", &format!("{{ {corners} }}")),
        ("edges", &format!("{{ kind = \"wrap\", {corners} }}")),
    ];
    with(FREE, &keys)
        + &format!(
            "[[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"{name}\"\nscale = {SCALE}\n\
             position = {MIDDLE:?}\n{lines}"
        )
}

fn planned(name: &str, lines: &str) -> Plan {
    plan(&scene(&[&flock(name, lines, 1)]))
}

/// Places all around a mesh and in it, and near its corners, edges and faces, in its own coordinates.
fn places(mesh: &Mesh, random: &mut Random) -> Vec<DVec3> {
    let mut anywhere = || DVec3::new(0.0, 0.0, 0.0).map(|_| random.within(-1.3, 1.3));
    let mut places: Vec<DVec3> = (0..400).map(|_| anywhere()).collect();
    let faces = mesh.triangles().len();
    for at in 0..600 {
        let [a, b, c] = mesh
            .corners(at * 7919 % faces)
            .map(|it| Vec3::from(it).as_dvec3());
        let on = [a, 0.3 * a + 0.7 * b, (a + b + c) / 3.0][at % 3];
        places.push(on + anywhere() * [0.003, 0.02, 0.1][at / 3 % 3]);
    }
    places
}

#[test]
fn surfaces_of_meshes_are_as_far_as_they_are() {
    for name in ["cube", "cylinder", "sphere", "torus"] {
        let mesh = mesh(name);
        let stays = [false, true].map(|inside| {
            let stay = if inside {
                "stay = \"inside\""
            } else {
                "margin = 1000"
            };
            planned(name, stay)
        });
        let (mut worst, mut inside) = (0.0f64, 0);
        for place in places(&mesh, &mut Random(5)) {
            let far = distance(&mesh, place);
            if far < 1e-4 {
                continue;
            }
            let is_inside = winding(&mesh, place) > 0.5;
            inside += u32::from(is_inside);
            let expected = if is_inside { -far } else { far } * f64::from(SCALE);
            let world = Vec3::from(MIDDLE) + SCALE * place.as_vec3();
            for (plan, sign) in stays.iter().zip([1.0, -1.0]) {
                let obstacle = plan.inputs(0).obstacles[0];
                let surface = surface_of(&obstacle, &plan.solids.rows, world);
                let off = (sign * f64::from(surface.distance) - expected).abs();
                assert!(off < 1e-3, "{name}, {place}: {surface:?}, not {expected}");
                worst = worst.max(off);
                let length = f64::from(surface.normal.length());
                assert!((length - 1.0).abs() < 1e-5, "{surface:?}");
                // Along the normal, it is reached.
                let foot = world - surface.normal * surface.distance;
                let foot = (foot - Vec3::from(MIDDLE)).as_dvec3() / f64::from(SCALE);
                assert!(distance(&mesh, foot) < 1e-4, "{name}, {place}: {surface:?}");
            }
        }
        println!("{name}: {worst} off; {inside} inside");
        assert!(inside > 100, "{inside}");
    }
}

#[test]
fn nobody_is_ever_inside_a_mesh_nor_out_of_one() {
    for (name, inside) in [("torus", false), ("cube", true), ("cylinder", false)] {
        let stay = if inside { "stay = \"inside\"\n" } else { "" };
        let goal = format!(
            "[[flock.relation]]\nkind = \"flock\"\n[flock.goal]\nposition = {MIDDLE:?}\nlimit = 0.4\n"
        );
        let lines = flock(name, stay, 60) + &goal;
        let plan = plan(&scene(&[&lines]));
        let mesh = mesh(name);
        let mut cpu = on_cpu(&plan);
        let (mut near, mut all) = (0, 0);
        for frame in 0..80 {
            step(&mut cpu, &plan.inputs(frame));
            for (place, _) in states_of(&boids(&mut cpu)) {
                let local = (Vec3::from(place) - Vec3::from(MIDDLE)).as_dvec3() / f64::from(SCALE);
                let far = f64::from(SCALE) * distance(&mesh, local);
                let is_inside = winding(&mesh, local) > 0.5;
                assert!(
                    is_inside == inside || far < 1e-3,
                    "{name}, frame {frame}: {place:?}, {far} beyond"
                );
                near += u32::from(far < 5.0);
                all += 1;
            }
        }
        println!("{name}: {near} of {all} near");
        assert!(near > 200, "{near}");
    }
}

/// Faces that face inward, as some files have them, enclose as much.
#[test]
fn what_is_wound_the_other_way_keeps_boids_out_too() {
    let corners = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n";
    let faces = ["f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"];
    for turned in [false, true] {
        let text: String = faces
            .iter()
            .map(|face| {
                let mut words: Vec<&str> = face.split(' ').collect();
                if turned {
                    words.swap(2, 3);
                }
                words.join(" ") + "\n"
            })
            .collect();
        let text = format!("{corners}{text}");
        let mesh = Mesh::read("wedge.obj", text.as_bytes(), &mut |_| unreachable!());
        let surface = Surface::new(&mesh.expect("it is a mesh"), 1.0).expect("it has two sides");
        assert!(surface.is_closed());
        let normals: Vec<_> = surface.outward_normals().collect();
        // The slanted face looks away from the origin; so do its edges and corners.
        let slanted = normals[3];
        assert!(
            slanted.iter().all(|[x, y, z]| x + y + z > 0.1),
            "{slanted:?}"
        );
        assert!(normals[0][0][2] < -0.9, "{:?}", normals[0]);
    }
}

#[test]
fn boids_without_depth_have_no_meshes_for_obstacles() {
    let flat = flock("cube", "", 2).replace("dimensions = 3", "dimensions = 2");
    let scene = scene(&[&flat]);
    let error = Plan::new(&scene, 1).expect_err("it has a mesh");
    assert!(
        error.message.contains("`flock.boids` is a mesh"),
        "{error:?}"
    );
    assert!(error.help.contains("`dimensions = 3`"), "{error:?}");
}
