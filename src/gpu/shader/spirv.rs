//! SPIR-V whose float arithmetic no driver may contract.
//!
//! naga writes the words; then every result of `OpFNegate`, `OpFAdd`, `OpFSub` and `OpFMul` is
//! decorated `NoContraction` (SPIR-V 1.3, 3.20), and `OpVectorTimesScalar`, which naga writes for
//! vector times scalar, becomes a splat and an `OpFMul`, so that these four are the only float
//! arithmetic there is.

use std::collections::HashMap;

use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::ModuleInfo;

const OP_DECORATE: u32 = 71;
const OP_TYPE_VECTOR: u32 = 23;
const OP_COMPOSITE_CONSTRUCT: u32 = 80;
const OP_F_NEGATE: u32 = 127;
const OP_F_ADD: u32 = 129;
const OP_F_SUB: u32 = 131;
const OP_F_MUL: u32 = 133;
const OP_VECTOR_TIMES_SCALAR: u32 = 142;
const NO_CONTRACTION: u32 = 42;

/// What a kernel may ask a device for; those with 64-bit integers are for devices that have them.
const ALLOWED: &[spv::Capability] = &[
    spv::Capability::Shader,
    spv::Capability::Int64,
    spv::Capability::Int64Atomics,
];

/// Words of the header; the fourth is the bound of ids.
const HEADER_LEN: usize = 5;
const BOUND: usize = 3;

/// Writes one entry point as SPIR-V 1.3, the version of Vulkan 1.1, decorated.
///
/// The options are those of wgpu-hal's Vulkan backend for its checked and unchecked shaders,
/// except that workgroup memory is never cleared, and that capabilities are the least there are.
pub(super) fn write(
    module: &naga::Module,
    info: &ModuleInfo,
    entry_point: &str,
    checked: bool,
) -> Result<Vec<u32>, spv::Error> {
    let policy = if checked {
        BoundsCheckPolicy::Restrict
    } else {
        BoundsCheckPolicy::Unchecked
    };
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::empty(),
        fake_missing_bindings: true,
        capabilities: Some(ALLOWED.iter().copied().collect()),
        bounds_check_policies: BoundsCheckPolicies {
            index: policy,
            buffer: policy,
            image_load: policy,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::None,
        force_loop_bounding: checked,
        emit_int_div_checks: checked,
        ray_query_initialization_tracking: false,
        trace_ray_argument_validation: false,
        use_storage_input_output_16: false,
        mesh_shader_primitive_indices_clamp: false,
        ..spv::Options::default()
    };
    let pipeline = spv::PipelineOptions {
        shader_stage: naga::ShaderStage::Compute,
        entry_point: entry_point.to_owned(),
    };
    let words = spv::write_vec(module, info, &options, Some(&pipeline))?;
    Ok(forbid_contraction(&words))
}

/// One instruction: its opcode and its words, the first of which holds opcode and length.
fn instructions(words: &[u32]) -> impl Iterator<Item = (u32, &[u32])> {
    let mut rest = words.get(HEADER_LEN..).unwrap_or_default();
    std::iter::from_fn(move || {
        let first = *rest.first()?;
        let len = (first >> 16).max(1) as usize;
        let (this, next) = rest.split_at(len.min(rest.len()));
        rest = next;
        Some((first & 0xffff, this))
    })
}

/// Whether an instruction opens the section of types, constants and global variables
/// (SPIR-V 1.3, 2.4, item 9), before which all decorations stand.
fn opens_types(opcode: u32) -> bool {
    matches!(opcode, 1 | 19..=39 | 41..=46 | 48..=52 | 59)
}

fn forbid_contraction(words: &[u32]) -> Vec<u32> {
    let mut results = Vec::new();
    let mut vector_lens = HashMap::new();
    for (opcode, words) in instructions(words) {
        match (opcode, words) {
            (OP_TYPE_VECTOR, &[_, id, _, len]) => {
                vector_lens.insert(id, len);
            }
            (
                OP_F_NEGATE | OP_F_ADD | OP_F_SUB | OP_F_MUL | OP_VECTOR_TIMES_SCALAR,
                &[_, _, result, ..],
            ) => results.push(result),
            _ => {}
        }
    }

    let mut out = words[..HEADER_LEN].to_vec();
    let mut decorated = false;
    for (opcode, words) in instructions(words) {
        if opens_types(opcode) && !decorated {
            decorated = true;
            for &result in &results {
                out.extend([3 << 16 | OP_DECORATE, result, NO_CONTRACTION]);
            }
        }
        match (opcode, words) {
            (OP_VECTOR_TIMES_SCALAR, &[_, ty, result, vector, scalar]) => {
                let len = vector_lens.get(&ty).copied().unwrap_or_default();
                let splat = out[BOUND];
                out[BOUND] += 1;
                out.extend([(3 + len) << 16 | OP_COMPOSITE_CONSTRUCT, ty, splat]);
                out.extend((0..len).map(|_| scalar));
                out.extend([5 << 16 | OP_F_MUL, ty, result, vector, splat]);
            }
            _ => out.extend(words),
        }
    }
    out
}
