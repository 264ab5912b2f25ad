//! [`SceneError`]: what is wrong, where, and what would be right, in a few plain lines.

use std::fmt::{self, Write as _};
use std::ops::Range;

/// Characters of an offending line that are shown at most.
const SNIPPET_CHARS: usize = 100;

/// Characters kept before the offending place when a line is too long to be shown whole.
const SNIPPET_LEAD: usize = 30;

/// Why a scene was refused.
///
/// [`Display`](fmt::Display) prints what, where, the offending line with carets under it, and
/// what would be right; it ends without a newline and holds no control characters but newlines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError(Box<Parts>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Parts {
    what: String,
    file: Option<String>,
    place: Option<Place>,
    help: String,
    /// What else there is to know; mostly nothing.
    note: String,
    is_users_fault: bool,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Place {
    line: usize,
    column: usize,
    snippet: String,
    indent: usize,
    carets: usize,
    /// Whether the line's number means anything to people.
    numbered: bool,
}

impl SceneError {
    /// An error about a whole file, or about no file at all.
    pub(super) fn general(
        what: impl Into<String>,
        file: Option<&str>,
        help: impl Into<String>,
    ) -> Self {
        Self(Box::new(Parts {
            what: printable(&what.into()),
            file: file.map(printable),
            place: None,
            help: printable(&help.into()),
            note: String::new(),
            is_users_fault: true,
        }))
    }

    /// The same where the machine is at fault.
    pub(super) fn of_the_machine(mut self) -> Self {
        self.0.is_users_fault = false;
        self
    }

    /// The same with something else to know.
    pub(super) fn noted(mut self, note: impl Into<String>) -> Self {
        self.0.note = printable(&note.into());
        self
    }

    /// File, line and column, as far as there are any.
    pub(super) fn location(&self) -> String {
        let file = self.0.file.as_deref().unwrap_or_default();
        file.to_owned() + &self.0.place.as_ref().map_or(String::new(), Place::suffix)
    }

    /// An error at `span`, bytes of `text`, which came from `file`, where it begins on line
    /// `first_line`; without one, lines have no number in the printed form.
    pub(super) fn located(
        what: impl Into<String>,
        (file, text, first_line): (&str, &str, Option<usize>),
        span: Range<usize>,
        help: impl Into<String>,
    ) -> Self {
        let mut error = Self::general(what, Some(file), help);
        error.0.place = Some(Place::new(text, span, first_line));
        error
    }

    /// What is wrong, one line, naming the key if there is one.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.what
    }

    /// Whether another scene, or another file of it, would help; else the machine has too little
    /// memory.
    #[must_use]
    pub fn is_users_fault(&self) -> bool {
        self.0.is_users_fault
    }

    /// What would be right.
    #[must_use]
    pub fn help(&self) -> &str {
        &self.0.help
    }

    /// The file as it was given to [`parse`](super::parse()) or [`load`](super::load), or
    /// `command line`, or that of a recording, or a mesh that the scene names; `None` if the error
    /// is about no file.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        self.0.file.as_deref()
    }

    /// Line of the offending text, from 1; `None` if the error is about no place in it.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        self.0.place.as_ref().map(|place| place.line)
    }

    /// Column of the offending text in characters, from 1; `None` if it is about no place in it.
    #[must_use]
    pub fn column(&self) -> Option<usize> {
        self.0.place.as_ref().map(|place| place.column)
    }
}

impl std::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Parts {
            what,
            file,
            place,
            help,
            note,
            is_users_fault: _,
        } = &*self.0;
        write!(out, "error: {what}")?;
        let gutter = place.as_ref().map_or(2, Place::gutter);
        if file.is_some() {
            write!(out, "\n{:gutter$}--> {}", "", self.location())?;
        }
        if let Some(place) = place {
            let number = match place.numbered {
                true => place.line.to_string(),
                false => String::new(),
            };
            let (indent, carets) = (place.indent, place.carets);
            write!(out, "\n{:gutter$} |", "")?;
            write!(out, "\n{number:>gutter$} | {}", place.snippet)?;
            write!(out, "\n{:gutter$} | {:indent$}{:^<carets$}", "", "", "")?;
        }
        if !help.is_empty() {
            write!(out, "\n{:gutter$} = help: {help}", "")?;
        }
        if !note.is_empty() {
            write!(out, "\n{:gutter$} = note: {note}", "")?;
        }
        Ok(())
    }
}

