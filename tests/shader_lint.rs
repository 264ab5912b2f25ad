//! Shaders: what is refused, and where; what is allowed; what is written. No adapter is needed.

use motes::gpu::shader::sources::{KERNELS, LIBRARIES};
use motes::gpu::shader::{self, CompileOptions, ShaderError, Step, compile_source};

/// A kernel whose line 9 is `line` and whose line 10 stores `stored`.
fn kernel(line: &str, stored: &str) -> String {
    format!(
        "// Line 1.
#import motes::exact::snap
@group(0) @binding(0) var<storage, read> input: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> output: array<vec4<f32>>;
@compute @workgroup_size(#{{WORKGROUP_SIZE}})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let v = input[id.x]; let x = v.x;
    let n = id.y; let i = bitcast<i32>(id.y);
    {line}
    output[id.x] = {stored};
}}
fn other(a: vec4<f32>) -> vec4<f32> {{ return a; }}
fn snapping(a: f32) -> vec4<f32> {{ return vec4<f32>(snap(a)); }}
fn lend(a: ptr<function, f32>) {{ *a = *a * 0.5f; }}
"
    )
}

fn refusal(text: &str) -> ShaderError {
    match compile_source("test/main", text, &CompileOptions::default()) {
        Ok(_) => panic!("was not refused:\n{text}"),
        Err(error) => error,
    }
}

/// Asserts that there is exactly one finding, in that line, that says `found`.
fn assert_refused(text: &str, step: Step, line: u32, found: &str) {
    let error = refusal(text);
    assert_eq!(error.step, step, "{error}\n{text}");
    assert_eq!(error.findings.len(), 1, "{error}\n{text}");
    let finding = &error.findings[0];
    assert_eq!(finding.at.file, "wgsl/test/main.wgsl", "{error}\n{text}");
    assert_eq!(finding.at.line, line, "{error}\n{text}");
    assert!(
        finding.found.contains(found),
        "no `{found}` in {error}\n{text}"
    );
    if step == Step::Lint {
        assert!(!finding.instead.is_empty(), "no way out in {error}");
    }
}

#[test]
fn forbidden_operations_are_refused_in_their_line() {
    let cases = [
        ("x / v.y", "`/`"),
        ("v / v.y", "`/`"),
        ("x % v.y", "`%`"),
        ("x < v.y", "`<`"),
        ("x > v.y", "`>`"),
        ("x <= v.y", "`<=`"),
        ("x >= v.y", "`>=`"),
        ("x == v.y", "`==`"),
        ("v != v.yxzw", "`!=`"),
        ("min(x, v.y)", "`min`"),
        ("max(v, v.yxzw)", "`max`"),
        ("clamp(x, 0.0f, 1.0f)", "`clamp`"),
        ("saturate(x)", "`saturate`"),
        ("floor(x)", "`floor`"),
        ("ceil(x)", "`ceil`"),
        ("round(x)", "`round`"),
        ("trunc(x)", "`trunc`"),
        ("fract(x)", "`fract`"),
        ("modf(x)", "`modf`"),
        ("frexp(x)", "`frexp`"),
        ("ldexp(x, i)", "`ldexp`"),
        ("sign(x)", "`sign`"),
        ("step(x, v.y)", "`step`"),
        ("smoothstep(x, v.y, v.z)", "`smoothstep`"),
        ("mix(x, v.y, v.z)", "`mix`"),
        ("fma(x, v.y, v.z)", "`fma`"),
        ("sqrt(x)", "`sqrt`"),
        ("inverseSqrt(x)", "`inverseSqrt`"),
        ("dot(v, v)", "`dot`"),
        ("cross(v.xyz, v.yzw)", "`cross`"),
        ("length(v)", "`length`"),
        ("distance(v, v.yxzw)", "`distance`"),
        ("normalize(v)", "`normalize`"),
        ("reflect(v, v.yxzw)", "`reflect`"),
        ("faceForward(v, v, v)", "`faceForward`"),
        ("pow(x, v.y)", "`pow`"),
        ("exp(x)", "`exp`"),
        ("exp2(x)", "`exp2`"),
        ("log(x)", "`log`"),
        ("log2(x)", "`log2`"),
        ("sin(x)", "`sin`"),
        ("cos(x)", "`cos`"),
        ("tan(x)", "`tan`"),
        ("asin(x)", "`asin`"),
        ("acos(x)", "`acos`"),
        ("atan(x)", "`atan`"),
        ("atan2(x, v.y)", "`atan2`"),
        ("sinh(x)", "`sinh`"),
        ("degrees(x)", "`degrees`"),
        ("radians(x)", "`radians`"),
        ("quantizeToF16(x)", "`quantizeToF16`"),
        ("pack4x8snorm(v)", "`pack4x8snorm`"),
        ("pack2x16float(v.xy)", "`pack2x16float`"),
        ("unpack4x8unorm(n)", "`unpack4x8unorm`"),
        ("unpack2x16float(n)", "`unpack2x16float`"),
        ("f32(n)", "integer to float"),
        ("f32(i)", "integer to float"),
        ("f32(n > 1u)", "bool to float"),
        ("u32(x)", "float to an integer"),
        ("vec4<i32>(v)", "float to an integer"),
        ("bool(x)", "float to bool"),
        ("bitcast<u32>(x)", "bitcast"),
        ("bitcast<vec4<i32>>(v)", "bitcast"),
        ("mat2x2<f32>(v.xy, v.zw)", "matrix"),
        ("mat2x2<f32>(v.xy, v.zw) * v.xy", "matrix"),
        // Folded before the IR is made.
        ("sqrt(2.0f)", "`sqrt`"),
        ("sin(2.0f) + x", "`sin`"),
        ("x * 0.5", "literal `0.5`"),
        ("x * 1e-3", "literal `1e-3`"),
        ("x * 0x1.8p1", "literal `0x1.8p1`"),
    ];
    for (expression, found) in cases {
        let text = kernel(&format!("let r = {expression};"), "input[0]");
        assert_refused(&text, Step::Lint, 9, found);
    }
}

