//! Comparisons as JSON.

use super::{Compared, Comparison, Kind, LEVEL, Verdict};
use crate::json::Json;

/// Version of the report; it goes up when a key changes its meaning or goes away.
const SCHEMA: i64 = 1;

/// The comparisons as JSON: `{"schema", "level", "fail_above", "fails", "comparisons": [{"adapter",
/// "new_adapter", "old_records", "new_records", "compared": [{"kind", "scene", "particles", "name", "old_ms",
/// "new_ms", "share_of_frame", "ratio", "low", "high",
/// "ratio_against_rest", "low_against_rest", "high_against_rest", "verdict", "matters", "fails"}], "only_old",
/// "only_new", "warnings", "slowed_most"}]}`. `fail_above` is percent; `ratio`, `low` and `high` are new
/// time over old time.
pub fn comparisons_json(comparisons: &[Comparison], fail_above: Option<f64>) -> String {
    let fails = fail_above.is_some_and(|percent| {
        let mut all = comparisons.iter();
        all.any(|comparison| !comparison.slower_by(percent).is_empty())
    });
    let of_one = |comparison: &Comparison| one(comparison, fail_above);
    Json::object([
        ("schema", Json::Whole(SCHEMA)),
        ("level", Json::Number(LEVEL)),
        ("fail_above", number(fail_above)),
        ("fails", Json::Flag(fails)),
        (
            "comparisons",
            Json::Array(comparisons.iter().map(of_one).collect()),
        ),
    ])
    .pretty()
}

fn one(comparison: &Comparison, fail_above: Option<f64>) -> Json {
    let texts = |texts: &[String]| Json::texts(texts.iter().map(String::as_str));
    let compared = comparison
        .compared
        .iter()
        .map(|it| compared(it, fail_above));
    Json::object([
        ("adapter", comparison.adapter.as_str().into()),
        ("new_adapter", comparison.new_adapter.as_str().into()),
        ("old_records", comparison.old_records.into()),
        ("new_records", comparison.new_records.into()),
        ("compared", Json::Array(compared.collect())),
        ("only_old", texts(&comparison.only_old)),
        ("only_new", texts(&comparison.only_new)),
        ("warnings", texts(&comparison.warnings)),
        (
            "slowed_most",
            comparison
                .slowed_most()
                .map_or(Json::Null, |it| it.place().as_str().into()),
        ),
    ])
}

fn compared(compared: &Compared, fail_above: Option<f64>) -> Json {
    let kind = match compared.kind {
        Kind::Micro => "micro",
        Kind::Pass => "pass",
        Kind::Whole => "whole",
    };
    let verdict = match compared.verdict() {
        Verdict::Slower => "slower",
        Verdict::Faster => "faster",
        Verdict::Same => "same",
        Verdict::Unclear => "unclear",
    };
    let (scene, particles) = match &compared.run {
        Some((scene, particles)) => (scene.as_str().into(), (*particles as usize).into()),
        None => (Json::Null, Json::Null),
    };
    let (change, rest) = (compared.change, compared.against_rest);
    Json::object([
        ("kind", kind.into()),
        ("scene", scene),
        ("particles", particles),
        ("name", compared.name.as_str().into()),
        ("old_ms", Json::Number(compared.old_ms)),
        ("new_ms", Json::Number(compared.new_ms)),
        ("share_of_frame", number(compared.share_of_frame)),
        ("ratio", number(change.map(|it| it.ratio))),
        ("low", number(change.map(|it| it.low))),
        ("high", number(change.map(|it| it.high))),
        ("ratio_against_rest", number(rest.map(|it| it.ratio))),
        ("low_against_rest", number(rest.map(|it| it.low))),
        ("high_against_rest", number(rest.map(|it| it.high))),
        ("verdict", verdict.into()),
        ("matters", Json::Flag(compared.matters())),
        (
            "fails",
            Json::Flag(fail_above.is_some_and(|percent| compared.is_slower_by(percent))),
        ),
    ])
}

fn number(number: Option<f64>) -> Json {
    number.map_or(Json::Null, Json::Number)
}
