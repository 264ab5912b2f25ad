//! A whole picture by nothing but triangles with colours at their corners and point lights: the flames, what
//! burns, and its light (Perry 1994, 1.2).

use motes::backend::Backend;
use motes::layout::FlameLight;

use crate::common;
use crate::fan::{fans_of, shaded};
use crate::support::*;

/// Corners, of which the order is that seen from outside.
type Triangle = [Place; 3];

fn plus(a: Place, b: Place) -> Place {
    [0, 1, 2].map(|axis| a[axis] + b[axis])
}

fn times(a: Place, factor: f64) -> Place {
    a.map(|x| x * factor)
}

fn cross(a: Place, b: Place) -> Place {
    [0, 1, 2].map(|axis| {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        a[next] * b[last] - a[last] * b[next]
    })
}

/// A cube of that half edge, turned about x and then about y, two triangles a face.
fn cube(middle: Place, half: f64, [about_x, about_y]: [f64; 2]) -> Vec<Triangle> {
    let turned = |[x, y, z]: Place| {
        let (sin, cos) = about_x.to_radians().sin_cos();
        let [y, z] = [y * cos - z * sin, y * sin + z * cos];
        let (sin, cos) = about_y.to_radians().sin_cos();
        [x * cos + z * sin, y, z * cos - x * sin]
    };
    let face = |at: usize| {
        let axis = at / 2;
        let side = if at.is_multiple_of(2) { 1.0 } else { -1.0 };
        let corner = |across: f64, along: f64| {
            let mut place = [0.0; 3];
            place[axis] = side;
            place[(axis + 1) % 3] = across * side;
            place[(axis + 2) % 3] = along;
            plus(middle, turned(times(place, half)))
        };
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(across, along)| corner(across, along));
        [
            [corners[0], corners[1], corners[2]],
            [corners[0], corners[2], corners[3]],
        ]
    };
    (0..6).flat_map(face).collect()
}

/// Which triangle the way from the eye meets first, and where.
fn met(triangles: &[Triangle], eye: Place, way: Place) -> Option<(usize, Place)> {
    let far = |[a, b, c]: &Triangle| {
        let (to_b, to_c, from_a) = (minus(*b, *a), minus(*c, *a), minus(eye, *a));
        let beside = cross(way, to_c);
        let whole = dot(to_b, beside);
        let of_b = dot(from_a, beside) / whole;
        let of_c = dot(way, cross(from_a, to_b)) / whole;
        let is_in = of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0;
        is_in.then(|| dot(to_c, cross(from_a, to_b)) / whole)
    };
    let all = triangles.iter().enumerate();
    let met = all.filter_map(|(at, triangle)| far(triangle).map(|far| (at, far)));
    let (at, far) = met.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((at, plus(eye, times(way, far))))
}

#[test]
fn p5_a_burning_cube_is_triangles_with_colours_at_their_corners_in_point_lights() {
    let (ambient, albedo) = ([0.05, 0.06, 0.08], [0.8, 0.6, 0.4]);
    let scene = scene_with(
        &[&lone(
            "light = 6\nnoisiness = 0.3\nheight = 0.8\nwidth = 0.3\n\
             [[fire.flame]]\nposition = [-0.1, 0.05, 0.75]\n",
        )],
        "[light]\ncolor = [0, 0, 0]\nambient = [0.05, 0.06, 0.08]\n\
         [[surface]]\nmesh = \"cube\"\nposition = [0.1, 0.3, -0.2]\nrotation_degrees = [25, 40]\n\
         scale = 0.4\ncolor = [0.8, 0.6, 0.4]\n",
    );
    let plan = plan(&scene);
    let inputs = plan.inputs(9);
    let mut cpu = common::on_cpu(&plan);
    cpu.step(&inputs).expect("it runs");
    cpu.draw(&inputs).expect("it runs");
    let words = cpu.read("flame_lights").expect("it is read");
    let lights: Vec<FlameLight> = bytemuck::pod_collect_to_vec(&words);
    let float = |bits: u32| f64::from(f32::from_bits(bits));
    let [x, y, z, extent] = lights[0].place.map(float);
    let [red, green, blue, _] = lights[0].color.map(float);
    assert!(red > 0.0 && lights[1..].iter().all(|light| light.color == [0; 4]));
    let sum = way(&scene, 9).into_iter().fold([0.0; 3], plus);
    assert_near([x, y, z], times(sum, 1.0 / 25.0), 1e-5);

    let drawn = drawn(&scene, 9);
    let flame = fans_of(&drawn.discs);
    assert_eq!(flame.len(), 25 * 20);
    let cube = cube([0.1, 0.3, -0.2], 0.4, [25.0, 40.0]);
    let eye = [0.0, 0.5, 2.5];
    let focal = 60.0 / 22.5f64.to_radians().tan();
    // The triangle in a place of the picture, and where; two of a face are alike.
    let seen = |x: f64, y: f64| met(&cube, eye, [(x - 80.0) / focal, (60.0 - y) / focal, -1.0]);
    let lit = |(triangle, place): (usize, Place)| {
        let [a, b, c] = cube[triangle];
        let across = cross(minus(b, a), minus(c, a));
        let away = minus([x, y, z], place);
        let slant = (dot(across, away) / length(across)).max(0.0);
        let share = slant / (dot(away, away) + extent).powf(1.5);
        let color = [red, green, blue];
        [0, 1, 2].map(|i| albedo[i] * (ambient[i] + color[i] * share))
    };
    let (mut of_cube, mut of_flame, mut of_both, mut on_edges) = (Vec::new(), 0, 0, 0);
    for (at, word) in drawn.image.iter().enumerate().take(160 * 120) {
        let (x, y) = ((at % 160) as f64, (at / 160) as f64);
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let faces = corners.map(|(right, down)| seen(x + right, y + down).map(|it| it.0 / 2));
        if faces.iter().any(|face| *face != faces[0]) {
            on_edges += 1;
            continue;
        }
        let place = [x + 0.5, y + 0.5];
        let surface = seen(place[0], place[1]).map(lit);
        let light = flame.iter().filter_map(|triangle| shaded(*triangle, place));
        let glow = light.fold([0.0; 3], |sum, [red, green, blue, alpha]| {
            [
                sum[0] + red * alpha,
                sum[1] + green * alpha,
                sum[2] + blue * alpha,
            ]
        });
        let is_lit = glow[0] > 1.0 / 255.0;
        of_flame += u32::from(is_lit);
        of_both += u32::from(is_lit && surface.is_some());
        of_cube.extend(surface.map(|light| light[0]));
        for channel in 0..3 {
            let wanted = surface.map_or(0.0, |light| light[channel]) + glow[channel];
            let wanted = wanted.clamp(0.0, 1.0) * 255.0;
            let got = f64::from(word >> (8 * channel) & 0xff);
            assert!(
                (got - wanted).abs() < 1.01,
                "{got}, not {wanted} in channel {channel} at {x}, {y}"
            );
        }
    }
    let counts = (of_cube.len(), of_flame, of_both, on_edges);
    assert!(
        counts.0 > 1500 && counts.1 > 800 && counts.2 > 100 && counts.3 < 600,
        "{counts:?}"
    );
    let [least, most] =
        [f64::min, f64::max].map(|of| of_cube.iter().copied().reduce(of).expect("it is seen"));
    assert!(most > 3.0 * least, "from {least} to {most}");
}
