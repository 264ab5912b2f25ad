//! `motes check`: that it finds a defect put into one kernel, names the stage, the buffer and an
//! element, saves what a driver's writers need, and says so to whoever called it.

#[path = "../common/mod.rs"]
mod common;
mod located;
mod program;
mod saved;
mod sizes;

use motes::check::{CompareOptions, Outcome, compare};
use motes::gpu::{GpuBackend, GpuOptions, Mutation};
use motes::plan::Plan;
use naga::{BinaryOperator, Expression, Module};

/// Puts the operator `to` in the place of `from`; whether that was the expression's.
fn swap(expression: &mut Expression, from: BinaryOperator, to: BinaryOperator) -> bool {
    match expression {
        Expression::Binary { op, .. } if *op == from => {
            *op = to;
            true
        }
        _ => false,
    }
}

/// Makes the last addition of the kernel's entry point a subtraction.
fn subtract_last(module: &mut Module) {
    let expressions = &mut module.entry_points[0].function.expressions;
    let is_addition = |e: &Expression| {
        matches!(
            e,
            Expression::Binary {
                op: BinaryOperator::Add,
                ..
            }
        )
    };
    let last = expressions.iter_mut().rfind(|(_, e)| is_addition(e));
    let (_, expression) = last.expect("the kernel adds");
    assert!(swap(
        expression,
        BinaryOperator::Add,
        BinaryOperator::Subtract
    ));
}

/// The scene that reaches every branch of the kernels.
fn plan_of_everything() -> Plan {
    let scene = common::everything();
    Plan::new(&scene, scene.frames).expect("the scene can be planned")
}

/// Compares the first adapter, with one kernel changed, with the processor.
fn compare_with_mutant(
    plan: &Plan,
    kernel: &str,
    change: &dyn Fn(&mut Module),
    frames: u32,
) -> Outcome {
    let adapter = common::adapters().remove(0);
    let device = common::open(&adapter);
    let mut seen = Vec::new();
    let outcome = compare(
        plan,
        &mut || Ok(Box::new(common::on_cpu(plan))),
        &mut || {
            let mutation = Mutation { kernel, change };
            let mutant = GpuBackend::mutated(&device, plan, &GpuOptions::default(), mutation)?;
            Ok(Box::new(mutant))
        },
        &CompareOptions {
            frames,
            record: true,
        },
        &mut |frame| seen.push(frame),
    )
    .expect("the machine does not fail");
    assert_eq!(seen, (0..outcome.frames).collect::<Vec<_>>(), "progress");
    outcome
}
