//! What is changed: every scene of the program, of its documents and of its tests.

use motes::scene::{BUILTIN, parse};

/// Texts with scenes between marks.
const DOCUMENTS: [(&str, &str, &str); 6] = [
    (
        include_str!("../../scenes/REFERENCE.md"),
        "```toml\n",
        "```\n",
    ),
    (include_str!("../../README.md"), "```toml\n", "```\n"),
    (include_str!("../scene_files/text.rs"), "r#\"", "\"#"),
    (include_str!("../common/scenes.rs"), "r#\"", "\"#"),
    (include_str!("../common/edges.rs"), "r#\"", "\"#"),
    (include_str!("../command_line/main.rs"), "r#\"", "\"#"),
];

/// Scenes that parse. A piece of one is made whole by what comes before every system.
pub(crate) fn corpus() -> Vec<String> {
    const HEAD: &str = "frames = 9\n[camera]\nposition = [0, 1, 5]\ntarget = [0, 0, 0]\nvertical_fov_degrees = 40\n";
    let mut texts: Vec<String> = BUILTIN.iter().map(|scene| scene.text.to_owned()).collect();
    for (document, begin, end) in DOCUMENTS {
        for piece in document.split(begin).skip(1) {
            let piece = piece.split(end).next().unwrap_or_default();
            texts.extend([piece.to_owned(), format!("{HEAD}{piece}")]);
        }
    }
    texts.retain(|text| parse(text, "scenes/corpus", "corpus").is_ok());
    assert!(texts.len() > BUILTIN.len() + 5, "{} scenes", texts.len());
    texts
}
