//! A widget for a knob, whatever it is of.

use std::ops::RangeInclusive;

use egui::{DragValue, Id, Response, RichText, Ui, UiBuilder};

use crate::scene::schema::{Kind, Presence};
use crate::scene::{Knob, KnobValue};

/// What somebody did to a knob.
pub(super) enum Turned {
    /// Its path, and the value in TOML.
    To(String, String),
    /// Its path: back to what holds where a scene says nothing.
    Back(String),
}

/// What happened at a knob in a pass.
#[derive(Default)]
pub(super) struct Touched {
    /// What was done.
    pub(super) turned: Option<Turned>,
    /// Whether somebody took hold of it.
    pub(super) is_taken: bool,
    /// Whether it was let go, after what was done.
    pub(super) is_let_go: bool,
}

impl Touched {
    /// Done at once.
    fn once(turned: Turned) -> Self {
        Self {
            turned: Some(turned),
            is_taken: true,
            is_let_go: true,
        }
    }

    /// As a slot that is dragged or written into tells.
    fn held(response: &Response) -> Self {
        Self {
            turned: None,
            is_taken: response.drag_started() || response.gained_focus(),
            is_let_go: response.drag_stopped() || response.lost_focus(),
        }
    }
}

/// Keys that hold for a whole run, by how their paths begin and end; no turn of them is taken while it is
/// under way.
const FIXED: [(&str, &str); 21] = [
    ("frames", ""),
    ("frame_rate", ""),
    ("steady_particles", ""),
    ("seed", ""),
    ("capacity", ""),
    ("max_systems", ""),
    ("image.width", ""),
    ("image.height", ""),
    ("light.shadow_cells", ""),
    ("system.", ".blend"),
    ("system.", ".stroke_pieces"),
    ("flock.", ".count"),
    ("flock.", ".trail_frames"),
    ("fire.", ".roots.count"),
    ("fire.", ".spread.scale"),
    ("fire.", ".spread.max_points"),
    ("fire.", ".spread.max_flames"),
    ("fire.", ".spread.catch_points"),
    ("fire.", ".char.max_marks"),
    ("fire.", ".smoke.max_puffs"),
    ("surface.", ".crease_degrees"),
];

/// Whether the knob, as it is, holds for a whole run.
pub(super) fn is_fixed(knob: &Knob) -> bool {
    let path = knob.path.as_str();
    let is_it = |(begin, end): &(&str, &str)| match *end {
        "" => path == *begin,
        end => path.starts_with(begin) && path.ends_with(end),
    };
    let text = match &knob.value {
        KnobValue::Written(text) | KnobValue::Default(text) => text.as_str(),
        KnobValue::None => "",
    };
    // A stroke stays one, and gets no shadow if it began without.
    let is_stroke = match knob.field.key {
        "particle_shape" => text == "\"stroke\"",
        "stroke_shadow" => is_same(text, "0"),
        _ => false,
    };
    // Clouds have places for shadows from the beginning, or none.
    let is_unlit = path == "light.shadow_radius" && text.is_empty();
    is_stroke || is_unlit || FIXED.iter().any(is_it)
}

/// Shows the knob; what was done to it. `start` is what it would be set to where nothing is.
pub(super) fn knob(ui: &mut Ui, knob: &Knob, label: &str, start: &str) -> Touched {
    // Of its own, whatever comes and goes before it: else it would slip from the hand.
    let own = UiBuilder::new().scope_id(Id::unique(("knob", &knob.path)));
    ui.scope_builder(own, |ui| {
        ui.horizontal(|ui| row(ui, knob, label, start)).inner
    })
    .inner
}

fn row(ui: &mut Ui, knob: &Knob, label: &str, start: &str) -> Touched {
    let text = match &knob.value {
        KnobValue::Written(value) | KnobValue::Default(value) => value.as_str(),
        KnobValue::None => "",
    };
    let about = format!("{}\n{}\n{}", knob.path, knob.about, knob.right());
    let is_written = matches!(knob.value, KnobValue::Written(_));
    let name = if is_written {
        RichText::new(label)
    } else {
        RichText::new(label).weak()
    };
    ui.label(name).on_hover_text(about);
    if is_fixed(knob) {
        let shown = if text.is_empty() { "not set" } else { text };
        let shown = ui.label(RichText::new(format!("{shown} {}", knob.field.unit)).monospace());
        ui.label(RichText::new("for a whole run").weak().small());
        shown.on_hover_text("it holds for a whole run: set it in the scene, or with --set");
        return Touched::default();
    }
    let touched = value(ui, knob, text, start);
    // After the value, which stays where it is under the hand.
    let back = match knob.field.presence {
        Presence::Default(default) => {
            (!is_same(text, default)).then(|| format!("default: {default}"))
        }
        // Clouds that throw shadows throw them as long as the run lasts.
        Presence::Optional(_) if knob.path == "light.shadow_radius" => None,
        Presence::Optional(_) => Some("as if the scene did not say it".to_owned()),
        Presence::Required(_) => None,
    };
    if let Some(hint) = back.filter(|_| is_written)
        && ui.small_button("reset").on_hover_text(hint).clicked()
    {
        return Touched::once(Turned::Back(knob.path.clone()));
    }
    touched
}

