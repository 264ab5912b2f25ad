//! Every function of the shared libraries, in WGSL and in Rust, to be evaluated on the same
//! arguments by an adapter and by the processor.

mod covers;
mod structs;

use glam::{Vec2, Vec3};
use motes::cpu::light::{light_of, steps_of};
use motes::exact::*;
use motes::gpu::dispatch::dispatch_for;
use motes::gpu::shader::{CompileOptions, CompiledKernel, ShaderError, compile_source};
use motes::noise::noise;
use motes::rng::{index_below, pcg4d, signed_float, signed4, unit_float, unit4};
use motes::transcendental::*;

use super::Arguments;
use covers::*;
use structs::*;

/// One word that both sides compute: an expression in WGSL and its twin.
pub(crate) type Probe = (&'static str, fn(&Arguments) -> u32);

/// A probe kernel: its name, what it imports, and its words.
pub(crate) struct ProbeKernel {
    pub(crate) name: &'static str,
    imports: &'static str,
    /// The libraries whose every function it evaluates.
    pub(crate) libraries: &'static [&'static str],
    pub(crate) probes: &'static [Probe],
}

/// 2^40.
const LARGE: f32 = 1_099_511_627_776.0;

/// The snapped bits of a float, one pattern for all NaNs.
fn bits(x: f32) -> u32 {
    if x.is_nan() { 0x7fc0_0000 } else { bits_of(x) }
}

