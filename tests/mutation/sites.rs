//! Where a kernel can be changed, and how: literals, operators, comparisons, selections, branches,
//! components, functions, stores, in naga's IR.

use motes::gpu::shader;
use naga::valid::{Capabilities, FunctionInfo, ValidationFlags, Validator};
use naga::{
    AtomicFunction, BinaryOperator as Op, Block, Expression as E, Function, Handle, Literal,
    MathFunction as Mf, Module, Statement, TypeInner, UnaryOperator,
};

use crate::printed::Printer;

/// Which body a site is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Body {
    Constant,
    Function(Handle<Function>),
    EntryPoint,
}

/// What is changed.
#[derive(Clone, Debug, PartialEq)]
enum Change {
    /// An expression becomes another.
    Expression(Handle<E>, E),
    /// The branches of the n-th statement, counted in order of text, change places.
    SwapBranches(usize),
    /// The n-th statement is left out.
    Omit(usize),
    /// The n-th statement, an atomic addition, subtracts.
    Subtract(usize),
}

/// One change to one kernel.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    /// Function and expression before and after, for people and for the table of the explained.
    pub(crate) description: String,
    body: Body,
    change: Change,
}

/// Every change to what the module has from the libraries that `wanted` approves of; `None` is
/// the kernel's own file.
pub(crate) fn sites(module: &Module, wanted: &dyn Fn(Option<&str>) -> bool) -> Vec<Site> {
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .expect("the kernel is valid before it is changed");
    let mut sites = Vec::new();
    for (_, constant) in module.constants.iter() {
        let (library, name) = shader::origin(constant.name.as_deref().unwrap_or_default());
        if !wanted(library.as_deref()) {
            continue;
        }
        if let E::Literal(literal) = module.global_expressions[constant.init] {
            for (to, _) in literals(literal) {
                sites.push(Site {
                    description: format!("const {name}: {} -> {}", value(literal), value(to)),
                    body: Body::Constant,
                    change: Change::Expression(constant.init, E::Literal(to)),
                });
            }
        }
    }
    for (handle, function) in module.functions.iter() {
        let (library, name) = shader::origin(function.name.as_deref().unwrap_or_default());
        if wanted(library.as_deref()) {
            let of = &info[handle];
            collect(module, of, function, name, Body::Function(handle), &mut sites);
        }
    }
    if wanted(None) {
        let entry_point = &module.entry_points[0];
        let of = info.get_entry_point(0);
        let (name, body) = (&entry_point.name, Body::EntryPoint);
        collect(module, of, &entry_point.function, name, body, &mut sites);
    }
    sites
}

fn collect(
    module: &Module,
    of: &FunctionInfo,
    function: &Function,
    name: &str,
    body: Body,
    sites: &mut Vec<Site>,
) {
    let printer = Printer { module, function };
    for (handle, expression) in function.expressions.iter() {
        let inner_of = |handle: Handle<E>| of[handle].ty.inner_with(&module.types);
        for (to, what) in changes(module, expression, &inner_of) {
            let description = match expression {
                E::Literal(_) => {
                    let user = user_of(function, handle);
                    let place = user.map(|user| format!(" in {}", printer.deep(user)));
                    let place = place.unwrap_or_default();
                    format!("{name}: {} -> {what}{place}", printer.deep(handle))
                }
                _ => format!("{name}: {} -> {what}", printer.deep(handle)),
            };
            sites.push(Site { description, body, change: Change::Expression(handle, to) });
        }
    }
    let mut at = 0;
    walk(&function.body, &mut at, &mut |at, statement| {
        let mut push = |what: String, change| {
            sites.push(Site { description: format!("{name}: {what}"), body, change });
        };
        match statement {
            Statement::If { condition, .. } => {
                let condition = printer.deep(*condition);
                push(format!("if {condition} -> if !"), Change::SwapBranches(at));
            }
            Statement::Store { pointer, value } => {
                let (pointer, value) = (printer.deep(*pointer), printer.shallow(*value));
                push(format!("{pointer} = {value} -> omitted"), Change::Omit(at));
            }
            Statement::Atomic { pointer, fun: AtomicFunction::Add, .. } => {
                let pointer = printer.deep(*pointer);
                push(format!("atomicAdd({pointer}) -> atomicSub"), Change::Subtract(at));
            }
            _ => {}
        }
    });
}

/// The first expression that is made of this one.
fn user_of(function: &Function, handle: Handle<E>) -> Option<Handle<E>> {
    let uses = |expression: &E| match *expression {
        E::Binary { left, right, .. } => left == handle || right == handle,
        E::Unary { expr, .. } | E::As { expr, .. } => expr == handle,
        E::Select { condition, accept, reject } => [condition, accept, reject].contains(&handle),
        E::Math { arg, arg1, arg2, arg3, .. } => {
            [Some(arg), arg1, arg2, arg3].contains(&Some(handle))
        }
        E::Access { base, index } => base == handle || index == handle,
        E::Splat { value, .. } => value == handle,
        E::Compose { ref components, .. } => components.contains(&handle),
        _ => false,
    };
    function.expressions.iter().find(|(_, expression)| uses(expression)).map(|(user, _)| user)
}

/// Visits every statement in order of text, outer before inner, with its number.
fn walk(block: &Block, at: &mut usize, visit: &mut dyn FnMut(usize, &Statement)) {
    for statement in block.iter() {
        visit(*at, statement);
        *at += 1;
        match statement {
            Statement::Block(inner) => walk(inner, at, visit),
            Statement::If { accept, reject, .. } => {
                walk(accept, at, visit);
                walk(reject, at, visit);
            }
            Statement::Loop { body, continuing, .. } => {
                walk(body, at, visit);
                walk(continuing, at, visit);
            }
            Statement::Switch { cases, .. } => {
                cases.iter().for_each(|case| walk(&case.body, at, visit));
            }
            _ => {}
        }
    }
}

