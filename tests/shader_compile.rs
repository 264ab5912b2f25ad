//! Kernels as they reach an adapter: bindings, layouts, constants, SPIR-V and plain WGSL.

use std::path::Path;

use motes::gpu::shader::sources::{KERNELS, LIBRARIES, RASTERS, YARDSTICKS};
use motes::gpu::shader::{self, Access, CompileOptions, CompiledKernel, Step, compile_source};

/// A kernel whose line 6 is `line` and whose line 7 stores `stored`.
fn kernel(line: &str, stored: &str) -> String {
    format!(
        "#import motes::exact::snap
@group(0) @binding(0) var<storage, read> input: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> output: array<vec4<f32>>;
@compute @workgroup_size(#{{WORKGROUP_SIZE}})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let v = input[id.x]; let x = v.x; {line}
    output[id.x] = {stored};
}}
"
    )
}

fn compiled(text: &str) -> CompiledKernel {
    match compile_source("test/main", text, &CompileOptions::default()) {
        Ok(kernel) => kernel,
        Err(error) => panic!("{error}\n{text}"),
    }
}

/// Asserts that the host's contract is refused with one finding, in that line, that says `found`.
fn assert_refused(text: &str, line: u32, found: &str) {
    let error = compile_source("test/main", text, &CompileOptions::default());
    let error = error.expect_err("it breaks the contract");
    assert_eq!(error.step, Step::Reflect, "{error}\n{text}");
    assert_eq!(error.findings.len(), 1, "{error}\n{text}");
    let finding = &error.findings[0];
    assert_eq!(finding.at.file, "wgsl/test/main.wgsl", "{error}\n{text}");
    assert_eq!(finding.at.line, line, "{error}\n{text}");
    assert!(
        finding.found.contains(found),
        "no `{found}` in {error}\n{text}"
    );
}

#[test]
fn bindings_are_dense_in_group_0_and_used() {
    let swap = |from: &str, to: &str| kernel("", "input[0]").replace(from, to);
    let gap = swap("@binding(1)", "@binding(2)");
    assert_refused(&gap, 3, "`output` is @binding(2)");
    let late = swap("@binding(0)", "@binding(3)");
    assert_refused(&late, 3, "`output` is @binding(1)");
    let group = swap("@group(0) @binding(1)", "@group(1) @binding(1)");
    assert_refused(&group, 3, "group 1");
    let unused = kernel("", "input[0]") + "@group(0) @binding(2) var<storage> more: array<u32>;\n";
    assert_refused(&unused, 9, "`more` is never used");
    let entry = kernel("", "input[0]") + "@compute @workgroup_size(8) fn second() { }\n";
    assert_refused(&entry, 1, "2 entry points");
    let twice = swap("@binding(1)", "@binding(0)");
    let twice = compile_source("test/main", &twice, &CompileOptions::default());
    let twice = twice.expect_err("two buffers with one number");
    assert_eq!(twice.findings[0].at.line, 3, "{twice}");
}

