//! What must hold between values holds while they change.

use crate::text::{FULL, MINIMAL, accepted, line_of, refused, with};

#[test]
fn a_camera_that_changes_must_see_at_all_its_keys_and_frames() {
    // Key, its value, what is said, and the piece of the line that is shown.
    #[rustfmt::skip]
    let cases = [
        ("position", "{ keys = [[0, [0, 1, 5]], [10, [0, 0, 0]]] }",
            "`camera.position.keys.1`: at frame 10, `camera.target` is where `camera.position` is", "[10,"),
        ("position", "{ keys = [[0, [0, 0, 5]], [10, [0, 0, -5]]] }",
            "`camera.position.keys`: at frame 5, `camera.target` is where", "[[0, [0, 0, 5]]"),
        ("position", "{ keys = [[0, [0, 0, 5]], [10, [0, 0, 0]]], interpolation = 'step' }",
            "`camera.position.keys.1`: at frame 10, `camera.target` is where", "[10,"),
        ("target", "{ keys = [[-5, [0, 1, 5]], [10, [0, 0, 0]]] }",
            "`camera.target.keys.0`: at frame -5, `camera.target` is where", "[-5,"),
        ("target", "{ keys = [[0, [0, 0, 0]], [2.5, [0.5, 2, 5]]] }",
            "`camera.target.keys.1`: at frame 2.5, `camera.up` is parallel to the view", "[2.5,"),
        ("up", "{ keys = [[0, [0, 1, 0]], [6, [0, 1, 5]]] }",
            "`camera.up.keys.1`: at frame 6, `camera.up` is parallel to the view", "[6,"),
        ("up", "{ keys = [[0, [0, 1, 0]], [6, [0, 0, 0]]], interpolation = 'smooth' }",
            "`camera.up.keys.1`: at frame 6, `camera.up` is zero", "[6,"),
        ("up", "{ keys = [[0, [0, 1, 0]], [8, [0, -1, 0]]] }",
            "`camera.up.keys`: at frame 4, `camera.up` is zero", "[[0,"),
    ];
    for (key, value, message, piece) in cases {
        let text = with("camera", key, value);
        let error = refused(&text);
        assert!(error.message().contains(message), "{error}");
        assert!(!error.help().is_empty(), "{error}");
        assert_eq!(error.line(), Some(line_of("camera", key)), "{error}");
        let column = format!("{key} = {value}")
            .find(piece)
            .map(|index| index + 1);
        assert_eq!(error.column(), column, "{error}");
    }
    // Straight down with the up that nobody wrote.
    let target = "{ keys = [[0, [0, 0, 0]], [8, [0, -5, 5]]] }";
    let error = refused(&MINIMAL.replace("target = [0, 0, 0]", &format!("target = {target}")));
    let message = "`camera.target.keys.1`: at frame 8, `camera.up` is parallel";
    assert!(error.message().contains(message), "{error}");
    assert!(error.help().contains("up = [0, 0, -1]"), "{error}");
    // When the shutter closes, half a frame after 4.
    let text = FULL.replace("shutter = 0.48", "shutter = 0.5");
    let position = "position = { keys = [[0, [0, 0, 4.5]], [9, [0, 0, -4.5]]] }";
    let error = refused(&text.replace("position = [0, 1, 5]", position));
    assert!(
        error
            .message()
            .contains("at frame 4.5, `camera.target` is where"),
        "{error}"
    );
    // A jump over the target, and one who flies beside what they look at, never meet it.
    for value in [
        "{ keys = [[0, [0, 0, 5]], [10, [0, 0, -5]]], interpolation = 'step' }",
        "{ keys = [[0, [0.1, 0, 5]], [10, [0.1, 0, -5]]] }",
    ] {
        accepted(&with("camera", "position", value));
    }
    // The value to blame is shown, and not another with a key at that frame.
    let both = FULL
        .replace(
            "target = [0, 0, 0]",
            "target = { keys = [[0, [0, 0, 0]], [6, [1, 0, 0]]] }",
        )
        .replace(
            "up = [0.5, 1, 0]",
            "up = { keys = [[0, [0, 1, 0]], [6, [0, 0, 0]]] }",
        );
    let error = refused(&both);
    assert!(
        error
            .message()
            .contains("`camera.up.keys.1`: at frame 6, `camera.up`"),
        "{error}"
    );
    // Two that change, and meet in no key of both.
    let both = FULL
        .replace(
            "position = [0, 1, 5]",
            "position = { keys = [[0, [0, 0, 8]], [8, [0, 0, 0]]] }",
        )
        .replace(
            "target = [0, 0, 0]",
            "target = { keys = [[2, [0, 0, 0]], [6, [0, 0, 4]]] }",
        );
    let error = refused(&both);
    assert!(
        error
            .message()
            .contains("at frame 5, `camera.target` is where"),
        "{error}"
    );
}

