//! The results of a check as JSON.

use super::super::adapters::quoted;
use super::{Checked, Report};
use crate::check::{Difference, Element, Outcome, Place};

/// One object; digests and words are text in hexadecimal.
pub(super) fn json(report: &Report) -> String {
    let scenes: Vec<String> = report.scenes.iter().map(scene).collect();
    format!(
        "{{\n  \"schema\": 1,\n  \"adapter\": {},\n  \"driver\": {},\n  \"against\": {},\n  \
         \"against_driver\": {},\n  \"equal\": {},\n  \"scenes\": [\n{}\n  ]\n}}\n",
        quoted(report.tested.name()),
        quoted(&report.tested.driver()),
        quoted(report.against.name()),
        quoted(&report.against.driver()),
        report.is_equal(),
        scenes.join(",\n")
    )
}

fn scene(checked: &Checked) -> String {
    let head = format!(
        "    {{\"scene\": {}, \"duration_secs\": {:.3}",
        quoted(&checked.scene),
        checked.duration_secs
    );
    match &checked.outcome {
        Err(message) => format!("{head}, \"error\": {}}}", quoted(message)),
        Ok(outcome) => format!("{head}, {}}}", outcome_keys(outcome, checked)),
    }
}

fn outcome_keys(outcome: &Outcome, checked: &Checked) -> String {
    let Outcome {
        frames,
        most_particles,
        dropped,
        state_digest,
        image_digest,
        ..
    } = outcome;
    let difference = match &outcome.difference {
        None => "null".to_owned(),
        Some(difference) => object(difference, checked),
    };
    format!(
        "\"frames\": {frames}, \"most_particles\": {most_particles}, \"dropped\": {dropped}, \
         \"state_digest\": \"{state_digest:016x}\", \"image_digest\": \"{image_digest:016x}\", \
         \"equal\": {}, \"difference\": {difference}",
        outcome.is_equal()
    )
}

fn object(difference: &Difference, checked: &Checked) -> String {
    let place = difference.place.as_ref().map_or("null".to_owned(), place);
    let saved = checked.saved.as_ref().map_or("null".to_owned(), |path| {
        quoted(&path.display().to_string())
    });
    format!(
        "{{\"frame\": {}, \"sign\": {}, \"place\": {place}, \"saved\": {saved}}}",
        difference.frame,
        quoted(&difference.sign.to_string())
    )
}

fn place(place: &Place) -> String {
    let Place {
        stage,
        buffer,
        differing_words,
        element,
        ..
    } = place;
    let Element {
        record,
        field,
        word,
        expected,
        got,
        is_float,
        ..
    } = element;
    let hex =
        |word: &Option<u32>| word.map_or("null".to_owned(), |bits| format!("\"{bits:#010x}\""));
    // JSON has no infinities and no NaN.
    let float = |word: &Option<u32>| match word.map(f32::from_bits) {
        Some(value) if *is_float && value.is_finite() => format!("{value:e}"),
        _ => "null".to_owned(),
    };
    format!(
        "{{\"stage\": {}, \"buffer\": {}, \"differing_words\": {differing_words}, \
         \"record\": {record}, \"field\": {}, \"word\": {word}, \"expected\": {}, \"got\": {}, \
         \"expected_float\": {}, \"got_float\": {}}}",
        quoted(stage),
        quoted(buffer),
        quoted(field),
        hex(expected),
        hex(got),
        float(expected),
        float(got)
    )
}
