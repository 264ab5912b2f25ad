//! A widget for a knob, whatever it is of.

use egui::{DragValue, RichText, Ui};

use crate::scene::schema::{Kind, Presence};
use crate::scene::{Knob, KnobValue};

/// What somebody did to a knob.
pub(super) enum Turned {
    /// Its path, and the value in TOML.
    To(String, String),
    /// Its path: back to what holds where a scene says nothing.
    Back(String),
}

/// Shows the knob; what was done to it.
pub(super) fn knob(ui: &mut Ui, knob: &Knob, label: &str) -> Option<Turned> {
    let text = match &knob.value {
        KnobValue::Written(value) | KnobValue::Default(value) => value.as_str(),
        KnobValue::None => "",
    };
    let to = |value: String| Some(Turned::To(knob.path.clone(), value));
    let mut turned = None;
    ui.horizontal(|ui| {
        let about = format!("{}\n{}\n{}", knob.path, knob.about, knob.right());
        let is_written = matches!(knob.value, KnobValue::Written(_));
        let name = if is_written {
            RichText::new(label)
        } else {
            RichText::new(label).weak()
        };
        let name = ui.label(name).on_hover_text(about);
        if let (true, Presence::Default(default)) = (is_written, knob.field.presence) {
            name.context_menu(|ui| {
                if ui.button(format!("default: {default}")).clicked() {
                    turned = Some(Turned::Back(knob.path.clone()));
                }
            });
        }
        if knob.has_keys {
            ui.label(RichText::new("keyed").weak());
            return;
        }
        let choices = knob.choices();
        let changed = match knob.field.kind {
            Kind::Flag => flag(ui, text),
            Kind::Numbers { limits, .. } => {
                numbers(ui, text, limits.min..=limits.max, knob.field.unit)
            }
            Kind::Whole { min, max } => whole(ui, text, min..=max, knob.field.unit),
            _ if !choices.is_empty() => choice(ui, &knob.path, text, &choices),
            _ => None,
        };
        if let Some(value) = changed {
            turned = to(value);
        }
    });
    turned
}

fn flag(ui: &mut Ui, text: &str) -> Option<String> {
    let mut on = text == "true";
    ui.checkbox(&mut on, "").changed().then(|| on.to_string())
}

fn whole(
    ui: &mut Ui,
    text: &str,
    range: std::ops::RangeInclusive<i64>,
    unit: &str,
) -> Option<String> {
    let mut value: i64 = text.replace('_', "").parse().unwrap_or(*range.start());
    let widget = DragValue::new(&mut value).range(range).suffix(suffix(unit));
    ui.add(widget).changed().then(|| value.to_string())
}

/// A number, or an array of them.
fn numbers(
    ui: &mut Ui,
    text: &str,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
) -> Option<String> {
    let inner = text.trim_start_matches('[').trim_end_matches(']');
    let mut values: Vec<f64> = inner
        .split(',')
        .filter_map(|part| part.trim().replace('_', "").parse().ok())
        .collect();
    if values.is_empty() {
        // Nothing holds yet.
        return ui.small_button("set").clicked().then(|| {
            let start = 0f64.clamp(*range.start(), *range.end());
            format!("{start:?}")
        });
    }
    let mut changed = false;
    for value in &mut values {
        // A hundredth of what it is, a pixel.
        let speed = (value.abs() * 0.01).max(0.001);
        let widget = DragValue::new(value)
            .range(range.clone())
            .speed(speed)
            .max_decimals(4);
        changed |= ui.add(widget).changed();
    }
    ui.label(RichText::new(unit).weak().small());
    let is_array = text.trim_start().starts_with('[');
    changed.then(|| {
        // What a scene holds has the precision of f32.
        let parts: Vec<String> = values
            .iter()
            .map(|it| format!("{:?}", *it as f32))
            .collect();
        match is_array {
            true => format!("[{}]", parts.join(", ")),
            false => parts.concat(),
        }
    })
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
