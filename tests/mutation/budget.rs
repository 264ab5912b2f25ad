//! A bound on loops, so that a changed kernel cannot run for ever: naga's own is 2^64 rounds.

use naga::{
    BinaryOperator, Block, Expression as E, Function, Handle, Literal, LocalVariable, Module,
    Range, Scalar, Span, Statement, Type, TypeInner,
};

use crate::sites::walk_mut;

/// Every loop of every function breaks after the function has made `most` rounds in all its
/// loops; a kernel that makes fewer gives the same as without.
pub(crate) fn bound_loops(module: &mut Module, most: u32) {
    let word = Type {
        name: None,
        inner: TypeInner::Scalar(Scalar::U32),
    };
    let word = module.types.insert(word, Span::UNDEFINED);
    for (_, function) in module.functions.iter_mut() {
        bound(function, word, most);
    }
    for entry_point in &mut module.entry_points {
        bound(&mut entry_point.function, word, most);
    }
}

fn bound(function: &mut Function, word: Handle<Type>, most: u32) {
    let mut has_loops = false;
    walk_mut(&mut function.body, &mut 0, &mut |_, statement| {
        has_loops |= matches!(statement, Statement::Loop { .. });
    });
    if !has_loops {
        return;
    }
    let Function {
        expressions,
        local_variables,
        body,
        ..
    } = function;
    let mut put = |expression| expressions.append(expression, Span::UNDEFINED);
    let zero = put(E::Literal(Literal::U32(0)));
    let one = put(E::Literal(Literal::U32(1)));
    let most = put(E::Literal(Literal::U32(most)));
    let rounds = LocalVariable {
        name: Some("rounds".into()),
        ty: word,
        init: Some(zero),
    };
    let pointer = put(E::LocalVariable(
        local_variables.append(rounds, Span::UNDEFINED),
    ));
    walk_mut(body, &mut 0, &mut |_, statement| {
        let Statement::Loop { body, .. } = statement else {
            return;
        };
        let before = put(E::Load { pointer });
        let value = put(E::Binary {
            op: BinaryOperator::Add,
            left: before,
            right: one,
        });
        let condition = put(E::Binary {
            op: BinaryOperator::Greater,
            left: value,
            right: most,
        });
        let guard = [
            Statement::Emit(Range::new_from_bounds(before, condition)),
            Statement::Store { pointer, value },
            Statement::If {
                condition,
                accept: Block::from_vec(vec![Statement::Break]),
                reject: Block::new(),
            },
        ];
        body.splice(0..0, Block::from_vec(guard.into()));
    });
}
