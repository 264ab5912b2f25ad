//! A small JSON writer: values, written so that people can read them.

/// Characters of a line, with its indentation, up to which a value stays on one.
const LINE_CHARS: usize = 100;

/// A JSON value; keys stay in their order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Json {
    /// `null`.
    Null,
    /// `true` or `false`.
    Flag(bool),
    /// A whole number.
    Whole(i64),
    /// A finite number.
    Number(f64),
    /// Text.
    Text(String),
    /// An array.
    Array(Vec<Json>),
    /// An object.
    Object(Vec<(String, Json)>),
}

impl From<&str> for Json {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<usize> for Json {
    fn from(count: usize) -> Self {
        i64::try_from(count).map_or(Self::Number(count as f64), Self::Whole)
    }
}

impl Json {
    /// An object with these keys.
    pub(crate) fn object<const N: usize>(entries: [(&str, Self); N]) -> Self {
        let entries = entries.map(|(key, value)| (key.to_owned(), value));
        Self::Object(entries.into())
    }

    /// An array of texts.
    pub(crate) fn texts<'a>(texts: impl IntoIterator<Item = &'a str>) -> Self {
        Self::Array(texts.into_iter().map(Self::from).collect())
    }

    /// The object with one more key at its end; anything else as it is.
    pub(crate) fn with(mut self, key: &str, value: Self) -> Self {
        if let Self::Object(entries) = &mut self {
            entries.push((key.to_owned(), value));
        }
        self
    }

    /// On lines of some 100 characters, with a line break at the end.
    pub(crate) fn pretty(&self) -> String {
        let mut text = String::new();
        self.write(&mut text, 0, 0);
        text + "\n"
    }

    /// On one line, without a line break.
    pub(crate) fn line(&self) -> String {
        match self {
            Self::Null => "null".into(),
            Self::Flag(flag) => flag.to_string(),
            Self::Whole(whole) => whole.to_string(),
            // Rust writes numbers without exponents, which is JSON if they are finite.
            Self::Number(number) if number.is_finite() => number.to_string(),
            Self::Number(_) => "null".into(),
            Self::Text(text) => quoted(text),
            Self::Array(items) => {
                let items: Vec<String> = items.iter().map(Self::line).collect();
                format!("[{}]", items.join(", "))
            }
            Self::Object(entries) if entries.is_empty() => "{}".into(),
            Self::Object(entries) => {
                let entry =
                    |(key, value): &(String, Self)| format!("{}: {}", quoted(key), value.line());
                let entries: Vec<String> = entries.iter().map(entry).collect();
                format!("{{ {} }}", entries.join(", "))
            }
        }
    }

    /// Writes the value from `column` of a line that is indented by `indent`.
    fn write(&self, text: &mut String, indent: usize, column: usize) {
        let line = self.line();
        let (open, close, items): (_, _, Vec<(Option<&str>, &Self)>) = match self {
            _ if column + line.chars().count() <= LINE_CHARS => return text.push_str(&line),
            Self::Array(items) => ('[', ']', items.iter().map(|item| (None, item)).collect()),
            Self::Object(entries) => {
                let entries = entries
                    .iter()
                    .map(|(key, value)| (Some(key.as_str()), value));
                ('{', '}', entries.collect())
            }
            _ => return text.push_str(&line),
        };
        let inner = indent + 2;
        text.push(open);
        for (at, (key, value)) in items.into_iter().enumerate() {
            let comma = if at == 0 { "" } else { "," };
            let key = key.map_or_else(String::new, |key| quoted(key) + ": ");
            *text += &format!("{comma}\n{:inner$}{key}", "");
            value.write(text, inner, inner + key.chars().count() + 1);
        }
        *text += &format!("\n{:indent$}{close}", "");
    }
}

/// A JSON string.
pub(crate) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted += "\\\"",
            '\\' => quoted += "\\\\",
            '\n' => quoted += "\\n",
            c if c.is_control() => quoted += &format!("\\u{:04x}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
