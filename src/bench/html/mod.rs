//! Records as one page with pictures: no scripts, no other files, light or dark as the reader has it.

mod bars;
mod chart;
mod curves;
mod shares;
mod svg;
mod tables;

use super::record::Record;

/// A record and what it is called on the page.
struct Labelled<'a> {
    label: String,
    /// Where it is from.
    file: Option<&'a str>,
    record: &'a Record,
}

/// All records on one page of HTML. Each adapter has its colour, each pass, too. `files` are where the
/// records are from, one each, in words; those without are shown without.
pub fn html(records: &[Record], files: &[String]) -> String {
    let records = labelled(records, files);
    let names: Vec<&str> = records.iter().map(|it| it.label.as_str()).collect();
    let names = svg::escaped(&names.join(", "));
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" \
         content=\"width=device-width, initial-scale=1\"/>\n<title>Motes on {names}</title>\n<style>\n{}</style>\n</head>\n\
         <body>\n<main>\n<h1>Motes on {names}</h1>\n<p>What a frame of particles costs, pass by pass, as a share of what the \
         same adapter's memory can do.</p>\n",
        include_str!("style.css")
    );
    let cards = records
        .iter()
        .enumerate()
        .map(|(at, it)| tables::card(at, it));
    page += &format!(
        "<div class=\"cards\">\n{}</div>\n",
        cards.collect::<String>()
    );
    page += &tables::notices(&records);
    let scenes = curves::scenes_in_several_counts(&records);
    let charts = scenes
        .iter()
        .map(|scene| curves::charts(scene, &records))
        .collect::<String>();
    page += &section("From few particles to many", &charts);
    page += &section("Scenes", &bars::scenes(&records, &scenes));
    let colors = shares::Colors::new(&records);
    let shares = records
        .iter()
        .map(|it| shares::chart(it, &colors))
        .collect::<String>();
    page += &section("Where the time goes", &shares);
    page += &section("Yardsticks", &bars::micro(&records));
    let tables = records
        .iter()
        .enumerate()
        .map(|(at, it)| tables::tables(at, it))
        .collect::<String>();
    page += &section("All numbers", &tables);
    page + "<footer>Made by <b>motes bench</b>. ms are medians; p10 and p90 are the times that a tenth and nine tenths of the \
            samples stay below.</footer>\n</main>\n</body>\n</html>\n"
}

fn section(title: &str, inside: &str) -> String {
    match inside {
        "" => String::new(),
        inside => format!("<h2>{title}</h2>\n{inside}"),
    }
}

/// Short names: the adapter's up to a parenthesis; with numbers where several are alike.
fn labelled<'a>(records: &'a [Record], files: &'a [String]) -> Vec<Labelled<'a>> {
    let short = |record: &Record| {
        let name = record.adapter.split('(').next().unwrap_or_default().trim();
        let name = name.strip_suffix(" Device").unwrap_or(name);
        if name.is_empty() {
            "unnamed".to_owned()
        } else {
            name.to_owned()
        }
    };
    let shorts: Vec<String> = records.iter().map(short).collect();
    let label = |at: usize| {
        let alike = |range: &[String]| range.iter().filter(|other| **other == shorts[at]).count();
        match alike(&shorts) {
            1 => shorts[at].clone(),
            _ => format!("{} {}", shorts[at], alike(&shorts[..=at])),
        }
    };
    let labelled = |(at, record)| Labelled {
        label: label(at),
        file: files.get(at).map(String::as_str),
        record,
    };
    records.iter().enumerate().map(labelled).collect()
}
