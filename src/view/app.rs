//! What the window shows: the picture, the run's transport, its counts and times, and a widget for
//! every knob, made from the scene's schema alone.

use std::path::PathBuf;
use std::time::Duration;

use egui::{Color32, RichText, Ui};

use super::detail::Detail;
use super::knobs::{Touched, Turned, knob};
use super::orbit::Orbit;
use super::session::{Session, Told};
use crate::scene::Knob;

/// Frames between two counts of what lives: they wait for the device.
const COUNT_STEPS: u32 = 15;

/// The knobs that a fire is played with before all others, and what they are called in the window (Perry
/// 1994, Table 3.1).
const OF_FIRES: [(&str, &str); 8] = [
    ("spread.time_scale", "time scale K"),
    ("spread.drop_distance", "drop distance d_d"),
    ("spread.separation", "separation d_s"),
    ("inverse_cohesion", "inverse cohesion k_p"),
    ("noisiness", "noisiness C"),
    ("sampling", "sampling k_s"),
    ("spread.curvature_distance", "curvature distance d_t"),
    ("lifetime", "lifetime l_f"),
];

/// The window's state.
pub struct App {
    /// What is played with.
    pub session: Session,
    /// What went wrong last, until something goes right; or what was done.
    pub message: Option<(Told, bool)>,
    /// The picture's texture; none where it could not be made.
    pub picture: Option<egui::TextureId>,
    /// Whether the picture is older than what it is to show.
    pub is_stale: bool,
    filter: String,
    frame_slot: Slot,
    seed_slot: Slot,
    save_path: String,
    counts: String,
    counted_at: Option<u32>,
    /// The run that was counted last, by how many there were before it.
    counted_run: u32,
    /// What found no room since the run began: births, systems' systems, control points, flames.
    roomless: [u64; 4],
    /// A file that was there when somebody saved to it: the next time it is written over.
    may_replace: Option<String>,
    adapter: String,
}

/// A number that somebody writes or drags, which counts when they are done with it.
#[derive(Default)]
struct Slot {
    /// The number when they began, and now.
    draft: Option<[u64; 2]>,
}

impl Slot {
    /// Shows the number; the other one that somebody wants instead.
    fn show(&mut self, ui: &mut Ui, now: u64, prefix: &str, most: u64) -> Option<u64> {
        let [begun, mut value] = self.draft.unwrap_or([now; 2]);
        let slot = egui::DragValue::new(&mut value)
            .prefix(prefix)
            .range(0..=most)
            .update_while_editing(false);
        let response = ui.add(slot);
        if response.drag_stopped() || response.lost_focus() {
            self.draft = None;
            return (value != begun).then_some(value);
        }
        let is_held = response.dragged() || response.has_focus();
        self.draft = is_held.then_some([begun, value]);
        None
    }
}

impl App {
    /// Shows this session.
    pub fn new(mut session: Session) -> Self {
        let adapter = session.simulation().adapter_name();
        let save_path = format!("{}-mine.toml", session.scene().name);
        Self {
            session,
            message: None,
            picture: None,
            is_stale: true,
            filter: String::new(),
            frame_slot: Slot::default(),
            seed_slot: Slot::default(),
            save_path,
            counts: String::new(),
            counted_at: None,
            counted_run: 0,
            roomless: [0; 4],
            may_replace: None,
            adapter,
        }
    }

    /// Lets time pass; what has to be drawn anew is drawn by who has the texture.
    pub fn pass(&mut self, passed: Duration) {
        match self.session.advance(passed) {
            Ok(stepped) => self.is_stale |= stepped,
            Err(told) => {
                self.session.playing = false;
                self.message = Some((told, true));
            }
        }
        self.count();
    }

    /// Notes the outcome of something that was asked for.
    fn did<T>(&mut self, outcome: Result<T, Told>, done: impl FnOnce(T) -> Option<String>) {
        self.is_stale = true;
        self.message = match outcome {
            Ok(value) => done(value).map(|text| (text, false)),
            Err(told) => Some((told, true)),
        };
    }