impl Place {
    fn new(text: &str, span: Range<usize>, first_line: Option<usize>) -> Self {
        let start = floor_char_boundary(text, span.start);
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = text[start..]
            .find('\n')
            .map_or(text.len(), |newline| start + newline);
        let line = text[line_start..line_end].trim_end_matches('\r');
        let end = floor_char_boundary(text, span.end.min(line_start + line.len())).max(start);

        let length = line.chars().count();
        // The place may be among the carriage returns that end the line.
        let before = text[line_start..start].chars().count().min(length);
        let marked = text[start..end].chars().count().max(1);
        let skipped = if length <= SNIPPET_CHARS {
            0
        } else {
            before.saturating_sub(SNIPPET_LEAD)
        };
        let mut snippet = String::new();
        if skipped > 0 {
            snippet.push('…');
        }
        let indent = before - skipped + snippet.chars().count();
        let shown = SNIPPET_CHARS.min(length - skipped);
        snippet.extend(line.chars().skip(skipped).take(shown).map(plain));
        let carets = marked.min((shown + 1).saturating_sub(before - skipped).max(1));
        if skipped + shown < length {
            snippet.push('…');
        }
        Self {
            line: text[..line_start].matches('\n').count() + first_line.unwrap_or(1),
            column: before + 1,
            snippet,
            indent,
            carets,
            numbered: first_line.is_some(),
        }
    }

    /// What stands behind the file's name.
    fn suffix(&self) -> String {
        match self.numbered {
            true => format!(":{}:{}", self.line, self.column),
            false => String::new(),
        }
    }

    fn gutter(&self) -> usize {
        if self.numbered {
            self.line.to_string().len().max(2)
        } else {
            2
        }
    }
}

/// Names close enough to `given` to be what was meant, nearest first.
pub(super) fn nearest<'a>(given: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let given: String = given.chars().take(64).collect();
    let mut close: Vec<(usize, &str)> = names
        .into_iter()
        .map(|name| (strsim::osa_distance(&given.to_lowercase(), name), name))
        .filter(|&(distance, name)| distance <= 1 + name.chars().count() / 4)
        .collect();
    close.sort_unstable();
    close.into_iter().map(|(_, name)| name).collect()
}

/// "did you mean `x`? " or nothing.
pub(super) fn did_you_mean<'a>(given: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    let mut sentence = String::new();
    if let Some(name) = nearest(given, names).first() {
        let _ = write!(sentence, "did you mean `{name}`? ");
    }
    sentence
}

/// The same with as many as three: "did you mean `x` or `y`? ".
pub(super) fn did_you_mean_one_of<'a>(
    given: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> String {
    let names = nearest(given, names).into_iter().take(3);
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    match names.is_empty() {
        true => String::new(),
        false => format!("did you mean {}? ", names.join(" or ")),
    }
}

/// A name that the user gave, not too long to stand in a message.
pub(crate) fn shortened(name: &str) -> String {
    let mut short: String = name.chars().take(64).map(plain).collect();
    if name.chars().nth(64).is_some() {
        short.push('…');
    }
    short
}

/// The text with nothing in it that would move a terminal's cursor or change its state.
fn printable(text: &str) -> String {
    text.chars().map(plain).collect()
}

fn plain(letter: char) -> char {
    match letter {
        '\t' | '\n' | '\r' => ' ',
        // Bidirectional controls would show a line other than what is in the file.
        '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => '\u{fffd}',
        _ if letter.is_control() => '\u{fffd}',
        _ => letter,
    }
}

fn floor_char_boundary(text: &str, index: usize) -> usize {
    let index = index.min(text.len());
    (0..=index)
        .rev()
        .find(|&i| text.is_char_boundary(i))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_among_what_ends_a_line_is_at_its_end() {
        for letters in [0, 30, 99, 100, 101, 300] {
            for returns in [0, 1, 200, 500] {
                let text = "x".repeat(letters) + &"\r".repeat(returns);
                for at in 0..=text.len() {
                    let span = at..at + 1;
                    let error = SceneError::located("what", ("f", &text, Some(1)), span, "help");
                    let column = at.min(letters) + 1;
                    assert_eq!(error.column(), Some(column), "{letters} {returns} {at}");
                    let printed = error.to_string();
                    let carets = printed.lines().nth(4).expect("it has a snippet");
                    assert!(carets.len() < 120 && carets.ends_with('^'), "{printed}");
                }
            }
        }
    }
}
