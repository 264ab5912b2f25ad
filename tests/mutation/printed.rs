//! Expressions of naga's IR as text, near enough to WGSL to be recognised in the file.

use motes::gpu::shader;
use naga::{BinaryOperator as Op, Expression as E, Function, Handle, Literal, Module, TypeInner};

/// Prints the expressions of one function.
pub(crate) struct Printer<'a> {
    pub(crate) module: &'a Module,
    pub(crate) function: &'a Function,
}

impl Printer<'_> {
    /// The expression itself, with `let` names for what it is made of.
    pub(crate) fn deep(&self, handle: Handle<E>) -> String {
        self.print(handle, 4)
    }

    /// Its `let` name where it has one.
    pub(crate) fn shallow(&self, handle: Handle<E>) -> String {
        match self.function.named_expressions.get(&handle) {
            Some(name) => name.clone(),
            None => self.print(handle, 3),
        }
    }

    fn print(&self, handle: Handle<E>, depth: u32) -> String {
        if depth == 0 {
            return "_".to_owned();
        }
        let of = |handle: Handle<E>| match self.function.named_expressions.get(&handle) {
            Some(name) => name.clone(),
            None => self.print(handle, depth - 1),
        };
        let item =
            |name: &Option<String>| shader::origin(name.as_deref().unwrap_or("?")).1.to_owned();
        match &self.function.expressions[handle] {
            E::Literal(Literal::F32(x)) => format!("{x:?}f"),
            E::Literal(Literal::U32(x)) => format!("{x}u"),
            E::Literal(Literal::I32(x)) => format!("{x}i"),
            E::Literal(other) => format!("{other:?}"),
            E::Constant(constant) => item(&self.module.constants[*constant].name),
            E::FunctionArgument(index) => item(&self.function.arguments[*index as usize].name),
            E::GlobalVariable(global) => item(&self.module.global_variables[*global].name),
            E::LocalVariable(local) => item(&self.function.local_variables[*local].name),
            E::Load { pointer } => of(*pointer),
            E::AccessIndex { base, index } => {
                format!("{}.{}", of(*base), self.member(*base, *index))
            }
            E::Access { base, index } => format!("{}[{}]", of(*base), of(*index)),
            E::Splat { value, .. } => of(*value),
            E::Swizzle {
                vector,
                pattern,
                size,
            } => {
                let letters = pattern
                    .iter()
                    .take(*size as usize)
                    .map(|c| "xyzw".as_bytes()[*c as usize] as char);
                format!("{}.{}", of(*vector), letters.collect::<String>())
            }
            E::Unary { op, expr } => format!("{op:?}({})", of(*expr)),
            E::Binary { op, left, right } => {
                format!("({} {} {})", of(*left), sign(*op), of(*right))
            }
            E::Select {
                condition,
                accept,
                reject,
            } => {
                format!(
                    "select({}, {}, {})",
                    of(*reject),
                    of(*accept),
                    of(*condition)
                )
            }
            E::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => {
                let rest = [arg1, arg2]
                    .into_iter()
                    .flatten()
                    .map(|arg| format!(", {}", of(*arg)));
                format!("{fun:?}({}{})", of(*arg), rest.collect::<String>())
            }
            E::As { expr, kind, .. } => format!("{kind:?}({})", of(*expr)),
            E::CallResult(function) => {
                format!("{}()", item(&self.module.functions[*function].name))
            }
            E::Compose { components, .. } => {
                let parts: Vec<_> = components.iter().map(|part| of(*part)).collect();
                format!("({})", parts.join(", "))
            }
            E::AtomicResult { .. } => "atomic".to_owned(),
            other => format!("{other:?}")
                .split([' ', '('])
                .next()
                .unwrap_or("?")
                .to_owned(),
        }
    }

    fn member(&self, base: Handle<E>, index: u32) -> String {
        let ty = match &self.function.expressions[base] {
            E::GlobalVariable(global) => Some(self.module.global_variables[*global].ty),
            E::FunctionArgument(at) => Some(self.function.arguments[*at as usize].ty),
            E::LocalVariable(local) => Some(self.function.local_variables[*local].ty),
            E::Access { base, .. } => match self.function.expressions[*base] {
                E::GlobalVariable(global) => {
                    match self.module.types[self.module.global_variables[global].ty].inner {
                        TypeInner::Array { base, .. } => Some(base),
                        _ => None,
                    }
                }
                _ => None,
            },
            _ => None,
        };
        let named = ty.and_then(|ty| match &self.module.types[ty].inner {
            TypeInner::Struct { members, .. } => members.get(index as usize)?.name.clone(),
            _ => None,
        });
        named.unwrap_or_else(|| index.to_string())
    }
}

fn sign(op: Op) -> &'static str {
    match op {
        Op::Add => "+",
        Op::Subtract => "-",
        Op::Multiply => "*",
        Op::Divide => "/",
        Op::Modulo => "%",
        Op::Equal => "==",
        Op::NotEqual => "!=",
        Op::Less => "<",
        Op::LessEqual => "<=",
        Op::Greater => ">",
        Op::GreaterEqual => ">=",
        Op::And => "&",
        Op::ExclusiveOr => "^",
        Op::InclusiveOr => "|",
        Op::LogicalAnd => "&&",
        Op::LogicalOr => "||",
        Op::ShiftLeft => "<<",
        Op::ShiftRight => ">>",
    }
}
