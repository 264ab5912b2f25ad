//! The changed texts: a fixed sequence that looks random.

/// Numbers at the ends of what numbers can be, and a little beyond what scenes take.
const EXTREMES: [&str; 40] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e-6",
    "1e-9",
    "1e-38",
    "1e-45",
    "1e-320",
    "1e6",
    "1e7",
    "1e9",
    "1e16",
    "1e38",
    "3.5e38",
    "1e308",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "100",
    "360",
    "180",
    "90",
    "255",
    "1000",
    "65000",
    "65536",
    "1000000",
    "16777216",
    "2147483647",
    "2147483648",
    "-2147483648",
    "4294967296",
    "9223372036854775807",
    "9223372036854775808",
    "0x7fffffff",
    "-9223372036854775808",
];

/// Numbers that many keys take, if seldom as the only one of their kind.
const MODERATE: [&str; 12] = [
    "0", "1", "2", "-1", "0.5", "100", "1000", "65000", "1000000", "16000000", "1e-6", "0.001",
];

/// Characters that tokens end at, and are tokens themselves.
const MARKS: &str = " \t\n=[]{},\"'.#";

/// A sequence of numbers that look random (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Below `end`; 0 if that is 0.
    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    fn of<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len())]
    }
}

/// The mutant of that number: a text of the corpus with one to three changes.
pub(crate) fn mutant(corpus: &[String], number: u64) -> String {
    let mut random = Random(number.wrapping_mul(0x1234_5678_9abc_def1));
    let mut text = corpus[random.below(corpus.len())].clone();
    for _ in 0..=random.below(3) {
        let other = &corpus[random.below(corpus.len())];
        text = match random.below(16) {
            0 => bytes(&text, &mut random),
            1..=2 => tokens(&text, other, &mut random),
            3 => tables(&text, other, &mut random),
            4..=5 => lines(&text, other, &mut random),
            _ => numbers(&text, &mut random),
        };
    }
    text
}

/// A byte flipped, a few deleted or doubled, or many of one put in between.
fn bytes(text: &str, random: &mut Random) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let at = random.below(bytes.len());
    let end = (at + 1 + random.below(20)).min(bytes.len());
    match random.below(4) {
        0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
        1 => drop(bytes.drain(at..end)),
        2 => {
            let run = vec![random.of(b"\r\n\t \"'[{#\0"); 1 + random.below(400)];
            drop(bytes.splice(at..at, run));
        }
        _ => {
            let copy = bytes[at..end].to_vec();
            drop(bytes.splice(at..at, copy));
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    for part in text.split_inclusive(|letter| MARKS.contains(letter)) {
        let word = part.trim_end_matches(|letter| MARKS.contains(letter));
        pieces.extend(
            [word, &part[word.len()..]]
                .into_iter()
                .filter(|it| !it.is_empty()),
        );
    }
    pieces
}

/// A token in place of another, of the same text or the other.
fn tokens(text: &str, other: &str, random: &mut Random) -> String {
    let mut tokens = pieces(text);
    let others = pieces(other);
    if tokens.is_empty() || others.is_empty() {
        return text.to_owned();
    }
    let at = random.below(tokens.len());
    match random.below(3) {
        0 => tokens[at] = random.of(&others),
        1 => {
            let to = random.below(tokens.len());
            tokens.swap(at, to);
        }
        _ => tokens.insert(at, random.of(&others)),
    }
    tokens.concat()
}

/// Numbers replaced: by an extreme, or by a multiple of what they were.
fn numbers(text: &str, random: &mut Random) -> String {
    let pieces = number_tokens(text);
    let places: Vec<usize> = (0..pieces.len()).filter(|&at| pieces[at].1).collect();
    if places.is_empty() {
        return text.to_owned();
    }
    let at = random.of(&places);
    let mut changed = String::new();
    for (index, (piece, _)) in pieces.iter().enumerate() {
        if index != at {
            changed += piece;
            continue;
        }
        let factor = random.of(&[-1.0, 0.0, 0.1, 0.5, 3.0, 10.0, 1000.0]);
        let is_whole = !piece.contains(['.', 'e']);
        match (random.below(4), piece.parse::<f64>()) {
            (0 | 1, Ok(value)) if is_whole => {
                changed += &((value * factor) as i64).to_string();
            }
            (0 | 1, Ok(value)) => changed += &format!("{:?}", value * factor),
            (2, _) => changed += random.of::<&str>(&MODERATE),
            _ => changed += random.of::<&str>(&EXTREMES),
        }
    }
    changed
}

/// The text in pieces, and which of them are numbers: decimal points do not part these.
fn number_tokens(text: &str) -> Vec<(String, bool)> {
    let mut tokens: Vec<(String, bool)> = Vec::new();
    for piece in pieces(text) {
        let joins = tokens.last().is_some_and(|(last, _)| {
            last.starts_with(|c: char| c.is_ascii_digit() || c == '-')
                && (piece == "." || last.ends_with('.'))
        });
        match tokens.last_mut() {
            Some((last, _)) if joins => *last += piece,
            _ => tokens.push((piece.to_owned(), false)),
        }
    }
    for (token, is_number) in &mut tokens {
        *is_number = token.replace('_', "").parse::<f64>().is_ok();
    }
    tokens
}

/// The text cut before each header of a table.
fn cut(text: &str) -> Vec<String> {
    let mut tables = vec![String::new()];
    for line in text.split_inclusive('\n') {
        if line.starts_with('[') {
            tables.push(String::new());
        }
        if let Some(last) = tables.last_mut() {
            last.push_str(line);
        }
    }
    tables
}

/// A table dropped, doubled, moved, nested in another, many times over, or taken from the other.
fn tables(text: &str, other: &str, random: &mut Random) -> String {
    let mut tables = cut(text);
    let at = random.below(tables.len());
    match random.below(7) {
        0 => drop(tables.remove(at)),
        1 => tables.insert(at, tables[at].clone()),
        2 => {
            let to = random.below(tables.len());
            tables.swap(at, to);
        }
        3 => {
            let nested = tables[at].replacen('[', "[system.", 1);
            tables[at] = nested;
        }
        4 => {
            let many = 2 << random.below(10);
            let copies = (0..many).map(|copy| {
                // Systems of one name would all be refused for that.
                tables[at].replacen("name = \"", &format!("name = \"n{copy}"), 1)
            });
            let copies: Vec<String> = copies.collect();
            drop(tables.splice(at..=at, copies));
        }
        _ => {
            let others = cut(other);
            tables.insert(at + 1, others[random.below(others.len())].clone());
        }
    }
    tables.concat()
}

/// A line doubled, dropped, or put among the others.
fn lines(text: &str, other: &str, random: &mut Random) -> String {
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    let others: Vec<&str> = other.split_inclusive('\n').collect();
    if lines.is_empty() || others.is_empty() {
        return text.to_owned();
    }
    let at = random.below(lines.len());
    match random.below(5) {
        0 => lines.insert(at, lines[at]),
        1 => drop(lines.remove(at)),
        // A line of the same key, where the other has one.
        2..=3 => {
            let key = |line: &str| line.split('=').next().map(|key| key.trim().to_owned());
            let same = others.iter().filter(|line| key(line) == key(lines[at]));
            let same: Vec<&str> = same.copied().collect();
            if !same.is_empty() {
                lines[at] = random.of(&same);
            }
        }
        _ => lines.insert(at, random.of(&others)),
    }
    lines.concat()
}
