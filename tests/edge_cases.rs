//! What drivers do, and so why each rule of exactness is there: plain WGSL that breaks the rule
//! differs from the processor, or one adapter from the other; what keeps it does not.
mod common;

use common::*;
use motes::exact::{bits_of, f32_of_u32, less, to_i32};
use motes::gpu::shader::{Access, Binding, CompileOptions, CompiledKernel, Shape, compile_source};
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
    let options = CompileOptions {
        workgroup_size: WORKGROUP,
        ..CompileOptions::default()
    };
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
        .run_kernel(
            kernel,
            form,
            &[inputs.as_flattened()],
            inputs.len(),
            inputs.len() as u32,
        )
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
    inputs
        .iter()
        .zip(got)
        .filter(|(input, got)| expected(**input) != *got)
        .count()
}

/// Four random floats each, within 2^-`exponent` .. 2^`exponent`.
fn random_inputs(count: u32, exponent: u32) -> Vec<[u32; 4]> {
    let float =
        |word: u32| word & 0x807f_ffff | (127 - exponent + (word >> 23) % (2 * exponent)) << 23;
    (0..count)
        .map(|at| [0, 1, 2, 3].map(|i| float(hash(4 * at + i))))
        .collect()
}

/// Asserts that raw WGSL differs from the processor on exactly those of the two software adapters
/// that are named; of others nothing is known.
fn assert_raw_differs(
    what: &str,
    adapters: &[&str],
    inputs: &[[u32; 4]],
    body: &str,
    expected: impl Fn([u32; 4]) -> u32,
) {
    let kernel = raw_kernel(body);
    on_each_adapter(|name, device| {
        for form in [KernelForm::Spirv, KernelForm::Wgsl] {
            let count = differing(device, &kernel, form, inputs, &expected);
            println!(
                "{what}, {name}, raw {form:?}: {count} of {} differ",
                inputs.len()
            );
            if ["llvmpipe", "swiftshader"].contains(&name) {
                assert_eq!(
                    count > 0,
                    adapters.contains(&name),
                    "{what}, {name}, raw {form:?}"
                );
            }
        }
    });
}

/// Asserts that WGSL by our rules is the same as the processor on every adapter.
fn assert_exact(what: &str, inputs: &[[u32; 4]], body: &str, expected: impl Fn([u32; 4]) -> u32) {
    let kernel = exact_kernel(body);
    on_each_adapter(|name, device| {
        let count = differing(device, &kernel, KernelForm::Spirv, inputs, &expected);
        assert_eq!(count, 0, "{what}, {name}, of {}", inputs.len());
    });
}

fn x_of(v: [u32; 4]) -> f32 {
    f32::from_bits(v[0])
}

fn y_of(v: [u32; 4]) -> f32 {
    f32::from_bits(v[1])
}

const X: &str = "let x = bitcast<f32>(a); let y = bitcast<f32>(b); let z = bitcast<f32>(c);";

#[test]
fn denormals_are_flushed_by_one_adapter_and_kept_by_the_other() {
    let tiny = |at: u32| 2f32.powi(-70) * (1.0 + (hash(at) >> 8) as f32 * 2f32.powi(-24));
    let inputs: Vec<_> = (0..4096)
        .map(|at| [tiny(at).to_bits(), 2f32.powi(-65).to_bits(), 0, 0])
        .collect();
    let product = |v| x_of(v) * y_of(v);
    let body = format!("{X} return bitcast<u32>(x * y);");
    assert_raw_differs("product", &["swiftshader"], &inputs, &body, |v| {
        product(v).to_bits()
    });
    let body = format!("{X} return bits_of(x * y);");
    assert_exact("product", &inputs, &body, |v| bits_of(product(v)));

    let denormals: Vec<_> = (0..4096)
        .map(|at| [hash(2 * at) >> 10, hash(2 * at + 1) >> 10, 0, 0])
        .collect();
    let body = format!("{X} return select(0u, 1u, x < y);");
    let expected = |v| u32::from(x_of(v) < y_of(v));
    assert_raw_differs("comparison", &["swiftshader"], &denormals, &body, expected);
    let body = format!("{X} return select(0u, 1u, less(x, y));");
    assert_exact("comparison", &denormals, &body, |v| {
        u32::from(less(x_of(v), y_of(v)))
    });

    let below: Vec<_> = (1..65).map(|at: u32| [at | 0x8000_0000, 0, 0, 0]).collect();
    let body = format!("{X} return bitcast<u32>(floor(x));");
    let expected = |v| x_of(v).floor().to_bits();
    assert_raw_differs("floor", &["swiftshader"], &below, &body, expected);
    let body = format!("{X} return u32(to_i32(x));");
    assert_exact("floor", &below, &body, |v| to_i32(x_of(v)).cast_unsigned());
}

