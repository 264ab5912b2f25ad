//! From WGSL to kernels that every driver runs alike.
//!
//! [`compile`] composes a kernel with the libraries it imports (`compose`), refuses whatever
//! drivers compute differently (`lint`), writes SPIR-V whose arithmetic may not be contracted
//! (`spirv`) and tells the host which buffers the kernel wants (`reflect`). It is pure: no
//! adapter is needed.
//!
//! A kernel imports with `#import motes::exact::{snap, less}`, takes its workgroup size as
//! `@workgroup_size(#{WORKGROUP_SIZE})`, binds buffers in `@group(0)` from `@binding(0)` without
//! gaps, takes what changes from dispatch to dispatch as `var<immediate>`, and stores floats
//! snapped or as bits.

mod compose;
mod error;
mod lint;
mod locate;
mod mangle;
mod reflect;
mod rules;
mod shape;
mod snapped;
pub mod sources;
mod spirv;
#[cfg(test)]
mod tests;
mod text;

use std::fmt;

use naga::back::{pipeline_constants, wgsl};

pub use error::{Finding, Location, ShaderError, Step};
pub use reflect::{Access, Binding};
pub use shape::{Constant, Field, Shape};

use compose::{Composed, Input};

/// How to compile.
#[derive(Clone, Copy)]
pub struct CompileOptions<'a> {
    /// What `#{WORKGROUP_SIZE}` stands for: invocations in a workgroup, a multiple of 8.
    pub workgroup_size: u32,
    /// Whether indices, integer divisors and loops are checked by the kernel itself. Unchecked
    /// kernels are faster, and must keep their own indices in range.
    pub checked: bool,
    /// Switches (`THRESHOLDS`, `STREAKS`, `RECTANGLES`) that are off: what the plan does not use.
    pub off: &'a [&'static str],
    /// Whether the device has 64-bit integers and adds them atomically: what `WIDE` stands for.
    pub wide: bool,
    /// Texts that stand in for the program's own.
    pub texts: Option<&'a sources::KernelTexts>,
    /// Changes the module after it has passed the lint, so that a test can see a twin fail.
    pub mutate: Option<&'a dyn Fn(&mut naga::Module)>,
}

impl Default for CompileOptions<'_> {
    /// 256 invocations a workgroup, unchecked, unchanged.
    fn default() -> Self {
        Self {
            workgroup_size: 256,
            checked: false,
            off: &[],
            wide: false,
            texts: None,
            mutate: None,
        }
    }
}

impl fmt::Debug for CompileOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CompileOptions")
            .field("workgroup_size", &self.workgroup_size)
            .field("checked", &self.checked)
            .field("off", &self.off)
            .field("wide", &self.wide)
            .field("texts", &self.texts.is_some())
            .field("mutate", &self.mutate.is_some())
            .finish()
    }
}

/// A kernel, ready for an adapter.
#[derive(Clone, Debug)]
pub struct CompiledKernel {
    /// Name, e.g. `particles/advance`.
    pub name: String,
    /// Name of the entry point in both `spirv` and `wgsl`.
    pub entry_point: String,
    /// Invocations in a workgroup.
    pub workgroup_size: [u32; 3],
    /// SPIR-V 1.3 with every float operation decorated `NoContraction`.
    pub spirv: Vec<u32>,
    /// The same kernel as one plain WGSL text, for adapters that take no SPIR-V.
    pub wgsl: String,
    /// What it binds, by number.
    pub bindings: Vec<Binding>,
    /// Bytes of its immediates; 0 when it has none.
    pub immediate_size: u32,
}

/// Compiles a listed kernel, e.g. `particles/advance`.
///
/// # Errors
/// A [`ShaderError`] with every finding of the first step that refused the kernel.
pub fn compile(kernel: &str, options: &CompileOptions) -> Result<CompiledKernel, ShaderError> {
    let source = listed(kernel)?;
    let Some(texts) = options.texts else {
        return compile_input(&input(source, options), options);
    };
    let libraries = texts.libraries();
    let source = texts.of(source);
    let input = Input {
        libraries: libraries.as_deref().unwrap_or(sources::LIBRARIES),
        ..input(&source, options)
    };
    compile_input(&input, options)
}

/// Compiles a kernel from its text; errors name its file `wgsl/NAME.wgsl`.
///
/// # Errors
/// As [`compile`].
pub fn compile_source(
    name: &str,
    text: &str,
    options: &CompileOptions,
) -> Result<CompiledKernel, ShaderError> {
    let input = Input {
        name,
        file: &format!("wgsl/{name}.wgsl"),
        text,
        libraries: sources::LIBRARIES,
        workgroup_size: options.workgroup_size,
        off: options.off,
        wide: options.wide,
    };
    compile_input(&input, options)
}

/// The composed, linted and (if asked for) changed module of a listed kernel, as it is written to
/// SPIR-V: only what its entry point uses, no overrides.
///
/// # Errors
/// As [`compile`].
pub fn module(kernel: &str, options: &CompileOptions) -> Result<naga::Module, ShaderError> {
    let input = input(listed(kernel)?, options);
    let composed = checked(&input)?;
    Ok(finish(&input, composed, options)?.module)
}

