//! Where a defect of each kernel is found.

use motes::check::{CompareOptions, Place, compare};
use motes::gpu::{GpuBackend, GpuOptions, Mutation};
use naga::{BinaryOperator, Expression, Literal, Module};

use crate::{common, compare_with_mutant, plan_of_everything, subtract_last, swap};

/// Changes every expression of the module that `change` finds to its liking, which must be some,
/// so that a mutant is never the original.
fn mutate(module: &mut Module, change: impl Fn(&mut Expression) -> bool) {
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entry_points = module
        .entry_points
        .iter_mut()
        .map(|entry| &mut entry.function);
    let changed = functions
        .chain(entry_points)
        .flat_map(|function| function.expressions.iter_mut())
        .map(|(_, expression)| change(expression))
        .filter(|&changed| changed)
        .count();
    assert!(
        changed > 0,
        "the kernel has changed: choose the mutation anew"
    );
}

/// Puts the literal `to` in the place of `from`; whether that was the expression's.
fn replace(expression: &mut Expression, from: f32, to: f32) -> bool {
    match expression {
        Expression::Literal(Literal::F32(value)) if *value == from => {
            *value = to;
            true
        }
        _ => false,
    }
}

/// The function whose name has that in it.
fn function_named<'a>(module: &'a mut Module, name: &str) -> &'a mut naga::Function {
    let is_named = |f: &&mut naga::Function| f.name.as_deref().is_some_and(|n| n.contains(name));
    let functions = module.functions.iter_mut().map(|(_, f)| f);
    functions.into_iter().find(is_named).expect("it is there")
}

/// The place that check names for a mutant, and the first frame that differs.
fn place_of_mutant(kernel: &str, change: &dyn Fn(&mut Module)) -> (u32, Place) {
    let outcome = compare_with_mutant(&plan_of_everything(), kernel, change, 16);
    let difference = outcome
        .difference
        .unwrap_or_else(|| panic!("{kernel}: nothing was found"));
    let place = difference
        .place
        .unwrap_or_else(|| panic!("{kernel}: it was not located"));
    assert!(place.differing_words > 0, "{kernel}");
    let at = place.element.word;
    assert_eq!(
        place.expected.get(at).copied(),
        place.element.expected,
        "{kernel}"
    );
    assert_eq!(place.got.get(at).copied(), place.element.got, "{kernel}");
    assert_ne!(place.element.expected, place.element.got, "{kernel}");
    assert_eq!(
        place.expected[..at],
        place.got[..at],
        "{kernel}: it is not the first"
    );
    assert_eq!(difference.frame + 1, outcome.frames, "{kernel}: it went on");
    (difference.frame, place)
}

#[test]
fn without_a_defect_nothing_is_found() {
    let plan = plan_of_everything();
    let outcome = compare_with_mutant(&plan, "particles/advance", &|_| {}, 16);
    assert_eq!(outcome.difference, None);
    assert_eq!(outcome.frames, 16);
    assert!(outcome.most_particles > 1000, "{outcome:?}");
}

#[test]
fn a_defect_of_births_is_found_there() {
    let (frame, place) = place_of_mutant("systems/births", &|module| {
        mutate(module, |e| replace(e, 0.5, 1.5));
    });
    assert_eq!((place.stage, place.buffer), ("births", "birth_counts"));
    assert_eq!(
        frame, 0,
        "system 0 rounds to the nearest, and bears one more"
    );
    assert_eq!(place.element.record, 0);
    let (expected, got) = (place.element.expected, place.element.got);
    assert_eq!(expected.map(|count| count + 1), got);
    assert_eq!(place.other_buffers, ["birth_offsets", "counts"]);
}

#[test]
fn a_defect_of_emit_is_found_there() {
    // Cones of ejection open too far.
    let (frame, place) = place_of_mutant("particles/emit", &|module| {
        let ejected = function_named(module, "ejected");
        let changed = ejected.expressions.iter_mut();
        let changed = changed.filter_map(|(_, e)| replace(e, 1.0, 0.75).then_some(()));
        assert!(changed.count() > 0);
    });
    assert_eq!((place.stage, place.buffer, frame), ("emit", "particles", 0));
    assert!(
        place.element.field.starts_with("velocity"),
        "{}",
        place.element
    );
    assert!(place.element.is_float);
}

