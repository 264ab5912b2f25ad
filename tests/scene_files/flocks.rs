//! Flocks: relations, edges, and what is at odds.

use motes::scene::{BoidShape, Corners, Edges, RelationKind};

use crate::text::{accepted, refused, with};

const SCENE: &str = "[camera]\nposition = [0, 1, 5]\ntarget = [0, 0, 0]\n";

fn flock(lines: &str) -> String {
    format!(
        "[[flock]]\nname = \"a\"\ncount = 2\nregion = {{ min = [0, 0, 0], max = [1, 1, 0] }}\n{lines}\n"
    )
}

#[test]
fn a_flock_alone_is_a_scene_and_nobody_is_none() {
    let scene = accepted(&format!("{SCENE}{}", flock("")));
    assert_eq!((scene.systems.len(), scene.flocks.len()), (0, 1));
    assert!(refused(SCENE).message().contains("`system` is missing"));
}

#[test]
fn every_kind_of_edge_is_read_as_what_it_says() {
    let corners = Corners {
        min: [0.0, 0.0, 0.0],
        max: [500.0, 300.0, 200.0],
    };
    let edges = [
        ("edges.wrap", Edges::Wrap(corners)),
        ("edges.torus", Edges::Torus(corners)),
        (
            "edges.repel",
            Edges::Repel {
                corners,
                inward: false,
            },
        ),
        (
            "edges.constrain",
            Edges::Constrain {
                corners,
                factor: -4.0,
            },
        ),
    ];
    for (section, wanted) in edges {
        // Long enough for all who look at it.
        let text = with(section, "max", "[500, 300, 200]");
        assert_eq!(accepted(&text).flocks[0].edges, wanted);
    }
    for (word, wanted) in [
        ("triangle", BoidShape::Triangle),
        ("disc", BoidShape::Disc),
        ("point", BoidShape::Point),
        ("cone", BoidShape::Cone),
    ] {
        let text = with("flock", "shape", &format!("\"{word}\""));
        assert_eq!(accepted(&text).flocks[0].shape, wanted);
    }
}

#[test]
fn relations_are_to_the_flock_itself_if_nothing_is_said() {
    let scene = accepted(&format!(
        "{SCENE}{}{}",
        flock("").replace("\"a\"", "\"b\""),
        flock("[[flock.relation]]\nkind = \"flock\"")
    ));
    let relation = &scene.flocks[1].relations[0];
    assert_eq!((relation.other, relation.radius), (1, None));
    let RelationKind::Flock {
        inverse_distance, ..
    } = relation.kind
    else {
        panic!("{relation:?}");
    };
    assert!(!inverse_distance);
}

#[test]
fn what_is_at_odds_is_refused() {
    let many = flock("").replace("count = 2", "count = 20_000_000");
    let seeing = flock("[[flock.relation]]\nkind = \"flock\"\n".repeat(2).as_str());
    let cases = [
        (
            flock("[[flock.relation]]\nkind = \"avoid\"\nother = \"b\""),
            "names a flock that is not there: \"b\"",
        ),
        (
            flock("[[flock.relation]]\nkind = \"avoid\""),
            "`flock.a.relation.0.other` is missing",
        ),
        (
            many.clone() + &many.replace("\"a\"", "\"b\""),
            "the flocks have 40000000 boids in all, too many",
        ),
        (
            seeing.replace("count = 2", "count = 20_000_000"),
            "may look at 40000000 boids",
        ),
        (
            flock(
                "edges = { kind = \"torus\", min = [0, 0, 0], max = [100, 300, 0] }\n\
                 [[flock.relation]]\nkind = \"flock\"",
            ),
            "sees 60 world units far in the torus of `flock.a`, which is 100 across",
        ),
        (
            flock("edges = { kind = \"wrap\", min = [0, 2, 0], max = [1, 1, 1] }"),
            "is less than `min` along y",
        ),
        (
            flock("dimensions = 3\n[[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"plane\""),
            "`flock.a.obstacle.0`: plane has open edges, so nothing is inside of it",
        ),
        (
            flock(&format!(
                "dimensions = 3\n{}",
                "[[flock.obstacle]]\nkind = \"mesh\"\nmesh = \"sphere\"\n".repeat(2)
            )),
            "the obstacles of `flock.a` have 10240 faces, too many",
        ),
        (flock("") + &flock(""), "already that of another flock"),
    ];
    for (flocks, wanted) in cases {
        let error = refused(&format!("{SCENE}{flocks}"));
        assert!(
            error.message().contains(wanted),
            "wants {wanted:?}:\n{error}"
        );
    }
}
