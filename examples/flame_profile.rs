//! Plots how the light of a candle's flame falls off from its middle: red, green and blue of the pixels of
//! one line of its picture, as figure 3-4 of Perry's thesis has them.
//!
//!     cargo run --example flame_profile -- profile.svg
//!
//! `MOTES_ADAPTER` says where: `cpu`, or part of an adapter's name. The plot is the same anywhere.

use std::fmt::Write;

use motes::{AdapterChoice, Options, Simulation};

/// Units of the plot, and those around its axes.
const SIZE: [f64; 2] = [640.0, 320.0];
const MARGIN: f64 = 40.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1);
    let path = path.unwrap_or_else(|| "flame-profile.svg".to_owned());
    // The flame alone, before black.
    let mut scene = motes::scene::load("candle")?;
    scene.pillars.clear();
    scene.ground = None;
    scene.image.background = [0.0; 3];
    let options = Options {
        adapter: AdapterChoice::from_env(),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options)?;
    println!("candle on {}", simulation.adapter_name());
    simulation.step()?;
    simulation.draw()?;
    let image = simulation.image()?;
    let lines = image.chunks(4 * scene.image.width as usize);
    let light = |line: &[u8]| line.iter().map(|byte| u32::from(*byte)).sum::<u32>();
    let brightest = lines.max_by_key(|line| light(line)).expect("it has lines");
    let pixels: Vec<[u8; 3]> = brightest
        .chunks(4)
        .map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .skip_while(|pixel| pixel[0] == 0)
        .collect();
    let wide = pixels.iter().rposition(|pixel| pixel[0] > 0).unwrap_or(0) + 1;
    std::fs::write(&path, plot(&pixels[..wide]))?;
    println!("{wide} pixels across, to {path}");
    Ok(())
}

/// Three curves over the pixels, and axes.
fn plot(pixels: &[[u8; 3]]) -> String {
    let [width, height] = SIZE;
    let (right, foot) = (width - MARGIN, height - MARGIN);
    let x = |at: usize| MARGIN + at as f64 * (right - MARGIN) / pixels.len().max(2) as f64;
    let y = |byte: u8| foot - f64::from(byte) * (foot - MARGIN) / 255.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" fill=\"none\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
         <path d=\"M{MARGIN},{MARGIN} V{foot} H{right}\" stroke=\"black\"/>\n"
    );
    for (channel, color) in ["red", "green", "blue"].into_iter().enumerate() {
        let points = pixels
            .iter()
            .enumerate()
            .fold(String::new(), |mut all, (at, pixel)| {
                // A String takes everything.
                let _ = write!(all, "{:.1},{:.1} ", x(at), y(pixel[channel]));
                all
            });
        let _ = writeln!(
            svg,
            "<polyline id=\"{color}\" points=\"{}\" stroke=\"{color}\"/>",
            points.trim_end()
        );
    }
    svg + "</svg>\n"
}
