//! Where a kernel can be changed, and how: literals, operators, comparisons, selections, branches,
//! components, functions, stores, in naga's IR.

use std::cell::RefCell;
use std::collections::HashMap;

use motes::gpu::shader::{self, CompileOptions, CompiledKernel, ShaderError};
use naga::valid::{Capabilities, FunctionInfo, ValidationFlags, Validator};
use naga::{
    AtomicFunction, Block, Expression as E, Function, Handle, Literal, Module, Span, Statement,
};

use crate::changes::{changes, literals, value};
use crate::printed::Printer;

/// Which body a site is in.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Body {
    /// Of the module, by name: a number that two constants have is one expression, or two.
    Constant(String),
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
    /// How many of the same description come before it in the same kernel.
    occurrence: usize,
    body: Body,
    change: Change,
}

/// Compiles a kernel.
pub(crate) type Compile<'a> = &'a dyn Fn(&CompileOptions) -> Result<CompiledKernel, ShaderError>;

/// Every change to what a kernel, compiled without the switches `off`, has from the libraries that
/// `wanted` approves of.
pub(crate) fn of_kernel(
    compile: Compile,
    off: &[&'static str],
    wanted: &dyn Fn(Option<&str>) -> bool,
) -> Vec<Site> {
    let found = RefCell::new(Vec::new());
    // A look at the module as it is when changes are made.
    let look = |module: &mut Module| *found.borrow_mut() = sites(module, wanted);
    compile(&CompileOptions {
        mutate: Some(&look),
        off,
        wide: true,
        ..CompileOptions::default()
    })
    .expect("the kernel compiles");
    let mut found = found.into_inner();
    let mut seen: HashMap<String, usize> = HashMap::new();
    for site in &mut found {
        let before = seen.entry(site.description.clone()).or_default();
        site.occurrence = *before;
        *before += 1;
    }
    found
}

/// Every change to what the module has from the libraries that `wanted` approves of; `None` is
/// the kernel's own file.
fn sites(module: &Module, wanted: &dyn Fn(Option<&str>) -> bool) -> Vec<Site> {
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
                    occurrence: 0,
                    body: Body::Constant(constant.name.clone().unwrap_or_default()),
                    change: Change::Expression(constant.init, E::Literal(to)),
                });
            }
        }
    }
    for (handle, function) in module.functions.iter() {
        let (library, name) = shader::origin(function.name.as_deref().unwrap_or_default());
        if wanted(library.as_deref()) {
            let of = &info[handle];
            collect(
                module,
                of,
                function,
                name,
                Body::Function(handle),
                &mut sites,
            );
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
            sites.push(Site {
                description,
                occurrence: 0,
                body: body.clone(),
                change: Change::Expression(handle, to),
            });
        }
    }
    let mut at = 0;
    walk(&function.body, &mut at, &mut |at, statement| {
        let mut push = |what: String, change| {
            sites.push(Site {
                description: format!("{name}: {what}"),
                occurrence: 0,
                body: body.clone(),
                change,
            });
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
            Statement::Atomic {
                pointer,
                fun: AtomicFunction::Add,
                ..
            } => {
                let pointer = printer.deep(*pointer);
                push(
                    format!("atomicAdd({pointer}) -> atomicSub"),
                    Change::Subtract(at),
                );
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
        E::Select {
            condition,
            accept,
            reject,
        } => [condition, accept, reject].contains(&handle),
        E::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => [Some(arg), arg1, arg2, arg3].contains(&Some(handle)),
        E::Access { base, index } => base == handle || index == handle,
        E::Splat { value, .. } => value == handle,
        E::Compose { ref components, .. } => components.contains(&handle),
        _ => false,
    };
    function
        .expressions
        .iter()
        .find(|(_, expression)| uses(expression))
        .map(|(user, _)| user)
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
            Statement::Loop {
                body, continuing, ..
            } => {
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
            Statement::Loop {
                body, continuing, ..
            } => {
                walk_mut(body, at, visit);
                walk_mut(continuing, at, visit);
            }
            Statement::Switch { cases, .. } => {
                cases
                    .iter_mut()
                    .for_each(|case| walk_mut(&mut case.body, at, visit));
            }
            _ => {}
        }
        visit(here, statement);
    }
}

impl Site {
    /// What tells it from all others of its file, in whichever kernel.
    pub(crate) fn key(&self) -> (String, usize) {
        (self.description.clone(), self.occurrence)
    }

    /// The switch that the change turns off: the compiler's affair, for it folds switches away.
    pub(crate) fn switched_off(&self) -> Option<&str> {
        match (&self.body, &self.change) {
            (Body::Constant(name), Change::Expression(_, E::Literal(Literal::Bool(false)))) => {
                Some(shader::origin(name).1)
            }
            _ => None,
        }
    }

    /// Makes the change.
    pub(crate) fn apply(&self, module: &mut Module) {
        let function = match &self.body {
            Body::Constant(name) => {
                if let Change::Expression(_, to) = &self.change {
                    set_constant(module, name, to);
                }
                return;
            }
            Body::Function(handle) => &mut module.functions[*handle],
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

/// Gives the constant of that name a value of its own.
fn set_constant(module: &mut Module, name: &str, to: &E) {
    let named = |(_, constant): &(_, &naga::Constant)| constant.name.as_deref() == Some(name);
    let found = module
        .constants
        .iter()
        .find(named)
        .map(|(handle, _)| handle);
    let handle = found.expect("the kernel has the constant in every form");
    let init = module
        .global_expressions
        .append(to.clone(), Span::UNDEFINED);
    module.constants[handle].init = init;
}
