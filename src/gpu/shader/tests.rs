//! Libraries of the test's own: where findings in imported code are shown, and what is trusted.

use super::compose::Input;
use super::sources::Source;
use super::{CompileOptions, ShaderError, Step, compile_input};

const EXACT: Source = Source {
    name: "lib/exact",
    file: "wgsl/lib/exact.wgsl",
    text: "// Comment of one line.
#define_import_path motes::exact

const SMALLEST: f32 = 0.5f;

fn unrelated(x: f32) -> f32 {
    return x;
}

fn snap(x: f32) -> f32 {
    return select(x, 0.0f, abs(x) < SMALLEST);
}

fn snap3(v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(snap(v.x), snap(v.y), snap(v.z));
}
",
};

/// Refused in line 9: only trusted libraries may compare floats.
const WIND: Source = Source {
    name: "lib/wind",
    file: "wgsl/lib/wind.wgsl",
    text: "// fn gust( in a comment is no declaration
#define_import_path motes::wind
#import motes::exact::{
    snap,
    snap3,
}

fn gust(x: f32) -> f32 {
    return select(snap(x), snap3(vec3<f32>(x)).y, x < 1.0f);
}
",
};

const KERNEL: &str = "#import motes::wind::gust
@group(0) @binding(0) var<storage, read_write> heights: array<f32>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn lift(@builtin(global_invocation_id) id: vec3<u32>) {
    heights[id.x] = gust(heights[id.x]);
}
";

fn compile(text: &str, libraries: &[Source]) -> Result<super::CompiledKernel, ShaderError> {
    let input = Input {
        name: "test/lift",
        file: "wgsl/test/lift.wgsl",
        text,
        libraries,
        workgroup_size: 64,
        off: &[],
        wide: false,
    };
    compile_input(&input, &CompileOptions::default())
}

fn places(error: &ShaderError) -> Vec<(&str, u32)> {
    let at = error.findings.iter().map(|f| &f.at);
    at.map(|at| (at.file.as_str(), at.line)).collect()
}

#[test]
fn findings_in_imported_code_name_its_file_and_line() {
    let error = compile(KERNEL, &[EXACT, WIND]).expect_err("a comparison in an untrusted library");
    assert_eq!(error.step, Step::Lint, "{error}");
    assert_eq!(places(&error), [("wgsl/lib/wind.wgsl", 9)], "{error}");
    assert!(
        error.findings[0].found.contains("comparison `<`"),
        "{error}"
    );
}

#[test]
fn findings_of_several_files_are_collected() {
    let text = KERNEL.replace("gust(heights[id.x])", "gust(heights[id.x] / 3.0)");
    let error = compile(&text, &[EXACT, WIND]).expect_err("three findings");
    let kernel = "wgsl/test/lift.wgsl";
    let want = [("wgsl/lib/wind.wgsl", 9), (kernel, 6), (kernel, 6)];
    assert_eq!(places(&error), want, "{error}");
}

#[test]
fn trusted_libraries_may_compare() {
    let wind = Source {
        text: "#define_import_path motes::wind
#import motes::exact::snap
fn gust(x: f32) -> f32 {
    return snap(x * 0.5f);
}
",
        ..WIND
    };
    let kernel = compile(KERNEL, &[EXACT, wind]).expect("only motes::exact compares");
    assert_eq!(kernel.entry_point, "lift");
    assert_eq!(kernel.workgroup_size, [64, 1, 1]);
}

#[test]
fn trust_is_in_the_file_not_in_what_a_kernel_calls_itself() {
    let text = "#define_import_path motes::exact
@group(0) @binding(0) var<storage, read_write> bits: array<u32>;
@compute @workgroup_size(8)
fn lift(@builtin(global_invocation_id) id: vec3<u32>) {
    bits[id.x] = select(0u, 1u, bitcast<f32>(bits[id.x]) < 1.0f);
}
";
    let error = compile(text, &[EXACT]).expect_err("a kernel is never trusted");
    assert_eq!(places(&error), [("wgsl/test/lift.wgsl", 5)], "{error}");
}

#[test]
fn broken_libraries_are_named() {
    let parse = Source {
        text: "#define_import_path motes::wind\n\nfn gust(x: f32) -> f32 {\n    return y;\n}\n",
        ..WIND
    };
    let types = Source {
        text: "#define_import_path motes::wind\n\nfn gust(x: f32) -> f32 {\n    return 1u;\n}\n",
        ..WIND
    };
    let digit = Source {
        text: "#define_import_path motes::wind\n\nstruct Row { a_0: f32 }\nfn gust(x: f32) -> f32 { return x; }\n",
        ..WIND
    };
    for (library, line) in [(parse, 4), (types, 4), (digit, 3)] {
        let error = compile(KERNEL, &[EXACT, library]).expect_err("a broken library");
        assert_eq!(error.step, Step::Compose, "{error}");
        assert_eq!(places(&error), [("wgsl/lib/wind.wgsl", line)], "{error}");
    }
    let error = compile(KERNEL, &[EXACT]).expect_err("a missing library");
    assert_eq!(places(&error), [("wgsl/test/lift.wgsl", 1)], "{error}");
    assert!(error.to_string().contains("motes::wind"), "{error}");
}