/// Shows the value of a knob that can be turned; what was done to it.
fn value(ui: &mut Ui, knob: &Knob, text: &str, start: &str) -> Touched {
    let to = |value: String| Turned::To(knob.path.clone(), value);
    if knob.has_keys {
        let keyed = format!("keyed: {} keys", keys_of(text));
        ui.label(RichText::new(keyed).weak()).on_hover_text(text);
        return Touched::default();
    }
    if text.is_empty() {
        ui.label(RichText::new("not set").weak());
        return match ui.small_button("set").on_hover_text(start).clicked() {
            true => Touched::once(to(start.to_owned())),
            false => Touched::default(),
        };
    }
    let mut choices = knob.choices();
    if knob.field.key == "particle_shape" {
        choices.retain(|word| *word != "stroke");
    }
    let once = |changed: Option<String>| {
        let turned = changed.map(|value| Touched::once(to(value)));
        turned.unwrap_or_default()
    };
    let held = |(changed, touched): (Option<String>, Touched)| Touched {
        turned: changed.map(to),
        ..touched
    };
    match knob.field.kind {
        Kind::Flag => once(flag(ui, text)),
        Kind::Numbers { limits, .. } => {
            let sample = knob.field.sample();
            held(numbers(
                ui,
                text,
                limits.min..=limits.max,
                sample,
                knob.field.unit,
            ))
        }
        Kind::Whole { min, max } => held(whole(ui, text, min..=max, knob.field.unit)),
        _ if !choices.is_empty() => once(choice(ui, &knob.path, text, &choices)),
        _ => {
            ui.label(RichText::new(text).weak());
            Touched::default()
        }
    }
}

/// The numbers of a TOML number or array of them; fewer if something else is among them.
fn numbers_of(text: &str) -> Vec<f64> {
    let inner = text.trim().trim_start_matches('[').trim_end_matches(']');
    let parts = inner.split(',');
    parts
        .filter_map(|part| part.trim().replace('_', "").parse().ok())
        .collect()
}

/// Whether both say the same.
fn is_same(text: &str, other: &str) -> bool {
    let [own, others] = [text, other].map(numbers_of);
    text == other || !own.is_empty() && own == others
}

/// How many keys a value over frames has: the pairs in the array.
fn keys_of(text: &str) -> usize {
    let mut depth = 0;
    let mut count = 0;
    for letter in text.chars() {
        match letter {
            '[' => {
                depth += 1;
                count += usize::from(depth == 2);
            }
            ']' => depth -= 1,
            _ => {}
        }
    }
    count
}

fn flag(ui: &mut Ui, text: &str) -> Option<String> {
    let mut on = text == "true";
    ui.checkbox(&mut on, "").changed().then(|| on.to_string())
}

fn whole(
    ui: &mut Ui,
    text: &str,
    range: RangeInclusive<i64>,
    unit: &str,
) -> (Option<String>, Touched) {
    let Ok(mut value) = text.replace('_', "").parse::<i64>() else {
        ui.label(text);
        return (None, Touched::default());
    };
    let widget = DragValue::new(&mut value).range(range).suffix(suffix(unit));
    let response = ui.add(widget.update_while_editing(false));
    let changed = response.changed().then(|| value.to_string());
    (changed, Touched::held(&response))
}

/// A number, or an array of them.
fn numbers(
    ui: &mut Ui,
    text: &str,
    range: RangeInclusive<f64>,
    sample: &str,
    unit: &str,
) -> (Option<String>, Touched) {
    let mut values = numbers_of(text);
    let mut touched = Touched::default();
    let mut changed = false;
    // A hundredth of what it is, a pixel; near 0, of what it may be elsewhere.
    let usual = numbers_of(sample).into_iter().map(f64::abs);
    let usual = usual.filter(|it| *it > 0.0).fold(0.1, f64::min);
    for value in &mut values {
        let before = *value as f32;
        let widget = DragValue::new(value)
            .range(range.clone())
            .speed(0.01 * before.abs().max(usual as f32))
            .custom_formatter(|value, _| shown(value))
            .update_while_editing(false);
        let response = ui.add(widget);
        // What a scene holds has the precision of f32.
        changed |= response.changed() && *value as f32 != before;
        let held = Touched::held(&response);
        touched.is_taken |= held.is_taken;
        touched.is_let_go |= held.is_let_go;
    }
    ui.label(RichText::new(unit).weak().small());
    let is_array = text.trim_start().starts_with('[');
    let changed = changed.then(|| {
        let parts: Vec<String> = values
            .iter()
            .map(|it| format!("{:?}", *it as f32))
            .collect();
        match is_array {
            true => format!("[{}]", parts.join(", ")),
            false => parts.concat(),
        }
    });
    (changed, touched)
}

/// As many digits as it takes, whatever its magnitude.
fn shown(value: f64) -> String {
    let value = value as f32;
    match value.abs() {
        size if size == 0.0 || (1e-4..1e7).contains(&size) => value.to_string(),
        _ => format!("{value:e}"),
    }
}

fn choice(ui: &mut Ui, path: &str, text: &str, choices: &[&str]) -> Option<String> {
    let now = text.trim_matches('"');
    let mut chosen = now;
    egui::ComboBox::from_id_salt(path)
        .selected_text(now)
        .show_ui(ui, |ui| {
            for one in choices {
                ui.selectable_value(&mut chosen, one, *one);
            }
        });
    (chosen != now).then(|| format!("\"{chosen}\""))
}

fn suffix(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}
