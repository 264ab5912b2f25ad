//! What fronts leave behind, and what they look like: char (Perry 1994, 3.4.1, 4.6) and lines (4.7).

use motes::scene::Scene;
use motes::simulation::{PointState, Simulation};

use crate::common;
use crate::support::*;

const WIDTH: usize = 96;
const HEIGHT: usize = 64;
/// World units of the picture's height.
const VIEW: f64 = 4.0;

/// A square in the x-y plane that burns outward from its middle, seen without perspective from where
/// `from` says, before a background of that colour. Flames themselves are dark.
fn seen(from: [f64; 3], background: [f64; 3], fire: &str, spread: &str) -> Scene {
    common::scene_of(&format!(
        "image = {{ width = {WIDTH}, height = {HEIGHT}, background = {background:?} }}
         camera = {{ position = {from:?}, target = [0, 0, 0], projection = \"orthographic\", view_height = {VIEW} }}
         [[fire]]
         name = \"fire\"
         brightness = 0
         {fire}
         [fire.spread]
         mesh = \"plane\"
         scale = 50
         curvature = \"ignored\"
         opposed_flux = 1
         concurrent_flux = 0
         ignition_heat = 1
         time_scale = 0.05
         separation = 10000
         {spread}"
    ))
}

const IGNITION: &str = "[[fire.spread.ignition]]\nposition = [0, 0, 0]\npoints = 4\n";

/// Red, green and blue of each pixel, 0 to 255.
fn picture(run: &mut Simulation, frame: u32) -> Vec<[f64; 3]> {
    run.seek(frame).expect("it runs");
    run.draw().expect("it draws");
    let image = run.image().expect("it is read");
    let channels = |pixel: &[u8]| [0, 1, 2].map(|at| f64::from(pixel[at]));
    image.chunks(4).map(channels).collect()
}

/// The pixel that has the place on the square in it, seen from straight above.
fn pixel_at(x: f64, y: f64) -> usize {
    let scale = HEIGHT as f64 / VIEW;
    let column = (WIDTH as f64 / 2.0 + x * scale) as usize;
    let row = (HEIGHT as f64 / 2.0 - y * scale) as usize;
    row * WIDTH + column
}

/// One flame on each of four rays, 1 from the middle, out in the frame 23; its mark is as it will be
/// from frame 23 on, and black.
const FOUR_MARKS: &str = "drop_distance = 0.99\nmax_flames = 4\n[fire.spread.char]\nsize = 0.8\nopacity = 0.5\n\
                          glow_frames = 1\nappear_frames = 1\n[[fire.spread.ignition]]\nposition = [0, 0, 0]\npoints = 4\n";

/// How much the mark at a place of the square hides of a pixel, seen from straight above: half at its
/// middle, nothing at its rim, which is antialiased; in between, a smooth step.
fn hidden_by(pixel: usize, [x, y]: [f64; 2]) -> f64 {
    let scale = HEIGHT as f64 / VIEW;
    let across = (pixel % WIDTH) as f64 + 0.5 - WIDTH as f64 / 2.0 - x * scale;
    let down = (pixel / WIDTH) as f64 + 0.5 - HEIGHT as f64 / 2.0 + y * scale;
    let share = (1.0 - across.hypot(down) / (0.4 * scale + 0.5)).max(0.0);
    0.5 * share * share * (3.0 - 2.0 * share)
}

#[test]
fn p77_char_lets_what_is_behind_it_show() {
    let scene = seen([0.0, 0.0, 5.0], [0.8, 0.6, 0.4], "lifetime = 3", FOUR_MARKS);
    let mut run = run(&scene);
    let before = picture(&mut run, 22);
    assert!(before.iter().all(|pixel| *pixel == [204.0, 153.0, 102.0]));
    let after = picture(&mut run, 24);
    // None of the four overlap.
    let middles = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    for (at, pixel) in after.iter().enumerate() {
        let hidden: f64 = middles.iter().map(|middle| hidden_by(at, *middle)).sum();
        for (channel, behind) in pixel.iter().zip([204.0, 153.0, 102.0]) {
            assert_close(*channel, behind * (1.0 - hidden), 1.5);
        }
    }
}

#[test]
fn p77_a_mark_lies_on_what_has_burnt() {
    let hidden = |from: [f64; 3]| {
        let mut run = run(&seen(from, [1.0; 3], "lifetime = 3", FOUR_MARKS));
        let pixels = picture(&mut run, 24);
        pixels.iter().map(|pixel| 255.0 - pixel[0]).sum::<f64>()
    };
    let straight = hidden([0.0, 0.0, 5.0]);
    assert!(straight > 1000.0);
    for degrees in [30.0f64, 60.0, 75.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        for from in [[5.0 * sin, 0.0, 5.0 * cos], [0.0, -5.0 * sin, 5.0 * cos]] {
            assert_close(hidden(from) / straight, cos, 0.03);
        }
    }
    // From behind nothing is seen of it.
    assert_close(hidden([0.0, 0.0, -5.0]), 0.0, 0.0);
}

#[test]
fn p85_char_glows_at_first_and_cools_to_black() {
    let marks = FOUR_MARKS.replace(
        "glow_frames = 1",
        "glow_frames = 20\nglow = [1, 0.25, 0.0625]",
    );
    let mut run = run(&seen([0.0, 0.0, 5.0], [0.0; 3], "lifetime = 3", &marks));
    let mut last = 256.0;
    for age in 0..25u32 {
        let at = pixel_at(0.99, 0.01);
        let [red, green, blue] = picture(&mut run, 23 + age)[at];
        let hidden = hidden_by(at, [1.0, 0.0]);
        let glow = (1.0 - f64::from(age) / 20.0).max(0.0);
        assert_close(red, 255.0 * hidden * glow * glow, 1.5);
        assert_close(green, red / 4.0, 1.0);
        assert_close(blue, red / 16.0, 1.0);
        assert!(red < last || red == 0.0, "{age}: {red} after {last}");
        last = red;
    }
    assert_close(last, 0.0, 0.0);
}

#[test]
fn p77_there_are_as_many_marks_as_flames_have_gone_out() {
    for (max_marks, overflows) in [(5000, false), (60, true)] {
        let spread = format!(
            "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.3\ndrop_distance = 0.07\nseparation = 0.06\nmax_flames = 500\n\
             [fire.spread.char]\nmax_marks = {max_marks}"
        );
        let scene = scene("lifetime = 10", &spread, &["position = [0, 0, 0.5]"], "");
        let mut run = run(&scene);
        let (mut live, mut extinguished, mut lost) = (0, 0, 0);
        for frame in 0..80 {
            run.seek(frame).expect("it runs");
            for line in run.take_statistics().expect("they are read") {
                assert_eq!(line.marks_live + line.marks_died, live + line.flames_died);
                live = line.marks_live;
                extinguished += line.flames_died;
                lost += line.marks_died;
                assert!(line.marks_live + line.flames_live <= 500 + max_marks);
            }
        }
        assert!(extinguished > 600);
        assert_eq!(extinguished, live + lost);
        assert_eq!(lost > 0, overflows);
    }
}

/// Where a control point is in the picture, seen from straight above.
fn in_picture(point: &PointState) -> [f64; 2] {
    let scale = HEIGHT as f64 / VIEW;
    let [x, y, _] = place(point.position);
    [
        WIDTH as f64 / 2.0 + x * scale,
        HEIGHT as f64 / 2.0 - y * scale,
    ]
}

fn distance_from_piece(p: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let from = [p[0] - a[0], p[1] - a[1]];
    let squared = way[0] * way[0] + way[1] * way[1];
    let share = ((from[0] * way[0] + from[1] * way[1]) / squared.max(1e-9)).clamp(0.0, 1.0);
    (from[0] - share * way[0]).hypot(from[1] - share * way[1])
}

#[test]
fn p69_the_front_is_a_line_through_its_control_points() {
    let line = "[fire.spread.line]\nwidth = 0.125\ncolor = [1, 1, 1]\n";
    for separation in ["0.3", "10000"] {
        let spread = format!("{line}{IGNITION}");
        let scene = seen([0.0, 0.0, 5.0], [0.0; 3], "", &spread);
        let mut scene = scene;
        let own = scene.fires[0].spread.as_mut().expect("it spreads");
        own.separation = separation.parse().expect("a number");
        let mut run = run(&scene);
        let pixels = picture(&mut run, 30);
        let points = run.control_points().expect("they are read");
        assert!(points.len() >= 4);
        let places: Vec<[f64; 2]> = points.iter().map(in_picture).collect();
        let next = places.iter().cycle().skip(1);
        let pieces: Vec<[[f64; 2]; 2]> = places.iter().zip(next).map(|(a, b)| [*a, *b]).collect();
        // The line is two pixels wide: what is within half of one is full, what is beyond a pixel and a
        // half is not touched. So it is where it should be to half a pixel.
        for (at, pixel) in pixels.iter().enumerate() {
            let middle = [(at % WIDTH) as f64 + 0.5, (at / WIDTH) as f64 + 0.5];
            let away = pieces
                .iter()
                .map(|piece| distance_from_piece(middle, *piece));
            let nearest = away.fold(f64::MAX, f64::min);
            if nearest < 0.49 {
                assert_close(pixel[0], 255.0, 1.0);
            }
            if nearest > 1.51 {
                assert_close(pixel[0], 0.0, 0.0);
            }
        }
    }
}

#[test]
fn p69_what_rests_on_both_sides_is_no_front() {
    // All of a small square's points come to its border.
    let scene = seen(
        [0.0, 0.0, 5.0],
        [0.0; 3],
        "",
        &format!("[fire.spread.line]\nwidth = 0.125\n{IGNITION}"),
    );
    let mut small = scene.clone();
    let text = "mesh = \"plane\"\nscale = 0.5\ntime_scale = 0.2\n[fire.spread.line]\nwidth = 0.1";
    small.fires =
        crate::support::scene("brightness = 0", text, &["position = [0, 0, 0]"], "").fires;
    let mut run = run(&small);
    let lit = |pixels: &[[f64; 3]]| pixels.iter().filter(|pixel| pixel[0] > 0.0).count();
    assert!(lit(&picture(&mut run, 6)) > 10);
    let pixels = picture(&mut run, 120);
    let points = run.control_points().expect("they are read");
    assert!(points.iter().all(|point| point.inert == 1));
    assert_eq!(lit(&pixels), 0);
}

/// Where puffs are in the picture, and how large and opaque, by the centre of what they hide.
fn hidden(before: &[[f64; 3]], after: &[[f64; 3]]) -> ([f64; 2], f64) {
    let scale = HEIGHT as f64 / VIEW;
    let (mut sum, mut x, mut y) = (0.0, 0.0, 0.0);
    for (at, (clear, dim)) in before.iter().zip(after).enumerate() {
        let lost = clear[0] - dim[0];
        sum += lost;
        x += lost * (((at % WIDTH) as f64 + 0.5 - WIDTH as f64 / 2.0) / scale);
        y -= lost * (((at / WIDTH) as f64 + 0.5 - HEIGHT as f64 / 2.0) / scale);
    }
    ([x / sum, y / sum], sum)
}

#[test]
fn p87_smoke_rises_with_the_mean_wind_where_flames_have_gone_out() {
    // Four flames are out in frame 23, 1 from the middle on four rays: the mean of them is the middle.
    // Upward 0.02 x 1.5 a frame, and 0.02 x 3 x 0.2 with the wind.
    let flames = "drop_distance = 0.99\nmax_flames = 4\n[fire.spread.smoke]\nsize = 0.5\ngrowth = 1\n\
                  frames = 32\nopacity = 0.8\ncolor = [0, 0, 0]\nmax_puffs = 4\n\
                  [[fire.spread.ignition]]\nposition = [0, 0, 0]\npoints = 4\n\
                  [[wind]]\nkind = \"uniform\"\nvelocity = [0.2, 0, 0]";
    let fire = "lifetime = 3\nnoisiness = 0\nbuoyancy = 1.5\nwind_factor = 3";
    let mut run = run(&seen([0.0, 0.0, 5.0], [1.0; 3], fire, flames));
    let clear = picture(&mut run, 22);
    let mut whole = None;
    for age in [4u32, 10, 20] {
        let ([x, y], sum) = hidden(&clear, &picture(&mut run, 23 + age));
        assert_close(x, 0.6 * 0.02 * f64::from(age), 0.01);
        assert_close(y, 1.5 * 0.02 * f64::from(age), 0.01);
        // As opaque as is left of it: it is all there from an eighth of its time on.
        let all = sum / (1.0 - f64::from(age) / 32.0);
        assert_close(all / *whole.get_or_insert(all), 1.0, 0.03);
    }
}

#[test]
fn p87_smoke_widens_and_flames_that_burn_have_none() {
    let flames = |growth: f64| {
        format!(
            "drop_distance = 0.99\nmax_flames = 4\n[fire.spread.smoke]\nsize = 0.4\ngrowth = {growth}\n\
             frames = 40\nspeed = 0\nopacity = 0.5\ncolor = [0, 0, 0]\n{IGNITION}"
        )
    };
    let lost = |growth: f64| {
        let mut run = run(&seen(
            [0.0, 0.0, 5.0],
            [1.0; 3],
            "lifetime = 3",
            &flames(growth),
        ));
        let clear = picture(&mut run, 22);
        assert!(clear.iter().all(|pixel| *pixel == [255.0; 3]));
        hidden(&clear, &picture(&mut run, 43)).1
    };
    // Half way: twice as wide as 1, four times the area.
    assert_close(lost(3.0) / lost(1.0), 4.0, 0.5);
    // In the end nothing is left.
    let short = flames(3.0).replace("frames = 40", "frames = 12");
    let mut run = run(&seen([0.0, 0.0, 5.0], [1.0; 3], "lifetime = 3", &short));
    assert!(
        picture(&mut run, 34)
            .iter()
            .any(|pixel| *pixel != [255.0; 3])
    );
    assert!(
        picture(&mut run, 35)
            .iter()
            .all(|pixel| *pixel == [255.0; 3])
    );
}
