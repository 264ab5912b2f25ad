//! Structs and constants as naga has laid them out, for comparison with their twins in Rust.

use naga::proc::Layouter;
use naga::{ArraySize, Handle, Scalar, ScalarKind, Type, TypeInner};

use super::mangle;

/// The layout of a type: one record, or a runtime-sized array of records.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The record's type, e.g. `Particle`, `u32`, `vec4<u32>`, `atomic<u32>`, `array<u32, 8>`.
    pub type_name: String,
    /// Whether there are as many records as the buffer has room for.
    pub runtime_array: bool,
    /// Bytes from one record to the next in a runtime-sized array, else the type's size in bytes.
    pub stride: u32,
    /// The record's fields in order, when it is a struct.
    pub fields: Vec<Field>,
}

/// One field of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name.
    pub name: String,
    /// Type, in the notation of [`Shape::type_name`].
    pub type_name: String,
    /// Bytes from the start of the struct.
    pub offset: u32,
    /// Bytes that the value takes, without padding; 0 for a runtime-sized array.
    pub size: u32,
}

/// A named constant; vectors and arrays are listed component by component as `NAME[0]`, ….
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    /// Name.
    pub name: String,
    /// The value's 32 bits; booleans are 0 and 1.
    pub bits: u32,
    /// Whether the bits are those of an `f32`.
    pub is_float: bool,
}

/// The layout of a type.
pub(super) fn shape(module: &naga::Module, ty: Handle<Type>) -> Shape {
    let (record, runtime_array, stride) = match module.types[ty].inner {
        TypeInner::Array {
            base,
            size: ArraySize::Dynamic,
            stride,
        } => (base, true, stride),
        // Records of a bounded number, which a uniform buffer holds.
        TypeInner::Array { base, stride, .. }
            if matches!(module.types[base].inner, TypeInner::Struct { .. }) =>
        {
            (base, false, stride)
        }
        _ => (ty, false, size_of(module, ty)),
    };
    let fields = match &module.types[record].inner {
        TypeInner::Struct { members, .. } => members
            .iter()
            .map(|member| Field {
                name: member.name.clone().unwrap_or_default(),
                type_name: type_name(module, member.ty),
                offset: member.offset,
                size: size_of(module, member.ty),
            })
            .collect(),
        _ => Vec::new(),
    };
    Shape {
        type_name: type_name(module, record),
        runtime_array,
        stride,
        fields,
    }
}

/// The layout of the struct of that name.
pub(super) fn struct_named(module: &naga::Module, name: &str) -> Option<Shape> {
    let (handle, _) = module.types.iter().find(|(_, ty)| {
        matches!(ty.inner, TypeInner::Struct { .. })
            && ty.name.as_deref().map(mangle::item) == Some(name)
    })?;
    Some(shape(module, handle))
}

/// Bytes of a value of that type; 0 for a runtime-sized array.
pub(super) fn size_of(module: &naga::Module, ty: Handle<Type>) -> u32 {
    match module.types[ty].inner {
        TypeInner::Array {
            size: ArraySize::Dynamic,
            ..
        } => 0,
        ref inner => {
            let mut layouter = Layouter::default();
            match layouter.update(module.to_ctx()) {
                Ok(()) => layouter[ty].size,
                Err(_) => inner.size(module.to_ctx()),
            }
        }
    }
}

/// A type in WGSL's notation, without module paths.
fn type_name(module: &naga::Module, ty: Handle<Type>) -> String {
    let ty = &module.types[ty];
    match ty.inner {
        TypeInner::Scalar(scalar) => scalar_name(scalar).to_owned(),
        TypeInner::Vector { size, scalar } => {
            format!("vec{}<{}>", size as u8, scalar_name(scalar))
        }
        TypeInner::Matrix {
            columns,
            rows,
            scalar,
        } => {
            let scalar = scalar_name(scalar);
            format!("mat{}x{}<{scalar}>", columns as u8, rows as u8)
        }
        TypeInner::Atomic(scalar) => format!("atomic<{}>", scalar_name(scalar)),
        TypeInner::Array { base, size, .. } => {
            let base = type_name(module, base);
            match size {
                ArraySize::Constant(len) => format!("array<{base}, {len}>"),
                _ => format!("array<{base}>"),
            }
        }
        _ => mangle::item(ty.name.as_deref().unwrap_or("?")).to_owned(),
    }
}

fn scalar_name(scalar: Scalar) -> &'static str {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Sint, 4) => "i32",
        (ScalarKind::Uint, 4) => "u32",
        (ScalarKind::Uint, 8) => "u64",
        (ScalarKind::Float, 4) => "f32",
        (ScalarKind::Bool, _) => "bool",
        _ => "?",
    }
}

/// The named constants of a module, in order of declaration; those that are not numbers of 32
/// bits or booleans are left out.
pub(super) fn constants(module: &naga::Module) -> Vec<Constant> {
    let mut out = Vec::new();
    for (_, constant) in module.constants.iter() {
        let Some(name) = constant.name.as_deref() else {
            continue;
        };
        if name != super::locate::ANCHOR {
            flatten(module, mangle::item(name), constant.init, &mut out);
        }
    }
    out
}

fn flatten(
    module: &naga::Module,
    name: &str,
    value: Handle<naga::Expression>,
    out: &mut Vec<Constant>,
) {
    use naga::{Expression as E, Literal as L};
    let (bits, is_float) = match &module.global_expressions[value] {
        E::Literal(L::F32(x)) => (x.to_bits(), true),
        E::Literal(L::U32(x)) => (*x, false),
        E::Literal(L::I32(x)) => (x.cast_unsigned(), false),
        E::Literal(L::Bool(x)) => (u32::from(*x), false),
        E::Constant(other) => {
            return flatten(module, name, module.constants[*other].init, out);
        }
        E::Compose { components, .. } => {
            for (i, component) in components.iter().enumerate() {
                flatten(module, &format!("{name}[{i}]"), *component, out);
            }
            return;
        }
        E::Splat { size, value } => {
            for i in 0..*size as u8 {
                flatten(module, &format!("{name}[{i}]"), *value, out);
            }
            return;
        }
        _ => return,
    };
    let name = name.to_owned();
    out.push(Constant {
        name,
        bits,
        is_float,
    });
}

/// Names of all structs of a module.
pub(super) fn struct_names(module: &naga::Module) -> Vec<String> {
    let types = module.types.iter().map(|(_, ty)| ty);
    types
        .filter(|ty| matches!(ty.inner, TypeInner::Struct { .. }))
        .filter_map(|ty| ty.name.as_deref().map(mangle::item))
        .map(str::to_owned)
        .collect()
}