    /// Reads the scene's files again and begins anew at the same frame, if they are right.
    pub(super) fn reload(&mut self) {
        let outcome = self.session.read_again();
        self.did(outcome, |left_out| {
            let what = match left_out.as_slice() {
                [] => "read the scene again".to_owned(),
                keys => format!(
                    "read the scene again; what was turned of these does not fit it any more: {}",
                    keys.join(", ")
                ),
            };
            Some(what)
        });
    }

    fn count(&mut self) {
        let frame = self.session.frame();
        if self.counted_run != self.session.began() {
            (self.counted_run, self.counted_at) = (self.session.began(), None);
        }
        let is_due = self
            .counted_at
            .is_none_or(|at| frame < at || frame >= at + COUNT_STEPS);
        if !is_due && self.session.playing || self.counted_at == Some(frame) {
            return;
        }
        let simulation = self.session.simulation();
        let plan = simulation.plan();
        let [.., burning] = plan.flames_at(frame.cast_signed());
        let boids = plan.boid_count;
        // Fires that spread without flames ask for no room.
        let takes_flames = plan.dropped_capacity > 0;
        let Ok(lines) = simulation.take_statistics() else {
            return;
        };
        let Some(last) = lines.last() else {
            return;
        };
        if self.counted_at.is_none() {
            self.roomless = [0; 4];
        }
        self.counted_at = Some(frame);
        for line in &lines {
            for (sum, lost) in self.roomless.iter_mut().zip(line.roomless()) {
                *sum += u64::from(lost);
            }
            if !takes_flames {
                self.roomless[3] = 0;
            }
        }
        let some = |count: u32, name: &str| (count > 0).then(|| format!("{count} {name}"));
        let parts = [
            some(last.live, "particles"),
            some(last.systems_live, "systems"),
            some(boids, "boids"),
            some(burning + last.flames_live, "flames"),
            some(last.points_live, "points of fronts"),
            some(last.marks_live, "marks"),
        ];
        self.counts = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
    }

    /// What found no room, and which key gives more, in words.
    fn told_roomless(&self) -> Option<String> {
        let kinds = [
            "births (capacity)",
            "systems (max_systems)",
            "points of fronts (max_points)",
            "flames (max_flames)",
        ];
        let parts = self.roomless.iter().zip(kinds);
        let parts = parts.filter(|(count, _)| **count > 0);
        let parts: Vec<String> = parts
            .map(|(count, kind)| format!("{count} {kind}"))
            .collect();
        (!parts.is_empty()).then(|| format!("no room for {}", parts.join(", ")))
    }

    /// Writes the scene and what was done; over what is there only if somebody asks twice.
    fn save(&mut self) {
        let path = PathBuf::from(&self.save_path);
        let there = [path.clone(), path.with_extension("inputs")];
        let there = there.into_iter().find(|path| path.exists());
        if let Some(there) = there
            && self.may_replace.as_ref() != Some(&self.save_path)
        {
            self.may_replace = Some(self.save_path.clone());
            let told = format!(
                "{} is there: save once more to write over it",
                there.display()
            );
            self.message = Some((told, true));
            return;
        }
        let outcome = self.session.save_as(&path);
        let outcome = outcome.map_err(|error| error.to_string());
        self.may_replace = None;
        self.did(outcome, |inputs| {
            Some(format!("wrote {} and {}", path.display(), inputs.display()))
        });
    }

