//! What a shader binds, and the rules for its bindings.

use naga::valid::ModuleInfo;
use naga::{AddressSpace, Handle, StorageAccess};

use super::compose::{Composed, finding};
use super::error::{Finding, ShaderError, Step};
use super::mangle;
use super::shape::{Shape, shape, size_of};

/// How a kernel uses a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// `var<uniform>`.
    Uniform,
    /// `var<storage, read>`.
    Read,
    /// `var<storage, read_write>`.
    ReadWrite,
}

/// One binding of group 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Number of the binding; a kernel's bindings are 0, 1, 2, … without gaps.
    pub binding: u32,
    /// The variable's name, by which it finds its buffer.
    pub name: String,
    /// How it is used.
    pub access: Access,
    /// What the buffer holds.
    pub shape: Shape,
    /// File that declares it, for errors.
    pub file: String,
    /// Line of the declaration, from 1.
    pub line: u32,
}

/// The bindings of a composed shader, in order, with every breach of the rules for them.
pub(super) fn bindings(name: &str, composed: &Composed) -> Result<Vec<Binding>, ShaderError> {
    let Composed {
        module,
        info,
        locator,
        ..
    } = composed;
    let mut bindings = Vec::new();
    let mut findings: Vec<Finding> = Vec::new();
    for (handle, global) in module.global_variables.iter() {
        let span = module.global_variables.get_span(handle);
        let mut refuse = |found: &str, instead: &str| {
            findings.push(finding(locator, span, found, instead));
        };
        let Some(place) = global.binding else {
            continue;
        };
        let (path, variable) = mangle::split(global.name.as_deref().unwrap_or_default());
        let access = match global.space {
            AddressSpace::Uniform => Access::Uniform,
            AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) => {
                Access::ReadWrite
            }
            AddressSpace::Storage { .. } => Access::Read,
            _ => {
                let found = format!("binding `{variable}` is not a buffer");
                refuse(&found, "bind uniform or storage buffers");
                continue;
            }
        };
        if path.is_some() {
            let found = format!("binding `{variable}` is declared in a library");
            refuse(&found, "declare bindings in the kernel's own file");
        }
        if place.group != 0 {
            let found = format!("binding `{variable}` is in group {}", place.group);
            refuse(&found, "put every binding in @group(0)");
        }
        if !is_used(info, handle) {
            let found = format!("binding `{variable}` is never used");
            refuse(&found, "remove it and renumber those after it");
        }
        let at = locator.locate(span);
        bindings.push(Binding {
            binding: place.binding,
            name: variable.to_owned(),
            access,
            shape: shape(module, global.ty),
            file: at.file,
            line: at.line,
        });
    }

    bindings.sort_by_key(|b| (b.binding, b.line));
    for (expected, b) in (0u32..).zip(&bindings) {
        if b.binding != expected {
            findings.push(Finding {
                at: super::error::Location {
                    file: b.file.clone(),
                    line: b.line,
                },
                found: format!("`{}` is @binding({})", b.name, b.binding),
                instead: format!("number bindings without gaps: here @binding({expected})"),
            });
            break;
        }
    }
    if findings.is_empty() {
        Ok(bindings)
    } else {
        Err(ShaderError::new(name, Step::Reflect, findings))
    }
}

fn is_used(info: &ModuleInfo, global: Handle<naga::GlobalVariable>) -> bool {
    !info.get_entry_point(0)[global].is_empty()
}

/// Bytes of the shader's immediates, a multiple of 4; 0 when it has none.
pub(super) fn immediate_size(module: &naga::Module) -> u32 {
    module
        .global_variables
        .iter()
        .filter(|(_, global)| global.space == AddressSpace::Immediate)
        .map(|(_, global)| size_of(module, global.ty).next_multiple_of(4))
        .sum()
}
