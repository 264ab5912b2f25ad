//! A script in place of a person: what is done at which pass of the window, without a window. For
//! tests, and for pictures of it.
//!
//! A line is `PASS ACTION …`, passes in order; `#` begins a comment, at the beginning of a line or after a
//! blank. A pass lasts as long as a frame of the scene.
//!
//! ```text
//! 0 turn system.jet.drag=0.1    a knob, as --set has it
//! 5 move 700 300                the pointer, in points from the window's corner
//! 5 press                       the pointer's button, and its release; `press right` for the other one
//! 6 move 800 300
//! 6 release
//! 9 wheel 2                     notches away from oneself
//! 9 key Space
//! 12 detail 2 lines             how much is drawn: 0 all, 4 the least; flames as lines
//! 20 undo
//! 24 frame 90                   begun again, and at that frame
//! 30 shot window.png            the window after this pass
//! 40 save mine.toml             the scene, and what was done beside it
//! 50 end                        else the script ends with its last line
//! ```

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::app::App;
use super::detail::Detail;
use super::error::WindowError;
use super::session::Told;
use super::stage::Stage;
use crate::output::{Rgba8Image, write_png};

/// The last pass that a script can have.
const MOST_PASS: u32 = 1_000_000;

/// One thing that is done.
#[derive(Clone, Debug, PartialEq)]
enum Action {
    Turn(String, String),
    Move(f32, f32),
    Button {
        button: egui::PointerButton,
        pressed: bool,
    },
    Wheel(f32),
    Key(egui::Key),
    Detail(Detail),
    Undo,
    Frame(u32),
    Shot(PathBuf),
    Save(PathBuf),
    End,
}

/// What is done, pass by pass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// Pass, line and what is done in it.
    actions: Vec<(u32, usize, Action)>,
    /// The file, for messages.
    file: String,
}

/// What is wrong with a script's text: what, and in which line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError(pub String);

impl std::fmt::Display for ScriptError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "error: {}\n  = help: a line is `PASS ACTION`: turn PATH=VALUE, move X Y, press [right], release [right], \
             wheel NOTCHES, key NAME, detail 0..4 [lines], undo, frame FRAME, shot FILE.png, save FILE.toml or end; passes in order; `#` \
             begins a comment",
            self.0
        )
    }
}

impl std::error::Error for ScriptError {}

impl Script {
    /// Reads a script; `file` is for messages.
    ///
    /// # Errors
    /// A line that is none, or passes out of order.
    pub fn parse(text: &str, file: &str) -> Result<Self, ScriptError> {
        let mut actions: Vec<(u32, usize, Action)> = Vec::new();
        for (number, line) in (1..).zip(text.lines()) {
            let line = without_comment(line).trim();
            if line.is_empty() {
                continue;
            }
            let wrong = |what: &str| ScriptError(format!("{file}:{number}: {what}: `{line}`"));
            let (pass, rest) = line.split_once(' ').ok_or_else(|| wrong("no action"))?;
            let pass: u32 = pass.parse().map_err(|_| wrong("no pass"))?;
            if pass > MOST_PASS {
                return Err(wrong("a pass after 1,000,000"));
            }
            if actions.last().is_some_and(|(last, ..)| pass < *last) {
                return Err(wrong("an earlier pass than the line before"));
            }
            let action = action(rest.trim()).ok_or_else(|| wrong("no action"))?;
            actions.push((pass, number, action));
        }
        let file = file.to_owned();
        Ok(Self { actions, file })
    }

    /// What a line of it brought about.
    fn placed(&self, line: usize, told: &str) -> Told {
        let told = told.trim_start_matches("error: ");
        format!("error: {}:{line}: {told}", self.file)
    }

    /// One past the last pass.
    fn end(&self) -> u32 {
        self.actions.last().map_or(0, |(pass, ..)| pass + 1)
    }
}

fn without_comment(line: &str) -> &str {
    let mut marks = line.match_indices('#').map(|(at, _)| at);
    let begin = marks.find(|at| {
        line[..*at]
            .chars()
            .next_back()
            .is_none_or(char::is_whitespace)
    });
    &line[..begin.unwrap_or(line.len())]
}

fn action(text: &str) -> Option<Action> {
    let (word, rest) = text.split_once(' ').unwrap_or((text, ""));
    let rest = rest.trim();
    let number = |text: &str| text.parse::<f32>().ok().filter(|it| it.is_finite());
    let file = |ending: &str| rest.ends_with(ending).then(|| PathBuf::from(rest));
    match word {
        "turn" => {
            let (path, value) = rest.split_once('=')?;
            Some(Action::Turn(
                path.trim().to_owned(),
                value.trim().to_owned(),
            ))
        }
        "move" => {
            let (x, y) = rest.split_once(' ')?;
            Some(Action::Move(number(x)?, number(y.trim())?))
        }
        "wheel" => Some(Action::Wheel(number(rest)?)),
        "frame" => rest
            .parse()
            .ok()
            .filter(|at| *at <= MOST_PASS)
            .map(Action::Frame),
        "key" => egui::Key::from_name(rest).map(Action::Key),
        "detail" => {
            let (level, lines) = match rest.split_once(' ') {
                Some((level, rest)) if rest.trim() == "lines" => (level, true),
                Some(_) => return None,
                None => (rest, false),
            };
            let level = Detail::LEVELS.get(level.parse::<usize>().ok()?)?;
            Some(Action::Detail(level.with_lines(lines)))
        }
        "shot" => file(".png").map(Action::Shot),
        "save" => file(".toml").map(Action::Save),
        "press" | "release" => {
            let button = match rest {
                "" => egui::PointerButton::Primary,
                "right" => egui::PointerButton::Secondary,
                _ => return None,
            };
            let pressed = word == "press";
            Some(Action::Button { button, pressed })
        }
        _ if !rest.is_empty() => None,
        "undo" => Some(Action::Undo),
        "end" => Some(Action::End),
        _ => None,
    }
}

