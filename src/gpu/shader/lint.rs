//! The lint that makes exactness a build error instead of a hope.
//!
//! Every function that a kernel brings along is read in naga's IR. Its expressions must be on the
//! allow-list of `rules.rs`; every float that it stores to storage must be snapped
//! (`snapped.rs`); its types must be integers, booleans and 32-bit floats, alone, in vectors,
//! arrays and structs. What the IR does not show is looked for in the text (`text.rs`). All
//! findings are collected.

use naga::valid::ModuleInfo;
use naga::{AddressSpace, Block, Handle, ScalarKind, Span, Statement, Type, TypeInner};

use super::compose::{Composed, finding};
use super::error::{Finding, ShaderError, Step};
use super::rules::Body;
use super::snapped::{Snapped, inner_blocks, space_of};
use super::{mangle, text};

/// Libraries whose functions may compare, floor, convert and take the bits of floats.
const TRUSTED: [&str; 3] = ["motes::exact", "motes::transcendental", "motes::rng"];

/// Refuses a composed shader that drivers may compute differently.
pub(super) fn lint(name: &str, composed: &Composed) -> Result<(), ShaderError> {
    let mut lint = Lint {
        composed,
        findings: Vec::new(),
    };
    for (file, text) in &composed.texts {
        lint.findings.extend(text::check(file, text));
    }
    lint.declarations();
    let Composed { module, info, .. } = composed;
    for (handle, function) in module.functions.iter() {
        let (path, _) = mangle::split(function.name.as_deref().unwrap_or_default());
        let path = path.as_ref().or(composed.own_path.as_ref());
        let body = Body {
            module,
            function,
            info: &info[handle],
            trusted: path.is_some_and(|p| TRUSTED.contains(&p.as_str())),
        };
        lint.function(&body, info, module.functions.get_span(handle));
    }
    for (i, entry_point) in module.entry_points.iter().enumerate() {
        let body = Body {
            module,
            function: &entry_point.function,
            info: info.get_entry_point(i),
            trusted: false,
        };
        lint.function(&body, info, Span::UNDEFINED);
    }
    if lint.findings.is_empty() {
        Ok(())
    } else {
        Err(ShaderError::new(name, Step::Lint, lint.findings))
    }
}

struct Lint<'a> {
    composed: &'a Composed,
    findings: Vec<Finding>,
}

impl Lint<'_> {
    fn refuse(&mut self, span: Span, found: &str, instead: &str) {
        let finding = finding(&self.composed.locator, span, found, instead);
        self.findings.push(finding);
    }

    /// Structs and global variables.
    fn declarations(&mut self) {
        let module = &self.composed.module;
        for (handle, ty) in module.types.iter() {
            if matches!(ty.inner, TypeInner::Struct { .. }) {
                self.judge_type(&ty.inner, module.types.get_span(handle));
            }
        }
        for (handle, global) in module.global_variables.iter() {
            let inner = &module.types[global.ty].inner;
            self.judge_type(inner, module.global_variables.get_span(handle));
        }
        for (handle, _) in module.overrides.iter() {
            let instead = "write #{WORKGROUP_SIZE}u, or use an immediate";
            self.refuse(module.overrides.get_span(handle), "an override", instead);
        }
    }

    fn judge_type(&mut self, inner: &TypeInner, span: Span) {
        if let Some((found, instead)) = inexact_type(&self.composed.module.types, inner) {
            self.refuse(span, found, instead);
        }
    }

    /// One function; `span` is where it is declared.
    fn function(&mut self, body: &Body, infos: &ModuleInfo, span: Span) {
        let types = &body.module.types;
        let arguments = body.function.arguments.iter().map(|a| a.ty);
        let result = body.function.result.iter().map(|r| r.ty);
        for ty in arguments.chain(result) {
            self.judge_type(&types[ty].inner, span);
        }
        for (handle, local) in body.function.local_variables.iter() {
            let at = body.function.local_variables.get_span(handle);
            self.judge_type(&types[local.ty].inner, or(at, span));
        }
        for (handle, _) in body.function.expressions.iter() {
            let at = or(body.function.expressions.get_span(handle), span);
            if inexact_type(types, body.type_of(handle)).is_some() {
                // Says more than the operation on it could.
                self.judge_type(body.type_of(handle), at);
            } else if let Err((found, instead)) = body.judge(handle) {
                self.refuse(at, &found, instead);
            }
        }
        let snapped = Snapped::new(body, infos);
        self.statements(body, &snapped, &body.function.body, span);
    }

    fn statements(&mut self, body: &Body, snapped: &Snapped, block: &Block, declared: Span) {
        for (statement, span) in block.span_iter() {
            let at = or(*span, declared);
            match statement {
                Statement::Store { pointer, value } => {
                    let space = space_of(body.type_of(*pointer));
                    let is_storage = matches!(space, Some(AddressSpace::Storage { .. }));
                    if is_storage && !snapped.is_snapped(*value) {
                        let instead = "store motes::exact::snap of it, or its bits_of as u32";
                        self.refuse(at, "a float stored without being snapped", instead);
                    }
                }
                Statement::Emit(_)
                | Statement::Block(_)
                | Statement::If { .. }
                | Statement::Switch { .. }
                | Statement::Loop { .. }
                | Statement::Break
                | Statement::Continue
                | Statement::Return { .. }
                | Statement::ControlBarrier(_)
                | Statement::MemoryBarrier(_)
                | Statement::Atomic { .. }
                | Statement::WorkGroupUniformLoad { .. }
                | Statement::Call { .. } => {}
                _ => {
                    let found = "a statement that is not on the list of exact ones";
                    self.refuse(at, found, "use buffers, atomics of integers and barriers");
                }
            }
            for inner in inner_blocks(statement) {
                self.statements(body, snapped, inner, declared);
            }
        }
    }
}

/// What is wrong with a type, if anything.
fn inexact_type(
    types: &naga::UniqueArena<Type>,
    inner: &TypeInner,
) -> Option<(&'static str, &'static str)> {
    let of = |ty: Handle<Type>| inexact_type(types, &types[ty].inner);
    match inner {
        TypeInner::Atomic(scalar) if scalar.kind == ScalarKind::Float => Some((
            "an atomic float",
            "add integers, whose sum does not depend on order",
        )),
        TypeInner::Scalar(scalar)
        | TypeInner::Vector { scalar, .. }
        | TypeInner::ValuePointer { scalar, .. }
        | TypeInner::Atomic(scalar) => {
            let wrong = scalar.kind == ScalarKind::Float && scalar.width != 4;
            wrong.then_some(("a float that is not f32", "use f32"))
        }
        TypeInner::Matrix { .. } => Some((
            "a matrix",
            "keep rows as vectors and use motes::exact::dot3",
        )),
        TypeInner::Pointer { base, .. } | TypeInner::Array { base, .. } => of(*base),
        TypeInner::Struct { members, .. } => members.iter().find_map(|m| of(m.ty)),
        _ => Some((
            "a type that is neither number, vector, array nor struct",
            "use storage and uniform buffers",
        )),
    }
}

/// A span, or another where it is unknown.
fn or(span: Span, other: Span) -> Span {
    if span.is_defined() { span } else { other }
}