#[test]
fn a_defect_of_cull_is_found_there() {
    let (_, place) = place_of_mutant("particles/cull", &|module| {
        // age >= lifetime becomes age > lifetime.
        let fate_of = function_named(module, "fate_of");
        let changed = fate_of.expressions.iter_mut().filter_map(|(_, e)| {
            swap(e, BinaryOperator::GreaterEqual, BinaryOperator::Greater).then_some(())
        });
        assert_eq!(changed.count(), 1);
    });
    assert_eq!((place.stage, place.buffer), ("cull", "alive_bits"));
    let (expected, got) = (place.element.expected, place.element.got);
    let spared = expected.zip(got).map(|(expected, got)| got & !expected);
    assert!(
        spared.is_some_and(|bits| bits != 0),
        "the mutant spares who has had its time"
    );
}

#[test]
fn a_defect_of_advance_is_found_there() {
    // The velocity less the acceleration.
    let (frame, place) = place_of_mutant("particles/advance", &subtract_last);
    assert_eq!(
        (place.stage, place.buffer, frame),
        ("advance", "particles", 0)
    );
    assert_eq!(
        (place.element.record, place.element.field),
        (0, "velocity.x")
    );
    let text = place.element.to_string();
    let bits = place.element.got.expect("there is such a particle");
    assert!(
        text.contains(&format!("{bits:#010x} ({:e})", f32::from_bits(bits))),
        "{text}"
    );
}

#[test]
fn a_defect_of_the_scan_is_found_in_the_stage_that_it_serves() {
    let (_, place) = place_of_mutant("scan/survivors", &|module| {
        mutate(module, |e| {
            swap(e, BinaryOperator::Subtract, BinaryOperator::Add)
        });
    });
    assert_eq!((place.stage, place.buffer), ("advance", "counts"));
    assert_eq!(place.element.field, "died");
}

#[test]
fn a_defect_of_splat_is_found_there() {
    let (frame, place) = place_of_mutant("draw/splat", &|module| {
        mutate(module, |e| replace(e, 0.083_333_336, 0.5));
    });
    assert_eq!(
        (place.stage, place.buffer, frame),
        ("splat", "light_low", 0)
    );
    let (x, y) = place.element.pixel.expect("it is a picture");
    assert!(x < 161 && y < 91);
    assert_eq!(place.element.record, (y * 161 + x) as usize);
    assert_eq!(
        place.element.field,
        ["red", "green", "blue"][place.element.word % 3]
    );
}

#[test]
fn a_defect_of_resolve_is_found_there() {
    let (frame, place) = place_of_mutant("draw/resolve", &|module| {
        mutate(module, |e| replace(e, 255.0, 254.0));
    });
    assert_eq!((place.stage, place.buffer, frame), ("resolve", "image", 0));
}

#[test]
fn a_defect_of_the_digest_is_told_from_one_of_the_state() {
    let (frame, place) = place_of_mutant("digest/digest", &|module| {
        let expressions = &mut module.entry_points[0].function.expressions;
        let changed = expressions.iter_mut().filter_map(|(_, e)| {
            swap(e, BinaryOperator::ExclusiveOr, BinaryOperator::InclusiveOr).then_some(())
        });
        assert_eq!(
            changed.count(),
            1,
            "the kernel mixes words in by exclusive or"
        );
    });
    assert_eq!((place.stage, place.buffer, frame), ("digest", "digest", 0));
}

#[test]
fn a_difference_that_happens_once_is_still_told() {
    let plan = plan_of_everything();
    let device = common::open(&common::adapters()[0]);
    let mut starts = 0;
    let outcome = compare(
        &plan,
        &mut || Ok(Box::new(common::on_cpu(&plan))),
        &mut || {
            starts += 1;
            let mutation = Mutation {
                kernel: "particles/advance",
                change: &subtract_last,
            };
            let options = GpuOptions::default();
            Ok(Box::new(if starts == 1 {
                GpuBackend::mutated(&device, &plan, &options, mutation)?
            } else {
                common::on_gpu(&device, &plan, &options)
            }))
        },
        &CompareOptions {
            frames: 3,
            record: true,
        },
        &mut |_| {},
    )
    .expect("the machine does not fail");
    let difference = outcome.difference.expect("it was there");
    assert_eq!((difference.frame, difference.place.is_none()), (0, true));
    assert!(
        difference.to_string().contains("on timing or on chance"),
        "{difference}"
    );
}