#[test]
fn bindings_are_reflected() {
    let text = "#import motes::layout::Particle
struct Push { count: u32, scale: vec3<f32> }
struct Table { len: u32, rows: array<Particle> }
var<immediate> push: Push;
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;
@group(0) @binding(0) var<uniform> push_more: Push;
@group(0) @binding(1) var<storage, read> particles: array<Particle>;
@group(0) @binding(3) var<storage, read> table: Table;
@compute @workgroup_size(#{WORKGROUP_SIZE})
fn count(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = particles[id.x].position_and_index.w + table.rows[id.x].position_and_index.w;
    atomicAdd(&counts[at], push.count + push_more.count);
}
";
    let options = CompileOptions {
        workgroup_size: 64,
        ..CompileOptions::default()
    };
    let kernel = compile_source("test/count", text, &options).expect("a good kernel");
    assert_eq!(kernel.name, "test/count");
    assert_eq!(kernel.entry_point, "count");
    assert_eq!(kernel.workgroup_size, [64, 1, 1]);
    assert_eq!(kernel.immediate_size, 32);
    let seen: Vec<_> = kernel
        .bindings
        .iter()
        .map(|b| {
            let shape = (
                b.shape.type_name.as_str(),
                b.shape.runtime_array,
                b.shape.stride,
            );
            (b.binding, b.name.as_str(), b.access, shape, b.line)
        })
        .collect();
    let want = [
        (0, "push_more", Access::Uniform, ("Push", false, 32), 6),
        (1, "particles", Access::Read, ("Particle", true, 32), 7),
        (2, "counts", Access::ReadWrite, ("atomic<u32>", true, 4), 5),
        (3, "table", Access::Read, ("Table", false, 48), 8),
    ];
    assert_eq!(seen, want);
    let fields = |binding: usize| {
        let fields = kernel.bindings[binding].shape.fields.iter();
        let fields = fields.map(|f| (f.name.as_str(), f.type_name.as_str(), f.offset, f.size));
        fields.collect::<Vec<_>>()
    };
    let push = [("count", "u32", 0, 4), ("scale", "vec3<f32>", 16, 12)];
    assert_eq!(fields(0), push);
    let table = [("len", "u32", 0, 4), ("rows", "array<Particle>", 16, 0)];
    assert_eq!(fields(3), table);
    assert_eq!(fields(2), []);
}

#[test]
fn structs_and_constants_of_libraries_can_be_asked_for() {
    let particle = shader::struct_layout("lib/layout", "Particle").expect("it composes");
    let particle = particle.expect("it is there");
    assert_eq!((particle.stride, particle.fields.len()), (32, 2));
    assert_eq!(particle.fields[1].offset, 16);
    let nothing = shader::struct_layout("lib/layout", "Nothing").expect("it composes");
    assert_eq!(nothing, None);
    let names = shader::struct_names("lib/layout").expect("it composes");
    assert!(names.iter().any(|n| n == "Particle"), "{names:?}");
    let constants = shader::constants("lib/exact").expect("it composes");
    let smallest = constants.iter().find(|c| c.name == "SMALLEST");
    let smallest = smallest.expect("lib/exact has the threshold of snapping");
    assert!(smallest.is_float);
    assert_eq!(f32::from_bits(smallest.bits), 2f32.powi(-40));
    assert_eq!(
        shader::constants("lib/nothing").map_err(|e| e.step),
        Err(Step::Find)
    );
}

#[test]
fn every_wgsl_file_is_listed_once() {
    fn walk(folder: &Path, found: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).expect("wgsl/ can be read") {
            let path = entry.expect("wgsl/ can be read").path();
            if path.is_dir() {
                walk(&path, found);
            } else {
                found.push(path.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    walk(&root.join("wgsl"), &mut found);
    let root = root.to_string_lossy().replace('\\', "/") + "/";
    let mut found: Vec<_> = found.iter().map(|f| f.replacen(&root, "", 1)).collect();
    found.sort();
    let mut listed: Vec<_> = KERNELS
        .iter()
        .chain(YARDSTICKS)
        .chain(RASTERS)
        .chain(LIBRARIES)
        .map(|s| s.file)
        .collect();
    listed.sort_unstable();
    // One that is run twice has two names.
    listed.dedup();
    assert_eq!(found, listed);

    let mut basenames: Vec<_> = KERNELS
        .iter()
        .filter_map(|k| k.name.rsplit('/').next())
        .collect();
    basenames.sort_unstable();
    let count = basenames.len();
    basenames.dedup();
    assert_eq!(basenames.len(), count, "two kernels share a basename");
}

#[test]
fn every_kernel_compiles_at_every_size_and_is_decorated() {
    for kernel in KERNELS.iter().chain(YARDSTICKS) {
        for workgroup_size in [64, 128, 256] {
            for checked in [false, true] {
                for (off, wide) in [
                    (&[][..], false),
                    (&[][..], true),
                    (&["THRESHOLDS", "STREAKS", "RECTANGLES"][..], false),
                ] {
                    let options = CompileOptions {
                        workgroup_size,
                        checked,
                        off,
                        wide,
                        ..CompileOptions::default()
                    };
                    match shader::compile(kernel.name, &options) {
                        Ok(compiled) => assert_exact(kernel.name, &compiled.spirv),
                        Err(error) => panic!("{options:?}: {error}"),
                    }
                }
            }
        }
    }
}

#[test]
fn shaders_of_the_rasteriser_are_valid_wgsl() {
    for raster in RASTERS {
        let module = naga::front::wgsl::parse_str(raster.text)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string_with_path(raster.text, raster.file)));
        let flags = naga::valid::ValidationFlags::all();
        let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
        if let Err(error) = validator.validate(&module) {
            panic!(
                "{}",
                error.emit_to_string_with_path(raster.text, raster.file)
            );
        }
    }
}

#[test]
fn vector_times_scalar_is_written_as_plain_products() {
    let text = kernel(
        "let r = v * x + x * v - v.xy.xyxy * 2.0f;",
        "vec4<f32>(snap(r.x))",
    );
    let compiled = compiled(&text);
    assert_exact("test/main", &compiled.spirv);
    let products = instructions(&compiled.spirv).filter(|i| i[0] & 0xffff == 133);
    assert_eq!(products.count(), 3);
}

#[test]
fn plain_wgsl_is_the_same_kernel() {
    let text = kernel("let r = v * x;", "vec4<f32>(snap(r.x))");
    let compiled = compiled(&text);
    let module = naga::front::wgsl::parse_str(&compiled.wgsl).expect("it is plain WGSL");
    assert_eq!(module.entry_points.len(), 1);
    assert_eq!(module.entry_points[0].name, compiled.entry_point);
    assert_eq!(
        module.entry_points[0].workgroup_size,
        compiled.workgroup_size
    );
}

#[test]
fn a_mutant_differs_and_escapes_the_lint() {
    let text = kernel("let r = x + v.y;", "vec4<f32>(snap(r))");
    let mutate = |module: &mut naga::Module| {
        for (_, expression) in module.entry_points[0].function.expressions.iter_mut() {
            if let naga::Expression::Binary { op, .. } = expression {
                *op = naga::BinaryOperator::Divide;
            }
        }
    };
    let plain = compile_source("test/main", &text, &CompileOptions::default());
    let options = CompileOptions {
        mutate: Some(&mutate),
        ..CompileOptions::default()
    };
    let mutant = compile_source("test/main", &text, &options).expect("mutants are not linted");
    assert_ne!(plain.expect("a good kernel").spirv, mutant.spirv);
    assert!(instructions(&mutant.spirv).any(|i| i[0] & 0xffff == 136));
}

/// The instructions of a SPIR-V module (2.3: five words of header, then opcode and length).
fn instructions(words: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut at = 5;
    std::iter::from_fn(move || {
        let len = (words.get(at)? >> 16) as usize;
        assert!(len > 0 && at + len <= words.len(), "broken at word {at}");
        at += len;
        Some(&words[at - len..at])
    })
}

/// Asserts, from the words alone, that float arithmetic is exact operations, all decorated, and
/// that decorations stand where they belong.
fn assert_exact(name: &str, words: &[u32]) {
    assert_eq!(words[0], 0x0723_0203, "{name}: magic number");
    let mut decorated = Vec::new();
    let mut results = Vec::new();
    let mut types_began = false;
    for instruction in instructions(words) {
        match (instruction[0] & 0xffff, instruction) {
            // OpDecorate … NoContraction
            (71, &[_, id, 42]) => {
                assert!(!types_began, "{name}: a decoration after the first type");
                decorated.push(id);
            }
            // Capabilities to execution modes: the decorations come later.
            (10 | 11 | 14..=17, _) => assert!(decorated.is_empty(), "{name}: decorated too early"),
            (19..=52, _) => types_began = true,
            (127 | 129 | 131 | 133, &[_, _, result, ..]) => results.push(result),
            // Float division, remainders, products with matrices and the like, dot, comparisons
            // that also ask for NaN, derivatives.
            (op @ (136 | 140 | 141 | 142..=148 | 156..=159 | 207..=215), _) => {
                panic!("{name}: opcode {op}");
            }
            _ => {}
        }
    }
    decorated.sort_unstable();
    results.sort_unstable();
    assert_eq!(decorated, results, "{name}");
    assert!(
        results.iter().all(|&id| id < words[3]),
        "{name}: id beyond the bound"
    );
}