#[test]
fn the_sign_of_zero_is_folded_away() {
    let both = ["llvmpipe", "swiftshader"];
    let zeros: Vec<_> = [0.0f32, -0.0, 3.0, -3.0]
        .map(|x| [x.to_bits(), 0, 0, 0])
        .to_vec();
    type Twin = fn(f32) -> f32;
    let cases: [(&str, Twin); 3] = [
        ("x + 0.0f", |x| x + 0.0),
        ("x * 0.0f", |x| x * 0.0),
        ("0.0f - x", |x| 0.0 - x),
    ];
    for (expression, twin) in cases {
        let body = format!("{X} return bitcast<u32>({expression});");
        assert_raw_differs(expression, &both, &zeros, &body, |v| {
            twin(x_of(v)).to_bits()
        });
        let body = format!("{X} return bits_of({expression});");
        assert_exact(expression, &zeros, &body, |v| bits_of(twin(x_of(v))));
    }
}

#[test]
fn integers_above_2_to_the_24_become_other_floats() {
    let inputs: Vec<_> = (0..4096).map(|at| [hash(at) | 1 << 24, 0, 0, 0]).collect();
    let expected = |v: [u32; 4]| (v[0] as f32).to_bits();
    let body = "return bitcast<u32>(f32(a));";
    assert_raw_differs("u32 to f32", &["swiftshader"], &inputs, body, expected);
    let body = "return bits_of(f32_of_u32(a));";
    assert_exact("u32 to f32", &inputs, body, |v| f32_of_u32(v[0]).to_bits());
}

#[test]
fn floats_out_of_range_become_other_integers() {
    let both = ["llvmpipe", "swiftshader"];
    let far = [
        3e9f32,
        -3e9,
        2f32.powi(31),
        f32::MAX,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    let inputs = far.map(|x| [x.to_bits(), 0, 0, 0]);
    let body = format!("{X} return bitcast<u32>(i32(x));");
    let expected = |v| (x_of(v) as i32).cast_unsigned();
    assert_raw_differs("f32 to i32", &both, &inputs, &body, expected);
    let body = format!("{X} return u32(x);");
    assert_raw_differs("f32 to u32", &both, &inputs, &body, |v| x_of(v) as u32);
    let body = format!("{X} return bitcast<u32>(to_i32(x));");
    assert_exact("f32 to i32", &inputs, &body, |v| {
        to_i32(x_of(v)).cast_unsigned()
    });
}

/// Neither of these Mesa and SwiftShader fuses x y + z to one rounding; both of them reassociate,
/// which the same decoration forbids.
#[test]
fn arithmetic_is_reassociated_unless_decorated() {
    let both = ["llvmpipe", "swiftshader"];
    let inputs = random_inputs(20_000, 8);
    type Twin = fn([f32; 3]) -> f32;
    let cases: [(&str, &[&str], Twin); 6] = [
        ("x * y + x * z", &both, |[x, y, z]| x * y + x * z),
        ("(x + 0.1f) + 0.2f", &both, |[x, ..]| (x + 0.1) + 0.2),
        ("(x * 0.1f) * 0.3f", &both, |[x, ..]| (x * 0.1) * 0.3),
        ("(x - y) + y", &both, |[x, y, _]| (x - y) + y),
        ("(x + y) - x", &["llvmpipe"], |[x, y, _]| (x + y) - x),
        ("x * y + z", &[], |[x, y, z]| x * y + z),
    ];
    for (expression, differ, twin) in cases {
        let expected = |v: [u32; 4]| {
            let [x, y, z, _] = v.map(f32::from_bits);
            bits_of(twin([x, y, z]))
        };
        let body = format!("{X} return bitcast<u32>({expression});");
        assert_raw_differs(expression, differ, &inputs, &body, expected);
        let body = format!("{X} return bits_of({expression});");
        assert_exact(expression, &inputs, &body, expected);
        // The decoration alone makes the difference: as plain WGSL, the same kernel differs.
        let kernel = exact_kernel(&body);
        on_each_adapter(|name, device| {
            let plain = differing(device, &kernel, KernelForm::Wgsl, &inputs, expected);
            if both.contains(&name) {
                assert_eq!(
                    plain > 0,
                    differ.contains(&name),
                    "{expression}, {name}: {plain}"
                );
            }
        });
    }
}

/// gallivm stops all loops of a group of lanes after 65,535 rounds in all, silently: a kernel has
/// to do with fewer.
#[test]
fn llvmpipe_gives_up_loops_after_65_535_rounds() {
    let kernel = raw_kernel(
        "var n = 0u; for (var i = 0u; i < a; i += 1u) {
            for (var j = 0u; j < b; j += 1u) { n += 1u; } } return n;",
    );
    on_each_adapter(|name, device| {
        let rounds =
            |a: u32, b: u32| outputs(device, &kernel, KernelForm::Spirv, &[[a, b, 0, 0]])[0];
        for (a, b) in [(1, 60_000), (200, 300), (1, 70_000), (300, 300)] {
            let is_cut = name == "llvmpipe" && a * b > 65_535;
            println!("{name}: {a} x {b}: {} of {} rounds", rounds(a, b), a * b);
            assert_eq!(rounds(a, b) < a * b, is_cut, "{name}: {a} x {b}");
        }
    });
}