    /// One pass of the whole window.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.keys(ui);
        egui::Panel::bottom("transport").show(ui, |ui| self.transport(ui));
        egui::Panel::left("knobs")
            .default_size(330.0)
            .show(ui, |ui| self.side(ui));
        egui::CentralPanel::default()
            .frame(egui::Frame::NONE.fill(Color32::BLACK))
            .show(ui, |ui| self.picture(ui));
    }

    fn keys(&mut self, ui: &Ui) {
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let (space, right, home, undo, escape) = ui.input(|input| {
            let pressed = |key| input.key_pressed(key);
            (
                pressed(egui::Key::Space),
                pressed(egui::Key::ArrowRight),
                pressed(egui::Key::Home),
                input.modifiers.command && pressed(egui::Key::Z),
                pressed(egui::Key::Escape),
            )
        });
        if space {
            self.session.playing = !self.session.playing;
        }
        if right {
            self.step();
        }
        if home {
            self.restart(0);
        }
        if undo {
            self.undo();
        }
        if escape {
            self.session.stay();
        }
    }

    fn step(&mut self) {
        self.session.playing = false;
        let outcome = self.session.step();
        self.did(outcome, |()| None);
    }

    fn restart(&mut self, frame: u32) {
        let outcome = self.session.go_to(frame);
        self.did(outcome, |()| None);
    }

    fn undo(&mut self) {
        let outcome = self.session.undo();
        self.did(outcome, |some| {
            (!some).then(|| "nothing was turned".to_owned())
        });
    }

    fn transport(&mut self, ui: &mut Ui) {
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let word = if self.session.playing {
                "Pause"
            } else {
                "Play"
            };
            if ui.button(word).on_hover_text("space").clicked() {
                self.session.playing = !self.session.playing;
            }
            if ui.button("Step").on_hover_text("arrow right").clicked() {
                self.step();
            }
            if ui.button("Restart").on_hover_text("home").clicked() {
                self.restart(0);
            }
            let frame = self.session.frame().into();
            let wanted = self.frame_slot.show(ui, frame, "frame ", 1_000_000);
            if let Some(frame) = wanted.and_then(|frame| u32::try_from(frame).ok()) {
                self.restart(frame);
            }
            let speed = egui::Slider::new(&mut self.session.speed, 0.1..=4.0);
            ui.add(speed.logarithmic(true).text("speed"));
            let seed = self.session.scene().seed;
            if let Some(seed) = self.seed_slot.show(ui, seed, "seed ", i64::MAX as u64) {
                let outcome = self.session.reseed(seed);
                self.did(outcome, |()| None);
            }
            if ui
                .button("Own view")
                .on_hover_text("the scene's camera")
                .clicked()
            {
                self.session.orbit = Orbit::STILL;
                self.is_stale = true;
            }
        });
        if let Some((to, at)) = self.session.on_the_way() {
            ui.horizontal(|ui| {
                let share = at as f32 / to.max(1) as f32;
                let told = format!("on the way to frame {to}: {at}");
                ui.add(
                    egui::ProgressBar::new(share)
                        .text(told)
                        .desired_width(360.0),
                );
                if ui.button("Stay").on_hover_text("escape").clicked() {
                    self.session.stay();
                }
            });
        }
        if let Some(hint) = self.session.touch_hint() {
            ui.label(RichText::new(hint).weak());
        }
        let upcoming = self.session.upcoming();
        if upcoming > 0 {
            let hint = format!("{upcoming} changes are to come, unless something is turned before");
            ui.label(RichText::new(hint).weak());
        }
        if let Some((text, is_error)) = &self.message {
            let color = if *is_error {
                Color32::LIGHT_RED
            } else {
                Color32::LIGHT_GREEN
            };
            ui.label(RichText::new(text).monospace().color(color));
        }
        ui.add_space(4.0);
    }

    /// How much is drawn: by hand, or as much as keeps up with so many frames a second.
    fn detail(&mut self, ui: &mut Ui) {
        let mut wanted = self.session.detail();
        ui.add_enabled_ui(self.session.can_be_coarse(), |ui| {
            let shown = egui::ComboBox::from_label("detail").selected_text(wanted.name());
            shown.show_ui(ui, |ui| {
                for level in Detail::LEVELS.map(|level| level.with_lines(wanted.flame_lines)) {
                    ui.selectable_value(&mut wanted, level, level.name());
                }
            });
            let mut lines = wanted.flame_lines;
            if !self.session.scene().fires.is_empty() {
                ui.checkbox(&mut lines, "flames as lines");
            }
            wanted = wanted.with_lines(lines);
            let least_rate = &mut self.session.pace.least_rate;
            let mut keeps_up = least_rate.is_some();
            let mut rate = least_rate.unwrap_or(20.0);
            ui.horizontal(|ui| {
                ui.checkbox(&mut keeps_up, "less, to keep up with");
                let slot = egui::DragValue::new(&mut rate).range(1.0..=120.0);
                ui.add(slot.suffix(" frames a second"));
            });
            *least_rate = keeps_up.then_some(rate);
        });
        if wanted != self.session.detail() {
            let outcome = self.session.set_detail(wanted);
            self.did(outcome, |()| None);
        }
    }

    fn side(&mut self, ui: &mut Ui) {
        ui.heading(self.session.scene().title.clone());
        ui.label(RichText::new(&self.adapter).weak());
        ui.label(&self.counts);
        if let Some(told) = self.told_roomless() {
            ui.label(RichText::new(told).color(Color32::YELLOW));
        }
        self.plot(ui);
        self.detail(ui);
        ui.horizontal(|ui| {
            if ui.button("Undo").on_hover_text("ctrl-z").clicked() {
                self.undo();
            }
            ui.text_edit_singleline(&mut self.save_path);
            if ui.button("Save as").clicked() {
                self.save();
            }
        });
        ui.horizontal(|ui| {
            ui.label("find");
            ui.text_edit_singleline(&mut self.filter);
        });
        ui.separator();
        egui::ScrollArea::vertical().show(ui, |ui| self.knobs(ui));
    }

    fn knobs(&mut self, ui: &mut Ui) {
        let mut touched = Touched::default();
        let mut is_passed_on = false;
        let all = self.session.knobs();
        let mut show = |ui: &mut Ui, one: &Knob, label: &str| {
            let done = knob(ui, one, label, &self.start_of(one));
            is_passed_on |= done.is_taken && !done.is_let_go;
            touched.is_taken |= done.is_taken;
            touched.is_let_go |= done.is_let_go;
            touched.turned = touched.turned.take().or(done.turned);
        };
        let is_found = |one: &&Knob| one.path.contains(&self.filter);
        for fire in &self.session.scene().fires {
            let of = |(key, label)| {
                let path = format!("fire.{}.{key}", fire.name);
                let own = all.iter().find(|one| one.path == path);
                own.filter(is_found).map(|one| (one, label))
            };
            let shown: Vec<_> = OF_FIRES.into_iter().filter_map(of).collect();
            if shown.is_empty() {
                continue;
            }
            egui::CollapsingHeader::new(format!("how {} burns", fire.name))
                .id_salt(("how it burns", &fire.name))
                .default_open(true)
                .show(ui, |ui| {
                    for (one, label) in shown {
                        show(ui, one, label);
                    }
                });
        }
        let rest: Vec<&Knob> = all.iter().filter(|one| !is_first(&one.path)).collect();
        for own in rest.chunk_by(|a, b| group_of(&a.path) == group_of(&b.path)) {
            let group = group_of(&own[0].path);
            let shown: Vec<&Knob> = own.iter().copied().filter(is_found).collect();
            if shown.is_empty() {
                continue;
            }
            let title = if group.is_empty() { "scene" } else { group };
            egui::CollapsingHeader::new(title)
                .id_salt(group)
                .open((!self.filter.is_empty()).then_some(true))
                .show(ui, |ui| {
                    for one in shown {
                        show(ui, one, one.path[group.len()..].trim_start_matches('.'));
                    }
                });
        }
        if touched.is_taken {
            self.session.take_hold();
        }
        match touched.turned {
            Some(Turned::To(path, value)) => {
                let outcome = self.session.turn(&path, &value);
                self.did(outcome, |()| None);
            }
            Some(Turned::Back(path)) => {
                let outcome = self.session.reset(&path);
                self.did(outcome, |()| None);
            }
            None => {}
        }
        // Whoever lets go of one to take hold of another in the same pass holds that.
        if touched.is_let_go && !is_passed_on {
            self.session.let_go();
        }
    }

    /// What a knob that nothing holds for begins with: what the scene computes in its place, if it does.
    fn start_of(&self, knob: &Knob) -> String {
        let computed = self.session.in_force(&knob.path);
        computed.unwrap_or_else(|| match knob.field.key {
            // It ends with the scene, not at once.
            "end_frame" => self
                .session
                .scene()
                .frames
                .max(self.session.frame() + 1)
                .to_string(),
            _ => knob.field.sample().to_owned(),
        })
    }

    /// Times of the last frames as bars, and the slowest kernels of the last one.
    fn plot(&self, ui: &mut Ui) {
        let history = &self.session.history;
        let size = egui::vec2(ui.available_width(), 36.0);
        let (area, _) = ui.allocate_exact_size(size, egui::Sense::hover());
        let painter = ui.painter_at(area);
        painter.rect_filled(area, 2.0, Color32::from_gray(24));
        let most = history.iter().copied().fold(1.0, f32::max);
        for (at, ms) in history.iter().rev().enumerate() {
            let x = area.right() - 1.5 * at as f32;
            let top = area.bottom() - area.height() * ms / most;
            painter.line_segment(
                [egui::pos2(x, area.bottom()), egui::pos2(x, top)],
                egui::Stroke::new(1.0, Color32::from_rgb(255, 150, 60)),
            );
        }
        let last = history.last().copied().unwrap_or(0.0);
        ui.label(format!("{last:.1} ms a frame, {most:.1} at most"));
        let mut kernels = self.session.times.clone();
        kernels.sort_by(|a, b| b.1.total_cmp(&a.1));
        for (name, ms) in kernels.iter().take(4) {
            ui.label(
                RichText::new(format!("{ms:7.2} ms  {name}"))
                    .monospace()
                    .small(),
            );
        }
    }

    fn picture(&mut self, ui: &mut Ui) {
        let Some(picture) = self.picture else {
            return;
        };
        let image = &self.session.scene().image;
        let (width, height) = (image.width as f32, image.height as f32);
        let room = ui.available_size();
        let scale = (room.x / width).min(room.y / height).max(0.01);
        let size = egui::vec2(width, height) * scale;
        let shown = egui::Image::new((picture, size)).sense(egui::Sense::click_and_drag());
        let area = egui::Rect::from_center_size(ui.available_rect_before_wrap().center(), size);
        let response = ui.put(area, shown);
        let is_away = response.secondary_clicked();
        if let Some(at) = response.interact_pointer_pos()
            && (response.clicked() || is_away)
        {
            let at = (at - area.min) / scale;
            self.session.let_go();
            let outcome = self.session.touch([at.x, at.y], is_away);
            self.did(outcome, |done| done);
        }
        let before = self.session.orbit;
        let moved = response.drag_delta() / size.y;
        let aside = response.dragged_by(egui::PointerButton::Middle)
            || ui.input(|input| input.modifiers.shift);
        match aside {
            true => self.session.orbit.shift(moved.x, -moved.y),
            false => self.session.orbit.turn(moved.x, moved.y),
        }
        if response.hovered() {
            let notches = ui.input(|input| input.smooth_scroll_delta().y) / 50.0;
            self.session.orbit.zoom(notches);
        }
        self.is_stale |= before != self.session.orbit;
    }
}

/// Whether the knob stands among those of a fire that come first.
fn is_first(path: &str) -> bool {
    let key = path.strip_prefix("fire.").and_then(|it| it.split_once('.'));
    key.is_some_and(|(_, key)| OF_FIRES.iter().any(|(of, _)| *of == key))
}

/// The part of a path that names what it is a key of: a table, and the table in an array.
fn group_of(path: &str) -> &str {
    let mut dots = path.match_indices('.').map(|(at, _)| at);
    match path.split('.').next() {
        Some("system" | "flock" | "fire" | "wind" | "layer" | "lamp") => {
            dots.nth(1).map_or(path, |end| &path[..end])
        }
        _ => dots.next().map_or("", |end| &path[..end]),
    }
}