/// [`walk`], with leave to change what is visited.
pub(crate) fn walk_mut(
    block: &mut Block,
    at: &mut usize,
    visit: &mut dyn FnMut(usize, &mut Statement),
) {
    for statement in block.iter_mut() {
        let here = *at;
        *at += 1;
        match statement {
            Statement::Block(inner) => walk_mut(inner, at, visit),
            Statement::If { accept, reject, .. } => {
                walk_mut(accept, at, visit);
                walk_mut(reject, at, visit);
            }
            Statement::Loop { body, continuing, .. } => {
                walk_mut(body, at, visit);
                walk_mut(continuing, at, visit);
            }
            Statement::Switch { cases, .. } => {
                cases.iter_mut().for_each(|case| walk_mut(&mut case.body, at, visit));
            }
            _ => {}
        }
        visit(here, statement);
    }
}

fn value(literal: Literal) -> String {
    match literal {
        Literal::F32(x) => format!("{x:?}f"),
        Literal::U32(x) => format!("{x}u"),
        Literal::I32(x) => format!("{x}i"),
        other => format!("{other:?}"),
    }
}

/// Literals that are nearly this one.
fn literals(literal: Literal) -> Vec<(Literal, String)> {
    let to = match literal {
        Literal::F32(0.0) => vec![Literal::F32(1.0), Literal::F32(-1.0)],
        Literal::F32(x) => vec![Literal::F32(2.0 * x), Literal::F32(-x)],
        Literal::U32(x) => {
            vec![Literal::U32(x.wrapping_add(1)), Literal::U32(x.wrapping_sub(1))]
        }
        Literal::I32(x) => {
            vec![Literal::I32(x.wrapping_add(1)), Literal::I32(x.wrapping_sub(1))]
        }
        Literal::Bool(x) => vec![Literal::Bool(!x)],
        _ => vec![],
    };
    to.into_iter().map(|to| (to, value(to))).collect()
}

/// What an expression can become, and how to say it.
fn changes<'a>(
    module: &'a Module,
    expression: &E,
    inner_of: &dyn Fn(Handle<E>) -> &'a TypeInner,
) -> Vec<(E, String)> {
    match *expression {
        E::Literal(literal) => {
            literals(literal).into_iter().map(|(to, what)| (E::Literal(to), what)).collect()
        }
        E::Binary { op, left, right } => operators(op)
            .iter()
            .map(|&op| (E::Binary { op, left, right }, format!("{op:?}")))
            .collect(),
        E::Select { condition, accept, reject } => {
            let to = E::Select { condition, accept: reject, reject: accept };
            vec![(to, "swapped".to_owned())]
        }
        E::Unary { op, expr } => {
            let op = match op {
                UnaryOperator::Negate => Op::Add,
                UnaryOperator::LogicalNot => Op::LogicalAnd,
                UnaryOperator::BitwiseNot => Op::And,
            };
            vec![(E::Binary { op, left: expr, right: expr }, format!("{op:?} with itself"))]
        }
        E::Math { fun, arg, arg1, arg2, arg3 } => {
            let math = |fun| E::Math { fun, arg, arg1, arg2, arg3 };
            let to = match fun {
                Mf::Min => math(Mf::Max),
                Mf::Max => math(Mf::Min),
                Mf::Floor => math(Mf::Ceil),
                Mf::CountOneBits => math(Mf::CountTrailingZeros),
                Mf::Abs => E::Binary { op: Op::Add, left: arg, right: arg },
                Mf::Clamp => E::Math { fun, arg, arg1: arg2, arg2: arg1, arg3 },
                _ => return vec![],
            };
            vec![(to, format!("not {fun:?}"))]
        }
        E::AccessIndex { base, index } => neighbour(module, inner_of(base), index)
            .map(|to| {
                let to = E::AccessIndex { base, index: to };
                (to, format!("member {}", neighbour_name(module, inner_of(base), index)))
            })
            .into_iter()
            .collect(),
        E::Swizzle { size, vector, mut pattern } => {
            pattern.swap(0, 1);
            vec![(E::Swizzle { size, vector, pattern }, "swizzled".to_owned())]
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
        TypeInner::ValuePointer { size: Some(size), .. } => Some((index + 1) % *size as u32),
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

impl Site {
    /// Makes the change.
    pub(crate) fn apply(&self, module: &mut Module) {
        let function = match self.body {
            Body::Constant => {
                if let Change::Expression(handle, to) = &self.change {
                    module.global_expressions[*handle] = to.clone();
                }
                return;
            }
            Body::Function(handle) => &mut module.functions[handle],
            Body::EntryPoint => &mut module.entry_points[0].function,
        };
        let wanted = match &self.change {
            Change::Expression(handle, to) => {
                function.expressions[*handle] = to.clone();
                return;
            }
            Change::SwapBranches(at) | Change::Omit(at) | Change::Subtract(at) => *at,
        };
        walk_mut(&mut function.body, &mut 0, &mut |at, statement| {
            if at != wanted {
                return;
            }
            match statement {
                Statement::If { accept, reject, .. } => std::mem::swap(accept, reject),
                Statement::Atomic { fun, .. } => *fun = AtomicFunction::Subtract,
                omitted => *omitted = Statement::Block(Block::new()),
            }
        });
    }
}