#[rustfmt::skip] // one probe a line
pub(crate) static PROBES: &[ProbeKernel] = &[
    ProbeKernel { name: "probe/exact", imports: "", libraries: &["motes::exact"], probes: &[
        // What is not snapped is made large enough to be seen: outputs are snapped themselves.
        ("bits(snap(f) * LARGE)", |r| bits(snap(r.f()) * LARGE)),
        ("bits(snap2(raw.xy).x * LARGE)", |r| bits(snap2(Vec2::new(r.p, r.q)).x * LARGE)),
        ("bits(snap2(raw.xy).y * LARGE)", |r| bits(snap2(Vec2::new(r.p, r.q)).y * LARGE)),
        ("bits(snap3(raw.xyz).y * LARGE)", |r| bits(snap3(Vec3::new(r.p, r.q, r.f())).y * LARGE)),
        ("bits(snap4(raw).x * LARGE)", |r| bits(snap4(r.raw4()).x * LARGE)),
        ("bits(snap4(raw).z * LARGE)", |r| bits(snap4(r.raw4()).z * LARGE)),
        ("bits(min_exact(p, q) * LARGE)", |r| bits(min_exact(r.p, r.q) * LARGE)),
        ("bits(max_exact(p, q) * LARGE)", |r| bits(max_exact(r.p, r.q) * LARGE)),
        // Of a NaN, each driver has its own bits.
        ("bits_of(p)", |r| bits_of(r.p)),
        ("u32(less(p, q))", |r| u32::from(less(r.p, r.q))),
        ("u32(less(a, b))", |r| u32::from(less(r.a, r.b))),
        ("u32(less_equal(p, q))", |r| u32::from(less_equal(r.p, r.q))),
        ("u32(less_equal(a, b))", |r| u32::from(less_equal(r.a, r.b))),
        ("bits(min_exact(p, q))", |r| bits(min_exact(r.p, r.q))),
        ("bits(max_exact(p, q))", |r| bits(max_exact(r.p, r.q))),
        ("bits(max_exact(a, b))", |r| bits(max_exact(r.a, r.b))),
        ("bits(clamp_exact(a, -b, d))", |r| bits(clamp_exact(r.a, -r.b, r.d))),
        ("bits(clamp_exact(c, 0.0f, 1.0f))", |r| bits(clamp_exact(r.c, 0.0, 1.0))),
        ("bits(at_least_zero(p) * LARGE)", |r| bits(max_exact(r.p, 0.0) * LARGE)),
        ("bits(at_least_zero(c))", |r| bits(at_least_zero(r.c))),
        ("bits(clamp_unit(p) * LARGE)", |r| bits(clamp_exact(r.p, 0.0, 1.0) * LARGE)),
        ("bits(clamp_unit(c))", |r| bits(clamp_unit(r.c))),
        ("bits(clamp_unit(c * 0.01f))", |r| bits(clamp_exact(r.c * 0.01, 0.0, 1.0))),
        ("bits(min3(abc, dcb).x)", |r| bits(min3(r.abc(), r.dcb()).x)),
        ("bits(min3(abc, dcb).y)", |r| bits(min3(r.abc(), r.dcb()).y)),
        ("bits(min3(abc, dcb).z)", |r| bits(min3(r.abc(), r.dcb()).z)),
        ("bits(max3(abc, dcb).x)", |r| bits(max3(r.abc(), r.dcb()).x)),
        ("bits(max3(abc, dcb).y)", |r| bits(max3(r.abc(), r.dcb()).y)),
        ("bits(max3(abc, dcb).z)", |r| bits(max3(r.abc(), r.dcb()).z)),
        ("bits(clamp3(abc, dcb, cdd).y)", |r| bits(clamp3(r.abc(), r.dcb(), r.cdd()).y)),
        ("bits(clamp3(abc, dcb, cdd).z)", |r| bits(clamp3(r.abc(), r.dcb(), r.cdd()).z)),
        ("bits(floor_exact(p))", |r| bits(floor_exact(r.p))),
        ("bits(floor_exact(c))", |r| bits(floor_exact(r.c))),
        ("u32(to_i32(f))", |r| to_i32(r.f()).cast_unsigned()),
        ("u32(to_i32(c))", |r| to_i32(r.c).cast_unsigned()),
        ("to_u32(f)", |r| to_i32(r.f()).max(0).cast_unsigned()),
        ("to_u32(c)", |r| to_u32(r.c)),
        ("low_bits(floor_exact(c))", |r| low_bits(floor_exact(r.c))),
        ("u32(limbs3(abc).coarse.x)", |r| limbs3(r.abc()).coarse.x.cast_unsigned()),
        ("u32(limbs3(abc).coarse.z)", |r| limbs3(r.abc()).coarse.z.cast_unsigned()),
        ("u32(limbs3(cdd * 65536.0f).coarse.y)", |r| limbs3(r.cdd() * 65_536.0).coarse.y.cast_unsigned()),
        ("u32(limbs3(abc).fine.y)", |r| limbs3(r.abc()).fine.y.cast_unsigned()),
        ("u32(limbs3(abc).fine.z)", |r| limbs3(r.abc()).fine.z.cast_unsigned()),
        ("u32(limbs3(cdd * 65536.0f).fine.z)", |r| limbs3(r.cdd() * 65_536.0).fine.z.cast_unsigned()),
        ("bits(f32_of_i32(i32(i)))", |r| bits(f32_of_i32(r.i.cast_signed()))),
        ("bits(f32_of_u32(i))", |r| bits(f32_of_u32(r.i))),
        ("bits(reciprocal(f))", |r| bits(reciprocal(r.f()))),
        ("bits(reciprocal(f) * LARGE)", |r| bits(reciprocal(r.f()) * LARGE)),
        ("bits(reciprocal(c))", |r| bits(reciprocal(r.c))),
        ("bits(inverse_square_root(f))", |r| bits(inverse_square_root(r.f()))),
        ("bits(inverse_square_root(c))", |r| bits(inverse_square_root(r.c))),
        ("bits(square_root(f))", |r| bits(square_root(r.f()))),
        ("bits(square_root(d))", |r| bits(square_root(r.d))),
        ("bits(dot3(abc, dcb))", |r| bits(dot3(r.abc(), r.dcb()))),
        ("bits(dot3(cdd, dcb))", |r| bits(dot3(r.cdd(), r.dcb()))),
        ("bits(cross3(abc, dcb).x)", |r| bits(cross3(r.abc(), r.dcb()).x)),
        ("bits(cross3(abc, dcb).y)", |r| bits(cross3(r.abc(), r.dcb()).y)),
        ("bits(cross3(abc, dcb).z)", |r| bits(cross3(r.abc(), r.dcb()).z)),
        ("bits(length3(abc))", |r| bits(length3(r.abc()))),
        ("bits(length3(cdd))", |r| bits(length3(r.cdd()))),
        ("bits(length3(vec3f(b, d, a)))", |r| bits(length3(Vec3::new(r.b, r.d, r.a)))),
        ("bits(normalize_exact(abc).x)", |r| bits(normalize_exact(r.abc()).x)),
        ("bits(normalize_exact(cdd).x)", |r| bits(normalize_exact(r.cdd()).x)),
        ("bits(normalize_exact(cdd).z)", |r| bits(normalize_exact(r.cdd()).z)),
        ("bits(normalize_exact(vec3f(c, d, a)).y)", |r| bits(normalize_exact(Vec3::new(r.c, r.d, r.a)).y)),
    ] },
    ProbeKernel { name: "probe/transcendental", imports: "#import motes::transcendental::{\
        sin_turns, cos_turns, exp2_exact, log2_exact, cube_root}", libraries: &["motes::transcendental"], probes: &[
        ("bits(sin_turns(c))", |r| bits(sin_turns(r.c))),
        ("bits(sin_turns(d * 0.01f))", |r| bits(sin_turns(r.d * 0.01))),
        ("bits(sin_turns(a))", |r| bits(sin_turns(r.a))),
        ("bits(cos_turns(c))", |r| bits(cos_turns(r.c))),
        ("bits(cos_turns(b))", |r| bits(cos_turns(r.b))),
        ("bits(sin_turns(a) * LARGE)", |r| bits(sin_turns(r.a) * LARGE)),
        ("bits(log2_exact(d) * LARGE)", |r| bits(log2_exact(r.d) * LARGE)),
        ("bits(exp2_exact(c))", |r| bits(exp2_exact(r.c))),
        ("bits(exp2_exact(a))", |r| bits(exp2_exact(r.a))),
        ("bits(log2_exact(a))", |r| bits(log2_exact(r.a))),
        ("bits(log2_exact(abs(d)))", |r| bits(log2_exact(r.d.abs()))),
        ("bits(cube_root(a))", |r| bits(cube_root(r.a))),
        ("bits(cube_root(abs(c)))", |r| bits(cube_root(r.c.abs()))),
    ] },
    ProbeKernel { name: "probe/integers", imports: "\
        #import motes::rng::{index_below, pcg4d, unit_float, signed_float, unit4, signed4}\n\
        #import motes::dispatch::{dispatch_for, linear_index}\n\
        #import motes::light::{light_of, steps_of}", libraries: &["motes::rng", "motes::dispatch", "motes::light"], probes: &[
        ("pcg4d(words).x", |r| pcg4d(r.words()).x),
        ("pcg4d(words).y", |r| pcg4d(r.words()).y),
        ("pcg4d(words).z", |r| pcg4d(r.words()).z),
        ("pcg4d(words).w", |r| pcg4d(r.words()).w),
        ("index_below(i, w)", |r| index_below(r.i, r.w)),
        // Where each carry counts.
        ("index_below(~(i & 7u), ~(w & 7u))", |r| index_below(!(r.i & 7), !(r.w & 7))),
        ("bits(unit_float(i))", |r| bits(unit_float(r.i))),
        ("bits(signed_float(w))", |r| bits(signed_float(r.w))),
        ("bits(unit4(words).x)", |r| bits(unit4(r.words()).x)),
        ("bits(unit4(words).y)", |r| bits(unit4(r.words()).y)),
        ("bits(unit4(words).z)", |r| bits(unit4(r.words()).z)),
        ("bits(unit4(words).w)", |r| bits(unit4(r.words()).w)),
        ("bits(signed4(words).x)", |r| bits(signed4(r.words()).x)),
        ("bits(signed4(words).y)", |r| bits(signed4(r.words()).y)),
        ("bits(signed4(words).z)", |r| bits(signed4(r.words()).z)),
        ("bits(signed4(words).w)", |r| bits(signed4(r.words()).w)),
        // Fewer than 2^32 less a workgroup, in workgroups of 8 to 256.
        ("dispatch_for(i >> 1u, 8u).x", |r| dispatch_for(r.i >> 1, 8).0),
        ("dispatch_for(i >> 1u, 8u).y", |r| dispatch_for(r.i >> 1, 8).1),
        ("dispatch_for(i >> 1u, 256u).y", |r| dispatch_for(r.i >> 1, 256).1),
        ("dispatch_for(i >> 20u, 64u).x", |r| dispatch_for(r.i >> 20, 64).0),
        ("dispatch_for(i >> 20u, 64u).z", |r| u32::from(r.i >> 20 > 0)),
        ("linear_index(vec3u(w & 0xffffffu, i & 7u, 0u), 64u)",
            |r| (r.w & 0xff_ffff) + (r.i & 7) * 32_768 * 64),
        ("steps_of(c)", |r| steps_of(r.c)),
        ("steps_of(a)", |r| steps_of(r.a)),
        ("bits(light_of(w, i))", |r| bits(light_of(r.w, r.i))),
        ("bits(light_of(w, i >> 28u))", |r| bits(light_of(r.w, r.i >> 28))),
    ] },
    ProbeKernel { name: "probe/noise", imports: NOISE_IMPORTS, libraries: &["motes::noise"], probes: &[
        ("bits(corner_gradient(w, i, w >> 7u, i ^ w).x)", |r| bits(corner(r).x)),
        ("bits(corner_gradient(w, i, w >> 7u, i ^ w).y)", |r| bits(corner(r).y)),
        ("bits(corner_gradient(w, i, w >> 7u, i ^ w).z)", |r| bits(corner(r).z)),
        // Anywhere; with ties, on corners and edges; near the origin.
        ("bits(noise(vec3f(c, d, c * 0.37f - d), i).x)", |r| bits(anywhere(r).x)),
        ("bits(noise(vec3f(c, d, c * 0.37f - d), i).y)", |r| bits(anywhere(r).y)),
        ("bits(noise(vec3f(c, d, c * 0.37f - d), i).z)", |r| bits(anywhere(r).z)),
        ("bits(noise(vec3f(c, d, c * 0.37f - d), i).w)", |r| bits(anywhere(r).w)),
        ("bits(noise(cdd, w).x)", |r| bits(noise(r.cdd(), r.w).x)),
        ("bits(noise(cdd, w).w)", |r| bits(noise(r.cdd(), r.w).w)),
        ("bits(noise(vec3f(d, c, c) * 0.01f, w).y)",
            |r| bits(noise(Vec3::new(r.d, r.c, r.c) * 0.01, r.w).y)),
        ("bits(noise(clamp3(abc, vec3f(-99.0f), vec3f(99.0f)), 7u).z)",
            |r| bits(noise(clamp3(r.abc(), Vec3::splat(-99.0), Vec3::splat(99.0)), 7).z)),
    ] },
    ProbeKernel { name: "probe/wind", imports: WIND_IMPORTS, libraries: &["motes::wind"], probes: &[
        ("bits(flow(0u, c, d, w, i).y)", |r| bits(flow(r, 0).y)),
        ("bits(flow(1u, c, d, w, i).x)", |r| bits(flow(r, 1).x)),
        ("bits(flow(1u, c, d, w, i).y)", |r| bits(flow(r, 1).y)),
        ("bits(flow(1u, c, d, w, i).z)", |r| bits(flow(r, 1).z)),
        ("bits(flow(2u, c, d, w, i).x)", |r| bits(flow(r, 2).x)),
        ("bits(flow(2u, c, d, w, i).z)", |r| bits(flow(r, 2).z)),
        ("bits(flow(3u, c, d, w, i).y)", |r| bits(flow(r, 3).y)),
        ("bits(flow(3u, c, d, w, i).z)", |r| bits(flow(r, 3).z)),
        ("bits(flow(4u, c, d, w, i).x)", |r| bits(flow(r, 4).x)),
        ("bits(flow(4u, c, d, w, i).z)", |r| bits(flow(r, 4).z)),
        ("bits(flow(5u, c, d, w, i).x)", |r| bits(flow(r, 5).x)),
        ("bits(flow(5u, c, d, w, i).y)", |r| bits(flow(r, 5).y)),
        ("bits(flow(5u, c, d, w, i).z)", |r| bits(flow(r, 5).z)),
    ] },
    ProbeKernel { name: "probe/covers", imports: COVER_IMPORTS, libraries: &["motes::cover", "motes::shape"], probes: &[
        ("bits(part(0u, w, i))", |r| bits(part(r, 0))),
        ("record(0u, w, i, 1u)", |r| record(r, 0, 1)),
        ("bits(part(1u, w, i))", |r| bits(part(r, 1))),
        ("record(1u, w, i, 1u)", |r| record(r, 1, 1)),
        ("bits(part(2u, w, i))", |r| bits(part(r, 2))),
        ("record(2u, w, i, 1u)", |r| record(r, 2, 1)),
        ("bits(part(3u, w, i))", |r| bits(part(r, 3))),
        ("record(3u, w, i, 1u)", |r| record(r, 3, 1)),
        ("bits(part(4u, w, i))", |r| bits(part(r, 4))),
        ("record(4u, w, i, 1u)", |r| record(r, 4, 1)),
        ("bits(part(6u, w, i))", |r| bits(part(r, 6))),
        ("record(6u, w, i, 2u)", |r| record(r, 6, 2)),
        ("record(6u, w, i, 3u)", |r| record(r, 6, 3)),
        ("record(6u, w, i, 5u)", |r| record(r, 6, 5)),
        ("record(0u, w, i, 2u)", |r| record(r, 0, 2)),
        ("record(0u, w, i, 4u)", |r| record(r, 0, 4)),
        ("record(0u, w, i, 11u)", |r| record(r, 0, 11)),
        ("record(1u, w, i, 5u)", |r| record(r, 1, 5)),
        ("record(2u, w, i, 4u)", |r| record(r, 2, 4)),
        ("record(3u, w, i, 3u)", |r| record(r, 3, 3)),
        ("record(3u, w, i, 4u)", |r| record(r, 3, 4)),
        ("record(3u, w, i, 11u)", |r| record(r, 3, 11)),
        ("record(4u, w, i, 5u)", |r| record(r, 4, 5)),
        ("record(4u, w, i, 11u)", |r| record(r, 4, 11)),
        ("record(1u, w, i, 7u)", |r| record(r, 1, 7)),
        ("record(1u, w, i, 12u)", |r| record(r, 1, 12)),
        ("record(3u, w, i, 6u)", |r| record(r, 3, 6)),
        ("record(0u, w, i, 14u)", |r| record(r, 0, 14)),
        ("record(2u, w, i, 8u)", |r| record(r, 2, 8)),
        ("record(1u, w, i, 9u)", |r| record(r, 1, 9)),
        ("record(4u, w, i, 10u)", |r| record(r, 4, 10)),
        ("record(2u, w, i, 2u)", |r| record(r, 2, 2)),
        ("record(2u, w, i, 3u)", |r| record(r, 2, 3)),
        ("record(2u, w, i, 5u)", |r| record(r, 2, 5)),
        ("record(0u, w, i, 3u)", |r| record(r, 0, 3)),
        ("bounds(0u, w, i)", |r| bounds(r, 0)),
        ("bounds(1u, w, i)", |r| bounds(r, 1)),
        ("bounds(2u, w, i)", |r| bounds(r, 2)),
        ("bounds(3u, w, i)", |r| bounds(r, 3)),
        ("bounds(4u, w, i)", |r| bounds(r, 4)),
        ("bits(over(0u, c, w, i)[0])", |r| bits(over(r, 0)[0])),
        ("bits(over(0u, c, w, i)[1])", |r| bits(over(r, 0)[1])),
        ("bits(over(0u, c, w, i)[2])", |r| bits(over(r, 0)[2])),
        ("bits(over(0u, c, w, i)[3])", |r| bits(over(r, 0)[3])),
        ("bits(over(1u, c, w, i)[0])", |r| bits(over(r, 1)[0])),
        ("bits(over(1u, c, w, i)[1])", |r| bits(over(r, 1)[1])),
        ("bits(over(1u, c, w, i)[2])", |r| bits(over(r, 1)[2])),
        ("bits(over(1u, c, w, i)[3])", |r| bits(over(r, 1)[3])),
        ("bits(over(2u, c, w, i)[0])", |r| bits(over(r, 2)[0])),
        ("bits(over(2u, c, w, i)[1])", |r| bits(over(r, 2)[1])),
        ("bits(over(2u, c, w, i)[2])", |r| bits(over(r, 2)[2])),
        ("bits(over(2u, c, w, i)[3])", |r| bits(over(r, 2)[3])),
        ("bits(part(5u, w, i))", |r| bits(part(r, 5))),
        ("bits(part(7u, w, i))", |r| bits(part(r, 7))),
        ("record(7u, w, i, 4u)", |r| record(r, 7, 4)),
        ("record(7u, w, i, 12u)", |r| record(r, 7, 12)),
        ("record(5u, w, i, 2u)", |r| record(r, 5, 2)),
        ("record(5u, w, i, 4u)", |r| record(r, 5, 4)),
        ("record(5u, w, i, 5u)", |r| record(r, 5, 5)),
        ("record(5u, w, i, 11u)", |r| record(r, 5, 11)),
        ("bounds(5u, w, i)", |r| bounds(r, 5)),
        ("sides(0u, w, i)", |r| sides(r, 0)),
        ("sides(4u, w, i)", |r| sides(r, 4)),
        ("bits(over(5u, c, w, i)[0])", |r| bits(over(r, 5)[0])),
        ("bits(over(5u, c, w, i)[2])", |r| bits(over(r, 5)[2])),
        ("bits(over(5u, c, w, i)[3])", |r| bits(over(r, 5)[3])),
        ("key(p, w)", |r| key(r)),
    ] },
    ProbeKernel { name: "probe/area", imports: AREA_IMPORTS, libraries: &["motes::area"], probes: &[
        ("bits(area_px(c, d, w, i))", |r| bits(area_px(r))),
    ] },
];