/// Lints a listed file on its own, kernel or library; `lib/exact` and its kind included.
///
/// # Errors
/// As [`compile`].
pub fn check(source: &str) -> Result<(), ShaderError> {
    let input = input(listed(source)?, &CompileOptions::default());
    lint::lint(input.name, &compose::compose(&input)?)
}

/// The layout of a struct that a listed file declares or imports, e.g. `Particle` of
/// `lib/layout`; `None` where it has no such struct.
///
/// # Errors
/// As [`compile`].
pub fn struct_layout(source: &str, struct_name: &str) -> Result<Option<Shape>, ShaderError> {
    let input = input(listed(source)?, &CompileOptions::default());
    let composed = compose::compose(&input)?;
    Ok(shape::struct_named(&composed.module, struct_name))
}

/// Names of the structs that a listed file declares or imports, in order of declaration.
///
/// # Errors
/// As [`compile`].
pub fn struct_names(source: &str) -> Result<Vec<String>, ShaderError> {
    let input = input(listed(source)?, &CompileOptions::default());
    let composed = compose::compose(&input)?;
    Ok(shape::struct_names(&composed.module))
}

/// The named constants that a listed file declares or imports, bit for bit.
///
/// # Errors
/// As [`compile`].
pub fn constants(source: &str) -> Result<Vec<Constant>, ShaderError> {
    let input = input(listed(source)?, &CompileOptions::default());
    let composed = compose::compose(&input)?;
    Ok(shape::constants(&composed.module))
}

/// The library (`None`: the shader's own file) and the item that a name in a composed module
/// stands for, e.g. `motes::exact` and `snap`.
pub fn origin(name: &str) -> (Option<String>, &str) {
    mangle::split(name)
}

fn listed(name: &str) -> Result<&'static sources::Source<'static>, ShaderError> {
    sources::find(name).ok_or_else(|| {
        let at = Location {
            file: format!("wgsl/{name}.wgsl"),
            line: 1,
        };
        let found = "no such file is listed in src/gpu/shader/sources.rs".to_owned();
        ShaderError::one(name, Step::Find, at, found)
    })
}

fn input<'a>(source: &sources::Source<'a>, options: &CompileOptions<'a>) -> Input<'a> {
    Input {
        name: source.name,
        file: source.file,
        text: source.text,
        libraries: sources::LIBRARIES,
        workgroup_size: options.workgroup_size,
        off: options.off,
        wide: options.wide,
    }
}

/// Composes and lints.
fn checked(input: &Input) -> Result<Composed, ShaderError> {
    let composed = compose::compose(input)?;
    lint::lint(input.name, &composed)?;
    Ok(composed)
}

fn compile_input(input: &Input, options: &CompileOptions) -> Result<CompiledKernel, ShaderError> {
    let composed = checked(input)?;
    let entry_point = entry_point(input.name, &composed)?;
    let bindings = reflect::bindings(input.name, &composed)?;
    let immediate_size = reflect::immediate_size(&composed.module);
    let composed = finish(input, composed, options)?;

    let Composed { module, info, .. } = &composed;
    let unwritten = |e: &dyn fmt::Display| {
        ShaderError::one(
            input.name,
            Step::Write,
            composed.locator.top(),
            mangle::demangle(&e.to_string()),
        )
    };
    let spirv =
        spirv::write(module, info, &entry_point, options.checked).map_err(|e| unwritten(&e))?;
    let wgsl =
        wgsl::write_string(module, info, wgsl::WriterFlags::empty()).map_err(|e| unwritten(&e))?;
    Ok(CompiledKernel {
        name: input.name.to_owned(),
        entry_point,
        workgroup_size: module.entry_points[0].workgroup_size,
        spirv,
        wgsl,
        bindings,
        immediate_size,
    })
}

/// The name of the one compute entry point.
fn entry_point(name: &str, composed: &Composed) -> Result<String, ShaderError> {
    let refuse =
        |found: String| ShaderError::one(name, Step::Reflect, composed.locator.top(), found);
    match composed.module.entry_points.as_slice() {
        [one] if one.stage == naga::ShaderStage::Compute => Ok(one.name.clone()),
        [one] => Err(refuse(format!(
            "`{}` is not a compute entry point",
            one.name
        ))),
        many => Err(refuse(format!(
            "{} entry points instead of one",
            many.len()
        ))),
    }
}

/// Resolves overrides, drops what the entry point does not use, and applies the change asked for.
fn finish(
    input: &Input,
    mut composed: Composed,
    options: &CompileOptions,
) -> Result<Composed, ShaderError> {
    locate::release_anchor(&mut composed.module);
    naga::compact::compact(&mut composed.module, naga::compact::KeepUnused::No);
    if let Some(mutate) = options.mutate {
        mutate(&mut composed.module);
    }
    composed.info = compose::validate(input.name, &composed.module, &composed.locator)?;
    let resolved = pipeline_constants::process_overrides(
        &composed.module,
        &composed.info,
        None,
        &Default::default(),
    );
    let (module, info) = match resolved {
        Ok((module, info)) => (module.into_owned(), info.into_owned()),
        Err(e) => {
            let at = composed.locator.top();
            return Err(ShaderError::one(input.name, Step::Write, at, e.to_string()));
        }
    };
    composed.module = module;
    composed.info = info;
    Ok(composed)
}