#[test]
fn lifetimes_that_change_fit_a_particle_at_all_times() {
    #[rustfmt::skip]
    let cases = [
        ("{ mean = { keys = [[5, 65_000], [6, 1]] }, var = 1 }",
            "`system.first.lifetime.mean.keys.0`: at frame 5, `system.first.lifetime` reaches 65001 frames"),
        ("{ mean = { keys = [[0, 60], [20, 64_995]] }, var = 10 }",
            "`system.first.lifetime.mean.keys.1`: at frame 20, `system.first.lifetime` reaches 65005 frames"),
        ("{ mean = 60_000, var = { keys = [[0, 5_000], [1, 5_001]] } }",
            "`system.first.lifetime.var.keys.1`: at frame 1, `system.first.lifetime` reaches 65001 frames"),
        // At each key there is time enough, but not in the frame before the second.
        ("{ mean = { keys = [[0, 60_000], [10, 10]], interpolation = 'step' }, var = { keys = [[0, 0], [10, 10_000]] } }",
            "at frame 9, `system.first.lifetime` reaches 69000 frames"),
        // Only far from all keys is the smooth one ahead of the straight one that falls.
        ("{ mean = { keys = [[0, 1], [1000, 60_000]], interpolation = 'smooth' }, \
           var = { keys = [[0, 64_900], [1000, 4_900]] } }",
            "`system.first.lifetime.mean.keys`: at frame "),
    ];
    for (value, message) in cases {
        let error = refused(&with("system", "lifetime", value));
        assert!(error.message().contains(message), "{error}");
        assert!(error.message().contains("too many"), "{error}");
        assert!(error.help().contains("mean + var at most 65000"), "{error}");
        assert_eq!(error.line(), Some(line_of("system", "lifetime")), "{error}");
    }
    let most =
        "{ mean = { keys = [[0, 1], [9, 64_000]] }, var = { keys = [[0, 64_999], [9, 1000]] } }";
    accepted(&with("system", "lifetime", most));
}

#[test]
fn rings_that_change_keep_their_inner_circle_inside() {
    #[rustfmt::skip]
    let cases = [
        ("inner_radius = { keys = [[0, 0.5], [10, 2]] }, outer_radius = 1",
            "`system.first.generation_shape.inner_radius.keys.1`: at frame 10, `system.first.generation_shape.inner_radius` is 2"),
        ("inner_radius = { keys = [[-1, 2], [10, 0]] }, outer_radius = 1",
            "`system.first.generation_shape.inner_radius.keys.0`: at frame -1, `system.first.generation_shape.inner_radius` is 2"),
        ("inner_radius = 0.75, outer_radius = { keys = [[0, 1], [4, 0.5]] }",
            "`system.first.generation_shape.outer_radius.keys.1`: at frame 4, `system.first.generation_shape.inner_radius` is 0.75"),
        ("inner_radius = { keys = [[0, 2], [10, 0.5]], interpolation = 'step' }, outer_radius = { keys = [[0, 3], [10, 1]] }",
            "at frame 9, `system.first.generation_shape.inner_radius` is 2"),
    ];
    for (value, message) in cases {
        let value = format!("{{ kind = 'ring', {value} }}");
        let error = refused(&with("system", "generation_shape", &value));
        assert!(error.message().contains(message), "{error}");
        assert!(
            error.help().contains("at most outer_radius, which is "),
            "{error}"
        );
        let line = line_of("system", "generation_shape");
        assert_eq!(error.line(), Some(line), "{error}");
    }
    let growing = "{ kind = 'ring', inner_radius = { keys = [[0, 0], [9, 3]] }, \
                   outer_radius = { keys = [[0, 0], [9, 4]] } }";
    accepted(&with("system", "generation_shape", growing));
}
