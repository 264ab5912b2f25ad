//! Which floats are certain to be snapped: neither denormal nor the negative zero.
//!
//! A value is snapped if `motes::exact::snap…` made it, if it is such a literal, if it was loaded
//! from storage (where only snapped values are ever stored), or if it is put together or selected
//! from snapped values. A local variable is snapped if all that is ever stored into it is; a
//! function's result, if every value that it returns is.

use std::collections::{HashMap, HashSet};

use naga::{AddressSpace, Block, Expression as E, Handle, Literal, LocalVariable, Statement};
use naga::{ScalarKind, Type, TypeInner, valid::ModuleInfo};

use super::mangle;
use super::rules::Body;

/// The least magnitude that snapping keeps, 2^-40.
const LEAST: f32 = 9.094_947e-13;

/// What is known of one function's values.
pub(super) struct Snapped<'a> {
    body: &'a Body<'a>,
    infos: &'a ModuleInfo,
    /// Values stored into each local variable or a part of it.
    stored: HashMap<Handle<LocalVariable>, Vec<Handle<E>>>,
    /// Local variables that other functions may write to.
    lent: HashSet<Handle<LocalVariable>>,
    returned: Vec<Handle<E>>,
}

impl<'a> Snapped<'a> {
    pub(super) fn new(body: &'a Body<'a>, infos: &'a ModuleInfo) -> Self {
        let mut this = Self {
            body,
            infos,
            stored: HashMap::new(),
            lent: HashSet::new(),
            returned: Vec::new(),
        };
        this.collect(&body.function.body);
        this
    }

    fn collect(&mut self, block: &Block) {
        for statement in block.iter() {
            match statement {
                Statement::Store { pointer, value } => {
                    if let Some(local) = self.local_behind(*pointer) {
                        self.stored.entry(local).or_default().push(*value);
                    }
                }
                Statement::Call { arguments, .. } => {
                    let locals = arguments.iter().filter_map(|a| self.local_behind(*a));
                    let locals: Vec<_> = locals.collect();
                    self.lent.extend(locals);
                }
                Statement::Return { value: Some(value) } => self.returned.push(*value),
                _ => {}
            }
            for inner in inner_blocks(statement) {
                self.collect(inner);
            }
        }
    }

    /// The local variable that a pointer points into.
    fn local_behind(&self, pointer: Handle<E>) -> Option<Handle<LocalVariable>> {
        match self.body.function.expressions[pointer] {
            E::LocalVariable(local) => Some(local),
            E::Access { base, .. } | E::AccessIndex { base, .. } => self.local_behind(base),
            _ => None,
        }
    }

    /// Whether every float in a value is certain to be snapped.
    pub(super) fn is_snapped(&self, value: Handle<E>) -> bool {
        self.holds(value, &mut HashSet::new())
    }

    /// As [`Self::is_snapped`], taking for granted what is asked of the variables in `assumed`.
    fn holds(&self, value: Handle<E>, assumed: &mut HashSet<Handle<LocalVariable>>) -> bool {
        let Body {
            module, function, ..
        } = *self.body;
        if !contains_float(&module.types, self.body.type_of(value)) {
            return true;
        }
        match &function.expressions[value] {
            E::Literal(literal) => is_snapped_literal(*literal),
            E::ZeroValue(_) => true,
            E::Constant(constant) => is_snapped_global(module, module.constants[*constant].init),
            E::Compose { components, .. } => components.iter().all(|c| self.holds(*c, assumed)),
            E::Splat { value: part, .. }
            | E::Swizzle { vector: part, .. }
            | E::Access { base: part, .. }
            | E::AccessIndex { base: part, .. } => self.holds(*part, assumed),
            E::Select { accept, reject, .. } => {
                self.holds(*accept, assumed) && self.holds(*reject, assumed)
            }
            E::Load { pointer } => match (space_of(self.body.type_of(*pointer)), pointer) {
                (Some(AddressSpace::Storage { .. }), _) => true,
                (Some(AddressSpace::Function), pointer) => self
                    .local_behind(*pointer)
                    .is_some_and(|local| self.local_holds(local, assumed)),
                _ => false,
            },
            E::CallResult(callee) => self.result_holds(*callee),
            _ => false,
        }
    }

    fn local_holds(
        &self,
        local: Handle<LocalVariable>,
        assumed: &mut HashSet<Handle<LocalVariable>>,
    ) -> bool {
        if self.lent.contains(&local) {
            return false;
        }
        if !assumed.insert(local) {
            return true;
        }
        let init = self.body.function.local_variables[local].init;
        let stored = self.stored.get(&local).into_iter().flatten();
        let mut values = init.iter().chain(stored);
        values.all(|value| self.holds(*value, assumed))
    }

    fn result_holds(&self, callee: Handle<naga::Function>) -> bool {
        let module = self.body.module;
        let function = &module.functions[callee];
        let (path, item) = mangle::split(function.name.as_deref().unwrap_or_default());
        if path.as_deref() == Some("motes::exact") && item.starts_with("snap") {
            return true;
        }
        let body = Body {
            module,
            function,
            info: &self.infos[callee],
            trusted: false,
        };
        let snapped = Snapped::new(&body, self.infos);
        snapped
            .returned
            .iter()
            .all(|value| snapped.is_snapped(*value))
    }
}

/// The blocks inside a statement.
pub(super) fn inner_blocks(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        Statement::Loop {
            body, continuing, ..
        } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// The address space of a pointer.
pub(super) fn space_of(pointer: &TypeInner) -> Option<AddressSpace> {
    match *pointer {
        TypeInner::Pointer { space, .. } | TypeInner::ValuePointer { space, .. } => Some(space),
        _ => None,
    }
}

fn contains_float(types: &naga::UniqueArena<Type>, inner: &TypeInner) -> bool {
    match inner {
        TypeInner::Scalar(scalar)
        | TypeInner::Vector { scalar, .. }
        | TypeInner::Atomic(scalar) => scalar.kind == ScalarKind::Float,
        TypeInner::Array { base, .. } => contains_float(types, &types[*base].inner),
        TypeInner::Struct { members, .. } => {
            let mut members = members.iter();
            members.any(|member| contains_float(types, &types[member.ty].inner))
        }
        _ => true,
    }
}

fn is_snapped_literal(literal: Literal) -> bool {
    match literal {
        Literal::F32(x) => x.to_bits() == 0 || x.is_finite() && x.abs() >= LEAST,
        _ => false,
    }
}

fn is_snapped_global(module: &naga::Module, value: Handle<E>) -> bool {
    match &module.global_expressions[value] {
        E::Literal(Literal::F64(_) | Literal::F16(_)) => false,
        E::Literal(literal @ Literal::F32(_)) => is_snapped_literal(*literal),
        E::Literal(_) | E::ZeroValue(_) => true,
        E::Constant(other) => is_snapped_global(module, module.constants[*other].init),
        E::Splat { value, .. } => is_snapped_global(module, *value),
        E::Compose { components, .. } => {
            let mut components = components.iter();
            components.all(|component| is_snapped_global(module, *component))
        }
        _ => false,
    }
}
