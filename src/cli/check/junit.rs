//! The results of a check as JUnit XML, which machines that run tests read.

use super::{Checked, Report};

/// One suite, a test case a scene; a difference is a failure, a machine that failed an error.
pub(super) fn junit(report: &Report) -> String {
    let count = |is: fn(&Checked) -> bool| report.scenes.iter().filter(|c| is(c)).count();
    let failures = count(|c| c.outcome.as_ref().is_ok_and(|outcome| !outcome.is_equal()));
    let errors = count(|c| c.outcome.is_err());
    let duration_secs: f64 = report.scenes.iter().map(|c| c.duration_secs).sum();
    let totals = format!(
        "tests=\"{}\" failures=\"{failures}\" errors=\"{errors}\" time=\"{duration_secs:.3}\"",
        report.scenes.len()
    );
    let adapter = escaped(report.tested.name());
    let cases: String = report.scenes.iter().map(case).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {totals}>\n  \
         <testsuite name=\"motes check {adapter}\" {totals}>\n    <properties>\n      \
         <property name=\"adapter\" value=\"{}\"/>\n      \
         <property name=\"against\" value=\"{}\"/>\n    </properties>\n{cases}  </testsuite>\n\
         </testsuites>\n",
        escaped(&report.tested.description()),
        escaped(&report.against.description()),
    )
}

fn case(checked: &Checked) -> String {
    let head = format!(
        "    <testcase classname=\"motes.check\" name=\"{}\" time=\"{:.3}\"",
        escaped(&checked.scene),
        checked.duration_secs
    );
    let (element, summary, text) = match &checked.outcome {
        Err(message) => ("error", "the machine failed".to_owned(), message.clone()),
        Ok(outcome) => match &outcome.difference {
            None => return format!("{head}/>\n"),
            Some(difference) => {
                let place = difference.place.as_ref().map_or(String::new(), |place| {
                    format!(
                        ", stage {}, buffer {}, {}",
                        place.stage, place.buffer, place.element
                    )
                });
                let summary = format!("differs at frame {}{place}", difference.frame);
                ("failure", summary, difference.to_string())
            }
        },
    };
    format!(
        "{head}>\n      <{element} message=\"{}\">{}</{element}>\n    </testcase>\n",
        escaped(&summary),
        escaped(&text)
    )
}

/// Text that may stand in XML 1.0, in attributes too.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&apos;",
            '\n' | '\t' => escaped.push(c),
            // XML has no way to write these.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}