impl ProbeKernel {
    /// The kernel's text: words in, words out, `probes.len()` an invocation.
    pub(crate) fn text(&self) -> String {
        let count = self.probes.len();
        let stores: String = self
            .probes
            .iter()
            .enumerate()
            .map(|(at, (expression, _))| format!("    output[at + {at}u] = {expression};\n"))
            .collect();
        format!(
            "#import motes::exact::{{at_least_zero, bits_of, clamp3, clamp_exact, clamp_unit, cross3, dot3, f32_of_i32, \
             f32_of_u32, floor_exact, inverse_square_root, length3, less, less_equal, limbs3, max3, \
             max_exact, min3, min_exact, normalize_exact, reciprocal, snap, snap2, snap3, snap4, \
             square_root, to_i32, to_u32, low_bits}}
{}
@group(0) @binding(0) var<storage, read> input: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> output: array<u32>;

const LARGE: f32 = 1099511627776.0f;

fn bits(x: f32) -> u32 {{
    let b = bits_of(x);
    return select(b, 0x7fc00000u, (b & 0x7fffffffu) > 0x7f800000u);
}}

@compute @workgroup_size(#{{WORKGROUP_SIZE}})
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x * 2u + 1u >= arrayLength(&input) {{ return; }}
    let first = input[id.x * 2u];
    let second = input[id.x * 2u + 1u];
    let a = bitcast<f32>(first.x);
    let b = bitcast<f32>(first.y);
    let c = bitcast<f32>(first.z);
    let d = bitcast<f32>(first.w);
    let p = bitcast<f32>(second.x);
    let q = bitcast<f32>(second.y);
    let w = second.z;
    let f = bitcast<f32>(w);
    let i = second.w;
    let abc = vec3f(a, b, c);
    let dcb = vec3f(d, c, b);
    let cdd = vec3f(c, d, d);
    let raw = vec4f(p, q, f, c);
    let words = vec4u(w, i, first.x, first.z);
    let at = id.x * {count}u;
{stores}}}
",
            self.imports
        )
    }

    /// The kernel, compiled.
    ///
    /// # Errors
    /// A change made the module invalid.
    pub(crate) fn compile(&self, options: &CompileOptions) -> Result<CompiledKernel, ShaderError> {
        compile_source(self.name, &self.text(), options)
    }

    /// What the processor makes of the arguments.
    pub(crate) fn expected(&self, arguments: &[Arguments]) -> Vec<u32> {
        let of = |one| self.probes.iter().map(move |(_, twin)| twin(one));
        arguments.iter().flat_map(of).collect()
    }

    /// The first word that differs, for people.
    pub(crate) fn difference(
        &self,
        arguments: &[Arguments],
        got: &[u32],
        expected: &[u32],
    ) -> Option<String> {
        let at = got
            .iter()
            .zip(expected)
            .position(|(got, expected)| got != expected)?;
        let count = self.probes.len();
        Some(format!(
            "{} at {:x?}: got {:#010x}, expected {:#010x}",
            self.probes[at % count].0,
            arguments[at / count],
            got[at],
            expected[at]
        ))
    }
}