/// Plays the script on the device that the scene runs on, in a window of that size that nobody sees.
///
/// # Errors
/// What was done does not work, or the machine fails; the first such thing ends it.
pub fn play(
    app: &mut App,
    script: &Script,
    (device, queue): (wgpu::Device, wgpu::Queue),
    size_px: [u32; 2],
) -> Result<(), WindowError> {
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let [width, height] = size_px;
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("window"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = target.create_view(&Default::default());
    let mut stage = Stage::new(device, queue, format);
    let ctx = egui::Context::default();
    let frame = Duration::from_secs_f64(1.0 / f64::from(app.session.scene().frame_rate));
    let mut pointer = egui::Pos2::ZERO;
    for pass in 0..script.end() {
        let now = script.actions.iter().filter(|(at, ..)| *at == pass);
        let mut events = Vec::new();
        let mut after = Vec::new();
        let mut touched = None;
        for (_, line, action) in now {
            let known = events.len();
            let scene = |told: Told| WindowError::Scene(script.placed(*line, &told));
            match action {
                Action::Turn(path, value) => app.session.turn(path, value).map_err(scene)?,
                Action::Detail(detail) => {
                    app.session.set_detail(*detail).map_err(scene)?;
                    app.is_stale = true;
                }
                Action::Undo => drop(app.session.undo().map_err(scene)?),
                Action::Frame(frame) => {
                    app.session.restart(*frame).map_err(scene)?;
                    app.is_stale = true;
                }
                Action::Move(x, y) => {
                    pointer = egui::pos2(*x, *y);
                    events.push(egui::Event::PointerMoved(pointer));
                }
                Action::Button { button, pressed } => events.push(egui::Event::PointerButton {
                    pos: pointer,
                    button: *button,
                    pressed: *pressed,
                    modifiers: egui::Modifiers::NONE,
                }),
                Action::Wheel(notches) => events.push(egui::Event::MouseWheel {
                    unit: egui::MouseWheelUnit::Point,
                    delta: egui::vec2(0.0, 50.0 * notches),
                    phase: egui::TouchPhase::Move,
                    source: egui::MouseWheelSource::Wheel,
                    modifiers: egui::Modifiers::NONE,
                }),
                Action::Key(key) => events.extend([true, false].map(|pressed| egui::Event::Key {
                    key: *key,
                    physical_key: None,
                    pressed,
                    repeat: false,
                    modifiers: egui::Modifiers::NONE,
                })),
                Action::Shot(_) | Action::Save(_) | Action::End => after.push((*line, action)),
            }
            if events.len() > known {
                touched = Some(*line);
            }
        }
        app.pass(frame);
        if let Some((told, true)) = &app.message {
            return Err(WindowError::Scene(told.clone()));
        }
        let size = egui::vec2(width as f32, height as f32);
        let input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size)),
            time: Some(f64::from(pass) * frame.as_secs_f64()),
            events,
            focused: true,
            ..Default::default()
        };
        stage.refresh(app);
        let mut output = ctx.run_ui(input, |ui| app.ui(ui));
        stage.take_textures(&mut output);
        stage.refresh(app);
        stage.paint(&ctx, output, &view, size_px);
        stage.faults.check()?;
        for (line, action) in after {
            let placed = |error: WindowError| match error {
                WindowError::Scene(told) => WindowError::Scene(script.placed(line, &told)),
                other => other,
            };
            match action {
                Action::Shot(path) => shoot(&stage, &target, path)?,
                Action::Save(path) => drop(app.session.save_as(path).map_err(placed)?),
                _ => return Ok(()),
            }
        }
        if let Some((told, true)) = &app.message {
            // The pointer and keys bring it about, if any was used now.
            let told = touched.map_or_else(|| told.clone(), |line| script.placed(line, told));
            return Err(WindowError::Scene(told));
        }
    }
    Ok(())
}

/// Writes what the window shows.
fn shoot(stage: &Stage, target: &wgpu::Texture, path: &Path) -> Result<(), WindowError> {
    let machine = |error: &dyn std::fmt::Display| WindowError::Machine(error.to_string());
    let (width, height) = (target.width(), target.height());
    // Rows of copies are whole multiples of 256 bytes.
    let stride = (width * 4).next_multiple_of(256);
    let buffer = stage.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("shot"),
        size: u64::from(stride) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = stage.device.create_command_encoder(&Default::default());
    let into = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout: wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(stride),
            rows_per_image: None,
        },
    };
    encoder.copy_texture_to_buffer(target.as_image_copy(), into, target.size());
    stage.queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    let waited = stage.device.poll(wgpu::PollType::wait_indefinitely());
    waited.map_err(|error| machine(&error))?;
    let rows = buffer.slice(..).get_mapped_range();
    let rows = rows.map_err(|error| machine(&error))?.to_vec();
    let own = (width * 4) as usize;
    let mut pixels: Vec<u8> = rows
        .chunks(stride as usize)
        .flat_map(|row| row[..own].iter().copied())
        .collect();
    // What is behind the window is not to be seen through it.
    pixels
        .iter_mut()
        .skip(3)
        .step_by(4)
        .for_each(|alpha| *alpha = 255);
    let image = Rgba8Image {
        width,
        height,
        pixels,
    };
    write_png(path, &image).map_err(WindowError::Output)
}
