//! Texts that nobody meant: never a panic, always a scene or a line.

use std::fmt::Write as _;

use motes::scene::{BUILTIN, load_with, parse};

use crate::text::{FILE, FULL, KEYED, MINIMAL};

/// The `count`th of a fixed sequence of numbers that look random (splitmix64).
fn random(count: u64) -> u64 {
    let mut x = count.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// One to four bytes or pieces of the text changed.
fn spoiled(text: &str, case: u64) -> String {
    const PIECES: [&str; 16] = [
        "[",
        "]",
        "{",
        "}",
        "=",
        "\"",
        "\n",
        ",",
        ".",
        "-",
        "9",
        "e",
        "nan",
        "inf",
        "[[system]]\n",
        "\u{e9}",
    ];
    let mut bytes = text.as_bytes().to_vec();
    for change in 0..=random(case * 64) % 4 {
        let draw = |n: u64| random(case * 64 + change * 8 + n + 1);
        let at = (draw(0) % (bytes.len() as u64 + 1)) as usize;
        let end = (at + (draw(1) % 40) as usize).min(bytes.len());
        let piece = PIECES[(draw(2) % 16) as usize].as_bytes();
        match draw(3) % 5 {
            0 => drop(bytes.splice(at..end.min(at + 1), [draw(4) as u8])),
            1 => drop(bytes.splice(at..end.min(at + 1), piece.iter().copied())),
            2 => drop(bytes.splice(at..at, piece.iter().copied())),
            3 => drop(bytes.drain(at..end)),
            _ => {
                let copy = bytes[at..end].to_vec();
                let to = (draw(5) % (bytes.len() as u64 + 1)) as usize;
                drop(bytes.splice(to..to, copy));
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn a_spoiled_scene_is_a_scene_or_an_error_with_a_line() {
    let texts: Vec<&str> = BUILTIN
        .iter()
        .map(|s| s.text)
        .chain([FULL, KEYED, MINIMAL])
        .collect();
    let (mut accepted, mut refused) = (0, 0);
    for case in 0..4000_u64 {
        let text = spoiled(texts[case as usize % texts.len()], case);
        match parse(&text, FILE, "some") {
            Ok(scene) => {
                accepted += 1;
                assert!(
                    !(scene.systems.is_empty()
                        && scene.flocks.is_empty()
                        && scene.fires.is_empty()),
                    "{text}"
                );
            }
            Err(error) => {
                refused += 1;
                let line = error
                    .line()
                    .unwrap_or_else(|| panic!("no line: {error}\n{text}"));
                assert!(
                    (1..=text.split('\n').count()).contains(&line),
                    "{error}\n{text}"
                );
                assert!(error.column().is_some(), "{error}");
                assert!(
                    !error.message().is_empty() && !error.help().is_empty(),
                    "{error}"
                );
                assert!(error.to_string().contains('^'), "{error}");
            }
        }
    }
    // Both happen often, so that both are tested.
    assert!(
        accepted > 100 && refused > 1000,
        "{accepted} accepted, {refused} refused"
    );
}

#[test]
fn a_spoiled_set_is_a_scene_or_an_error() {
    let sets = [
        "image.width=640",
        "system.0.speed.mean=0.2",
        "camera.position=[0, 1, 5]",
        "title=x",
        "system.0.size={ keys = [[0, 1], [9, 2]], interpolation = 'step' }",
    ];
    for case in 0..2000_u64 {
        let set = spoiled(sets[case as usize % sets.len()], case);
        if let Err(error) = load_with("fountain", std::slice::from_ref(&set)) {
            assert!(error.line().is_some(), "{set:?}: {error}");
            assert!(!error.to_string().is_empty());
        }
    }
}

#[test]
fn depth_and_length_are_bounded() {
    // On a small stack, so that whatever recurses with the text is found out.
    let check = || {
        let n = 300_000;
        let dotted = vec!["a"; 70].join(".");
        let mut nested = "1".to_owned();
        for _ in 0..70 {
            nested = format!("{{ {dotted} = {nested} }}");
        }
        let texts = [
            "a.".repeat(n) + "a = 1",
            "[".to_owned() + &"a.".repeat(n) + "a]",
            "a = ".to_owned() + &"[".repeat(n),
            "a = ".to_owned() + &"[".repeat(n) + &"]".repeat(n),
            "a = ".to_owned() + &"{ a = ".repeat(n),
            format!("a = {nested}"),
            MINIMAL.to_owned() + &"[[system]]\n".repeat(n / 10),
            "title = ".to_owned() + &"9".repeat(n),
            "a.b = ".to_owned() + &"9.".repeat(n),
            "\"".to_owned() + &"k".repeat(n) + "\" = 1",
            MINIMAL.replace("only", &"n".repeat(n)),
            MINIMAL.replace("sphere", &"s".repeat(n)),
            MINIMAL.replace("= 60", &format!("= {}.5", "9".repeat(n))),
            "title = \"".to_owned() + &"x".repeat(n),
        ];
        for text in texts {
            let error = parse(&text, FILE, "some").expect_err("nothing of that is a scene");
            let mut shown = String::new();
            write!(shown, "{error}").expect("text takes any text");
            assert!(
                shown.len() < 2000,
                "{} bytes: {}",
                shown.len(),
                &shown[..200]
            );
        }
    };
    let thread = std::thread::Builder::new().stack_size(1 << 20);
    let done = thread.spawn(check).expect("a thread").join();
    assert!(done.is_ok());
}
