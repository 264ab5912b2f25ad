//! What one expression can be changed to.

use naga::{
    BinaryOperator as Op, Expression as E, Handle, Literal, MathFunction as Mf, Module, TypeInner,
    UnaryOperator,
};

/// A literal as WGSL has it.
pub(crate) fn value(literal: Literal) -> String {
    match literal {
        Literal::F32(x) => format!("{x:?}f"),
        Literal::U32(x) => format!("{x}u"),
        Literal::I32(x) => format!("{x}i"),
        other => format!("{other:?}"),
    }
}

/// Literals that are nearly this one.
pub(crate) fn literals(literal: Literal) -> Vec<(Literal, String)> {
    let to = match literal {
        Literal::F32(0.0) => vec![Literal::F32(1.0), Literal::F32(-1.0)],
        Literal::F32(x) => vec![Literal::F32(2.0 * x), Literal::F32(-x)],
        Literal::U32(x) => {
            vec![
                Literal::U32(x.wrapping_add(1)),
                Literal::U32(x.wrapping_sub(1)),
            ]
        }
        Literal::I32(x) => {
            vec![
                Literal::I32(x.wrapping_add(1)),
                Literal::I32(x.wrapping_sub(1)),
            ]
        }
        Literal::Bool(x) => vec![Literal::Bool(!x)],
        _ => vec![],
    };
    to.into_iter().map(|to| (to, value(to))).collect()
}

/// What an expression can become, and how to say it.
pub(crate) fn changes<'a>(
    module: &'a Module,
    expression: &E,
    inner_of: &dyn Fn(Handle<E>) -> &'a TypeInner,
) -> Vec<(E, String)> {
    match *expression {
        E::Literal(literal) => literals(literal)
            .into_iter()
            .map(|(to, what)| (E::Literal(to), what))
            .collect(),
        E::Binary { op, left, right } => operators(op)
            .iter()
            .map(|&op| (E::Binary { op, left, right }, format!("{op:?}")))
            .collect(),
        E::Select {
            condition,
            accept,
            reject,
        } => {
            let to = E::Select {
                condition,
                accept: reject,
                reject: accept,
            };
            vec![(to, "swapped".to_owned())]
        }
        E::Unary { op, expr } => {
            let op = match op {
                UnaryOperator::Negate => Op::Add,
                UnaryOperator::LogicalNot => Op::LogicalAnd,
                UnaryOperator::BitwiseNot => Op::And,
            };
            vec![(
                E::Binary {
                    op,
                    left: expr,
                    right: expr,
                },
                format!("{op:?} with itself"),
            )]
        }
        E::Math {
            fun,
            arg,
            arg1,
            arg2,
            arg3,
        } => {
            let math = |fun| E::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            };
            let to = match fun {
                Mf::Min => math(Mf::Max),
                Mf::Max => math(Mf::Min),
                Mf::Floor => math(Mf::Ceil),
                Mf::CountOneBits => math(Mf::CountTrailingZeros),
                Mf::Abs => E::Binary {
                    op: Op::Add,
                    left: arg,
                    right: arg,
                },
                Mf::Clamp => E::Math {
                    fun,
                    arg,
                    arg1: arg2,
                    arg2: arg1,
                    arg3,
                },
                _ => return vec![],
            };
            vec![(to, format!("not {fun:?}"))]
        }
        E::AccessIndex { base, index } => neighbour(module, inner_of(base), index)
            .map(|to| {
                let to = E::AccessIndex { base, index: to };
                (
                    to,
                    format!("member {}", neighbour_name(module, inner_of(base), index)),
                )
            })
            .into_iter()
            .collect(),
        E::Swizzle {
            size,
            vector,
            mut pattern,
        } => {
            pattern.swap(0, 1);
            vec![(
                E::Swizzle {
                    size,
                    vector,
                    pattern,
                },
                "swizzled".to_owned(),
            )]
        }
        _ => vec![],
    }
}

fn operators(op: Op) -> &'static [Op] {
    match op {
        Op::Add => &[Op::Subtract],
        Op::Subtract => &[Op::Add],
        Op::Multiply => &[Op::Add],
        Op::Divide => &[Op::Multiply],
        Op::Modulo => &[Op::Divide],
        Op::Less => &[Op::LessEqual, Op::GreaterEqual],
        Op::LessEqual => &[Op::Less, Op::Greater],
        Op::Greater => &[Op::GreaterEqual, Op::LessEqual],
        Op::GreaterEqual => &[Op::Greater, Op::Less],
        Op::Equal => &[Op::NotEqual],
        Op::NotEqual => &[Op::Equal],
        Op::And => &[Op::InclusiveOr],
        Op::InclusiveOr => &[Op::And],
        Op::ExclusiveOr => &[Op::And],
        Op::LogicalAnd => &[Op::LogicalOr],
        Op::LogicalOr => &[Op::LogicalAnd],
        Op::ShiftLeft => &[Op::ShiftRight],
        Op::ShiftRight => &[Op::ShiftLeft],
    }
}

/// The next member of the same type, going round.
fn neighbour(module: &Module, base: &TypeInner, index: u32) -> Option<u32> {
    let base = match *base {
        TypeInner::Pointer { base, .. } => &module.types[base].inner,
        ref other => other,
    };
    match base {
        TypeInner::Vector { size, .. } => Some((index + 1) % *size as u32),
        TypeInner::ValuePointer {
            size: Some(size), ..
        } => Some((index + 1) % *size as u32),
        TypeInner::Struct { members, .. } => {
            let len = members.len() as u32;
            (1..len)
                .map(|step| (index + step) % len)
                .find(|to| members[*to as usize].ty == members[index as usize].ty)
        }
        _ => None,
    }
}

fn neighbour_name(module: &Module, base: &TypeInner, index: u32) -> String {
    let to = neighbour(module, base, index).unwrap_or(index);
    let base = match *base {
        TypeInner::Pointer { base, .. } => &module.types[base].inner,
        ref other => other,
    };
    match base {
        TypeInner::Struct { members, .. } => members[to as usize].name.clone().unwrap_or_default(),
        _ => ["x", "y", "z", "w"][to as usize % 4].to_owned(),
    }
}