#[test]
fn refused_even_where_nothing_uses_it() {
    let text = kernel("", "input[0]") + "fn unused(a: f32) -> f32 {\n    return a / 3.0f;\n}\n";
    assert_refused(&text, Step::Lint, 16, "`/`");
}

#[test]
fn allowed_operations_pass() {
    let lines = [
        "let r = x + v.y - x * v.z;",
        "let r = -v * x + x * v.wzyx - abs(v);",
        "let r = select(x, v.y, n > 1u);",
        "let r = select(v, v.yxzw, vec4<bool>(true, false, n < 2u, true));",
        "let r = bitcast<f32>(n) + bitcast<f32>(i) + f32(x);",
        "let r = vec3<f32>(x).zyx + vec3<f32>(1f, 0x1.8p3f, 1e-3f);",
        "let r = n / 3u + n % 5u + min(n, 7u) + clamp(n, 1u, 2u) + countOneBits(n << 2u);",
        "let r = i / 3 + abs(i) + sign(i) + max(i, 7) + dot(vec2<i32>(i), vec2<i32>(i));",
        "let r = u32(i) + u32(n > 1u) + select(0u, 1u, any(vec2<bool>(n > 1u, n < 9u)));",
        "var r = array<f32, 4>(x, x, x, x); r[n & 3u] = x * 2.0f; let s = r[i & 3];",
        "var r = 0.0f; for (var k = 0u; k < n; k++) { r += x; if k == 5u { break; } }",
        "switch n { case 1u, 2u: { } default: { } } /* 1.0 / 2.0 */ // sqrt(2.0)",
    ];
    for line in lines {
        let text = kernel(line, "input[0]");
        if let Err(error) = compile_source("test/main", &text, &CompileOptions::default()) {
            panic!("{error}\n{text}");
        }
    }
}

