//! What drivers do, and so why each rule of exactness is there: plain WGSL that breaks the rule
//! differs from the processor, or one adapter from the other; what keeps it does not.
mod common;

use common::*;
use motes::gpu::shader::{
    Access, Binding, CompileOptions, CompiledKernel, Shape, compile_source,
};
use motes::gpu::{GpuDevice, KernelForm};

/// Invocations of a raw kernel.
const WORKGROUP: u32 = 64;

/// A kernel that computes `body`, a u32 from the words `a`, `b`, `c`, `d`, without any rule of
/// ours; in SPIR-V as naga writes it, and in WGSL.
fn raw_kernel(body: &str) -> CompiledKernel {
    let text = format!(
        "@group(0) @binding(0) var<storage, read> input: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> output: array<u32>;
fn f(a: u32, b: u32, c: u32, d: u32) -> u32 {{ {body} }}
@compute @workgroup_size({WORKGROUP})
fn raw(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&output) {{ return; }}
    let v = input[id.x];
    output[id.x] = f(v.x, v.y, v.z, v.w);
}}
"
    );
    let module = naga::front::wgsl::parse_str(&text).expect("the raw kernel parses");
    let flags = naga::valid::ValidationFlags::all();
    let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::all())
        .validate(&module)
        .expect("the raw kernel is valid");
    let options = naga::back::spv::Options {
        lang_version: (1, 3),
        flags: naga::back::spv::WriterFlags::empty(),
        ..naga::back::spv::Options::default()
    };
    let pipeline = naga::back::spv::PipelineOptions {
        shader_stage: naga::ShaderStage::Compute,
        entry_point: "raw".into(),
    };
    let spirv = naga::back::spv::write_vec(&module, &info, &options, Some(&pipeline))
        .expect("the raw kernel can be written");
    let binding = |binding: u32, name: &str, access, type_name: &str, stride| Binding {
        binding,
        name: name.into(),
        access,
        shape: Shape {
            type_name: type_name.into(),
            runtime_array: true,
            stride,
            fields: Vec::new(),
        },
        file: "raw".into(),
        line: 1,
    };
    CompiledKernel {
        name: "raw".into(),
        entry_point: "raw".into(),
        workgroup_size: [WORKGROUP, 1, 1],
        spirv,
        wgsl: text,
        bindings: vec![
            binding(0, "input", Access::Read, "vec4<u32>", 16),
            binding(1, "output", Access::ReadWrite, "u32", 4),
        ],
        immediate_size: 0,
    }
}

/// The same by our rules: `body` may use the shared libraries, and is linted.
fn exact_kernel(body: &str) -> CompiledKernel {
    let text = format!(
        "#import motes::exact::{{bits_of, f32_of_u32, less, snap, to_i32}}
@group(0) @binding(0) var<storage, read> input: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> output: array<u32>;
fn f(a: u32, b: u32, c: u32, d: u32) -> u32 {{ {body} }}
@compute @workgroup_size(#{{WORKGROUP_SIZE}})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&output) {{ return; }}
    let v = input[id.x];
    output[id.x] = f(v.x, v.y, v.z, v.w);
}}
"
    );
    let options = CompileOptions { workgroup_size: WORKGROUP, ..CompileOptions::default() };
    match compile_source("test/exact", &text, &options) {
        Ok(kernel) => kernel,
        Err(e) => panic!("{e}"),
    }
}

/// What `kernel` makes of the inputs.
fn outputs(
    device: &GpuDevice,
    kernel: &CompiledKernel,
    form: KernelForm,
    inputs: &[[u32; 4]],
) -> Vec<u32> {
    device
        .run_kernel(kernel, form, &[inputs.as_flattened()], inputs.len(), inputs.len() as u32)
        .expect("the device runs the kernel")
}

/// Inputs whose output is not what the processor has.
fn differing(
    device: &GpuDevice,
    kernel: &CompiledKernel,
    form: KernelForm,
    inputs: &[[u32; 4]],
    expected: impl Fn([u32; 4]) -> u32,
) -> usize {
    let got = outputs(device, kernel, form, inputs);
    inputs.iter().zip(got).filter(|(input, got)| expected(**input) != *got).count()
}

/// Four random floats each, within 2^-`exponent` .. 2^`exponent`.
fn random_inputs(count: u32, exponent: u32) -> Vec<[u32; 4]> {
    let float = |word: u32| {
        word & 0x807f_ffff | (127 - exponent + (word >> 23) % (2 * exponent)) << 23
    };
    (0..count).map(|at| [0, 1, 2, 3].map(|i| float(hash(4 * at + i)))).collect()
}

const ROUNDS: &str = "var n = 0u; for (var i = 0u; i < a; i += 1u) {
    for (var j = 0u; j < b; j += 1u) { n += 1u; } } return n;";

#[test]
fn llvmpipe_gives_up_loops_after_65_535_rounds_in_all() {
    let kernel = raw_kernel(ROUNDS);
    on_each_adapter(|name, device| {
        let rounds = |a: u32, b: u32| {
            outputs(device, &kernel, KernelForm::Spirv, &[[a, b, 0, 0]])[0]
        };
        for (a, b) in [(1, 60_000), (1, 70_000), (200, 300), (250, 270), (300, 300), (2, 40_000)] {
            println!("{name}: {a} x {b} = {} rounds, {} run", a * b, rounds(a, b));
        }
    });
}

#[test]
fn explore() {
    let cases: Vec<(&str, fn([f32; 4]) -> f32)> = vec![
        ("x * y + x * z", |[x,y,z,_]| x*y+x*z),
        ("x + (y - x) * z", |[x,y,z,_]| x+(y-x)*z),
        ("x * (1.0f - z) + y * z", |[x,y,z,_]| x*(1.0-z)+y*z),
        ("(x + 0.1f) + 0.2f", |[x,_,_,_]| (x+0.1)+0.2),
        ("(x * 0.1f) * 0.3f", |[x,_,_,_]| (x*0.1)*0.3),
        ("(x + y) - x", |[x,y,_,_]| (x+y)-x),
        ("x * 2.0f - 1.0f", |[x,_,_,_]| x*2.0-1.0),
        ("(x - y) + y", |[x,y,_,_]| (x-y)+y),
        ("x * y - z * y", |[x,y,z,_]| x*y-z*y),
        ("(0.1f * x) * (0.7f * y)", |[x,y,_,_]| (0.1*x)*(0.7*y)),
        ("x * x * x * (x * (x * 6.0f - 15.0f) + 10.0f)", |[x,_,_,_]| x*x*x*(x*(x*6.0-15.0)+10.0)),
    ];
    let inputs = random_inputs(20000, 8);
    on_each_adapter(|name, device| {
        for (e, expected) in &cases {
            let k = raw_kernel(&format!("let x = bitcast<f32>(a); let y = bitcast<f32>(b); let z = bitcast<f32>(c); return bitcast<u32>({e});"));
            let x = exact_kernel(&format!("let x = bitcast<f32>(a); let y = bitcast<f32>(b); let z = bitcast<f32>(c); return bits_of({e});"));
            for (what, k, form) in [("raw spv", &k, KernelForm::Spirv), ("raw wgsl", &k, KernelForm::Wgsl), ("exact", &x, KernelForm::Spirv), ("exact as wgsl", &x, KernelForm::Wgsl)] {
                let n = differing(device, k, form, &inputs, |v| motes::exact::bits_of(expected(v.map(f32::from_bits))));
                println!("{name} {what} {n}/{} {e}", inputs.len());
            }
        }
    });
}
