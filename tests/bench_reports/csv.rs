//! The tidy CSV.

use std::collections::HashMap;

use motes::bench::csv;

use crate::synthetic::LLVMPIPE;

/// Fields of a line, quotes taken off (RFC 4180).
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut letters = line.chars().peekable();
    let mut is_quoted = false;
    while let Some(letter) = letters.next() {
        let field = fields.last_mut().expect("there is always one");
        match letter {
            '"' if is_quoted && letters.peek() == Some(&'"') => field.extend(letters.next()),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            letter => field.push(letter),
        }
    }
    fields
}

#[test]
fn each_measurement_is_a_line_with_every_column() {
    let llvmpipe = LLVMPIPE.record(&[10_000, 1_000_000]);
    let mut cpu = LLVMPIPE.record(&[10_000]);
    cpu.adapter = "a \"cpu\", quoted".into();
    let text = csv(&[llvmpipe.clone(), cpu.clone()]);
    let mut lines = text.lines().map(fields);
    let header = lines.next().expect("there is a header");
    let rows: Vec<HashMap<&str, String>> = lines
        .map(|fields| {
            assert_eq!(fields.len(), header.len());
            header.iter().map(String::as_str).zip(fields).collect()
        })
        .collect();
    // Kernels alone, then passes, frame, step, draw and wall of each run.
    assert_eq!(rows.len(), 2 * 4 + 3 * (7 + 4));
    assert_eq!(
        rows.iter()
            .filter(|row| row["adapter"] == cpu.adapter)
            .count(),
        4 + 11
    );
    let row = rows
        .iter()
        .find(|row| row["name"] == "draw/splat" && row["particles"] == "1000000")
        .expect("it is there");
    let splat = &llvmpipe.runs[1].passes[5];
    let number = |key: &str| -> f64 { row[key].parse().expect("it is a number") };
    assert_eq!(
        (row["kind"].as_str(), row["part"].as_str()),
        ("pass", "draw")
    );
    assert_eq!(
        (number("median_ms"), number("p10_ms"), number("p90_ms")),
        (splat.ms.median, splat.ms.p10, splat.ms.p90)
    );
    assert_eq!(
        (number("bytes"), number("items"), number("samples")),
        (40e6, 1e6, 61.0)
    );
    assert_eq!(Some(number("share_of_copy")), splat.share_of_copy);
    let share = splat.ms.median / llvmpipe.runs[1].frame_ms.median;
    assert_eq!(number("share_of_frame"), share);
    assert!(text.ends_with('\n') && !text.contains("NaN"));
}
