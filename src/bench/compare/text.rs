//! A comparison in words.

use super::super::table::COLUMNS;
use super::super::units::{digits, grouped, shortened};
use super::{Change, Compared, Comparison, Kind, LEAST_MS, LEAST_SHARE, LEVEL, Verdict};

/// Characters of a name.
const NAME: usize = 32;

impl Change {
    /// The best estimate and the interval, in percent of the old time: `12.3 % [10.1, 14.8]`.
    pub fn percent(&self) -> String {
        let percent = |ratio: f64| (ratio - 1.0) * 100.0;
        let (ratio, low, high) = (percent(self.ratio), percent(self.low), percent(self.high));
        match ratio < 0.0 {
            // Faster: how much of the old time was saved.
            true => format!("{:.1} % [{:.1}, {:.1}]", -ratio, -high, -low),
            false => format!("{ratio:.1} % [{low:.1}, {high:.1}]"),
        }
    }
}

impl Compared {
    /// E.g. `slower by 12.3 % [10.1, 14.8]`.
    pub fn words(&self) -> String {
        let Some(change) = &self.change else {
            return "too few samples to tell".to_owned();
        };
        let within = || match change.reach() {
            reach if reach > 1.0 => "over 100 %".to_owned(),
            reach => format!("{:.1} %", reach * 100.0),
        };
        match self.verdict() {
            Verdict::Slower => format!("slower by {}", change.percent()),
            Verdict::Faster => format!("faster by {}", change.percent()),
            Verdict::Same => format!("no difference (within {})", within()),
            Verdict::Unclear => match self.against_rest {
                Some(rest) if rest.low > 1.0 => {
                    format!("slower against other passes by {}", rest.percent())
                }
                Some(rest) if rest.high < 1.0 => {
                    format!("faster against other passes by {}", rest.percent())
                }
                _ => format!("cannot tell (within {})", within()),
            },
        }
    }

    /// E.g. `advance of million at 1,000,000 particles`.
    pub fn place(&self) -> String {
        let name = match self.kind {
            Kind::Whole => format!("whole {}", self.name),
            _ => self.name.clone(),
        };
        match &self.run {
            Some((scene, particles)) => {
                format!("{name} of {scene} at {} particles", grouped(*particles))
            }
            None => format!("{name} alone"),
        }
    }
}

impl Comparison {
    /// The comparison as text for a terminal. With `fail_above`, percent, it ends with whether that was kept.
    pub fn text(&self, fail_above: Option<f64>) -> String {
        let mut text = shortened(&self.adapter, COLUMNS) + "\n";
        if self.new_adapter != self.adapter {
            text += &format!(
                "{}\n",
                shortened(&format!("against {}", self.new_adapter), COLUMNS)
            );
        }
        let records = |count: usize| match count {
            1 => "1 record".to_owned(),
            count => format!("{count} records"),
        };
        let pairs = match self.old_records == self.new_records && self.old_records > 1 {
            true => ", in pairs",
            false => "",
        };
        let (old, new) = (records(self.old_records), records(self.new_records));
        text += &format!("{old} before, {new} now{pairs}\n");
        // What the answer is worth comes before it.
        text += &list("warning", &self.warnings);
        let mut run = None;
        for compared in &self.compared {
            if run != Some(&compared.run) {
                run = Some(&compared.run);
                text += &head(compared);
            }
            text += &line(compared);
        }
        text += "\n";
        text += &list("only before", &self.only_old);
        text += &list("only now", &self.only_new);
        text += &wrapped(&format!(
            "Intervals hold with {:.0} % each: of {} things that did not change, {} called slower or faster by chance.",
            LEVEL * 100.0,
            self.compared.len(),
            by_chance(self.compared.len())
        ));
        text += &match self.slowed_most() {
            Some(most) => wrapped(&format!("Slowed most: {}, {}.", most.place(), most.words())),
            None => "Nothing that matters got slower.\n".to_owned(),
        };
        if let Some(percent) = fail_above {
            text += &self.judgement(percent);
        }
        text
    }

    fn judgement(&self, percent: f64) -> String {
        let slower = self.slower_by(percent);
        if slower.is_empty() {
            return format!("Nothing is slower by more than {percent} % for certain.\n");
        }
        let mut text = wrapped(&format!(
            "FAILED: slower by more than {percent} % (of what takes {LEAST_MS} ms and {:.0} % of the frame or more):",
            LEAST_SHARE * 100.0
        ));
        for compared in slower {
            text += &wrapped(&format!("  {}: {}", compared.place(), compared.words()));
        }
        text
    }
}

/// How many of so many are called different though they are not, in words.
fn by_chance(things: usize) -> String {
    let expected = things as f64 * (1.0 - LEVEL);
    match expected.round() as usize {
        0 => "hardly one is".to_owned(),
        1 => "about one is".to_owned(),
        several => format!("about {several} are"),
    }
}

/// What a group of lines is about.
fn head(first: &Compared) -> String {
    let title = match &first.run {
        Some((scene, particles)) => format!("{scene} at {} particles", grouped(*particles)),
        None => "kernels alone".to_owned(),
    };
    let title = shortened(&title, COLUMNS);
    format!("\n{title}\n{:<NAME$}{:>8} {:>8}\n", "", "before", "now, ms")
}

fn line(compared: &Compared) -> String {
    let name = match compared.kind {
        Kind::Whole => format!("whole {}", compared.name),
        _ => format!("  {}", compared.name),
    };
    let small = match compared.matters() || compared.verdict() != Verdict::Slower {
        true => "",
        false => ", but small",
    };
    format!(
        "{:<NAME$}{:>8} {:>8}  {}{small}\n",
        shortened(&name, NAME),
        digits(compared.old_ms),
        digits(compared.new_ms),
        compared.words()
    )
}

fn list(what: &str, texts: &[String]) -> String {
    texts
        .iter()
        .map(|text| wrapped(&format!("{what}: {text}")))
        .collect()
}

/// On lines of at most [`COLUMNS`], those after the first indented.
fn wrapped(text: &str) -> String {
    let mut all = String::new();
    let indent = text.len() - text.trim_start().len();
    let mut line = " ".repeat(indent);
    let mut is_empty = true;
    for word in text.split_whitespace() {
        if !is_empty && line.chars().count() + 1 + word.chars().count() > COLUMNS {
            all += &(line + "\n");
            line = " ".repeat(indent + 2);
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line += word;
        is_empty = false;
    }
    all + &line + "\n"
}