#[test]
fn floats_are_stored_snapped() {
    let good = [
        ("", "input[n]"),
        ("", "output[n]"),
        ("", "vec4<f32>(snap(x), 0.0f, input[n].y, snap(v.w))"),
        ("", "vec4<f32>(snap(x * 3.0f))"),
        ("", "vec4<f32>()"),
        ("", "select(input[0], vec4<f32>(snap(x)), n > 1u).wzyx"),
        ("", "snapping(x * 3.0f)"),
        (
            "var r = 0.0f; if n > 1u { r = snap(x * x); }",
            "vec4<f32>(r)",
        ),
        ("var r = v; r.x = snap(x * x); r[n] = r.y;", "r"),
        ("const HALF = vec4<f32>(0.5f);", "HALF"),
    ];
    for (line, stored) in good {
        let text = kernel(line, stored);
        if let Err(error) = compile_source("test/main", &text, &CompileOptions::default()) {
            panic!("{error}\n{text}");
        }
    }
    let bad = [
        ("", "v + v"),
        ("", "-input[n]"),
        ("", "vec4<f32>(snap(x), 0.0f, x * x, 1.0f)"),
        ("", "vec4<f32>(0.0f, 1e-20f, 0.0f, 0.0f)"),
        ("", "vec4<f32>(-0.0f)"),
        ("", "vec4<f32>(bitcast<f32>(n))"),
        ("", "select(input[0], v * 2.0f, n > 1u)"),
        ("", "other(input[n])"),
        ("var r = 0.0f; if n > 1u { r = x * x; }", "vec4<f32>(r)"),
        (
            "var r = v; loop { r.x = r.y + 1.0f; if n > 1u { break; } }",
            "r",
        ),
        ("var r = 0.0f; lend(&r);", "vec4<f32>(r)"),
        ("const TINY = vec4<f32>(0x1p-41f);", "TINY"),
    ];
    for (line, stored) in bad {
        assert_refused(
            &kernel(line, stored),
            Step::Lint,
            10,
            "without being snapped",
        );
    }
    let text = kernel("output[n].x = x * 2.0f;", "v");
    assert_refused(&text, Step::Lint, 9, "without being snapped");
}

#[test]
fn all_findings_are_collected() {
    let text = kernel("let r = x / v.y + sqrt(0.5);", "v * v");
    let lines: Vec<_> = refusal(&text).findings.iter().map(|f| f.at.line).collect();
    assert_eq!(lines, [9, 9, 9, 10]);
}

#[test]
fn types_other_than_integers_and_f32_are_refused() {
    let with = |declaration: &str| kernel("", "input[0]") + declaration + "\n";
    let declared = [
        ("struct S { m: mat4x4<f32> }", "matrix"),
        ("var<private> m: mat3x3<f32>;", "matrix"),
        ("var<workgroup> m: array<mat3x3<f32>, 2>;", "matrix"),
        ("fn f(m: mat2x2<f32>) { }", "matrix"),
        ("fn f() { var m: mat2x2<f32>; }", "matrix"),
        (
            "@group(0) @binding(2) var image: texture_2d<f32>;",
            "neither",
        ),
        ("@group(0) @binding(2) var s: sampler;", "neither"),
    ];
    for (declaration, found) in declared {
        assert_refused(&with(declaration), Step::Lint, 15, found);
    }
    assert_refused(
        &with("fn f() { let r = 1.0lf; }"),
        Step::Lint,
        15,
        "`1.0lf`",
    );
    // These do not even validate: kernels may not have the capability.
    for declaration in [
        "var<private> d: f64;",
        "@group(0) @binding(2) var<storage, read_write> a: atomic<f32>;",
    ] {
        assert_eq!(
            refusal(&with(declaration)).step,
            Step::Compose,
            "{declaration}"
        );
    }
    let half = |line| "enable f16;\n".to_owned() + &kernel(line, "input[0]");
    assert_refused(&half("let r = 1.0h;"), Step::Lint, 10, "`1.0h`");
    assert_eq!(refusal(&half("let r = f16(x);")).step, Step::Compose);
}

#[test]
fn composition_errors_have_file_and_line() {
    let unknown = kernel("let r = unknown_name;", "input[0]");
    assert_refused(&unknown, Step::Compose, 9, "unknown_name");
    let mistyped = kernel("let r = x + n;", "input[0]");
    assert_refused(&mistyped, Step::Compose, 9, "");
    let overridden = kernel("", "input[0]") + "override size: u32 = 3u;\n";
    assert_refused(&overridden, Step::Compose, 15, "override");
    let missing = kernel("let r = motes::nothing::at_all(x);", "input[0]");
    assert_refused(&missing, Step::Compose, 9, "motes::nothing");
}

#[test]
fn every_listed_file_passes_the_lint() {
    let errors: Vec<_> = LIBRARIES
        .iter()
        .chain(KERNELS)
        .filter_map(|source| shader::check(source.name).err())
        .map(|error| error.to_string())
        .collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
}
