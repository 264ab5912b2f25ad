//! Every function of the shared libraries on every adapter against its twin in Rust, bit for bit,
//! on awkward and random arguments.
mod common;

use common::*;
use motes::gpu::KernelForm;
use motes::gpu::shader::CompileOptions;

/// Sets of arguments, of which the first 38,416 are all pairs of awkward floats.
const COUNT: u32 = 120_000;

#[test]
fn exact_libraries_are_the_same_on_every_adapter() {
    let arguments = arguments(COUNT);
    let input = words_of(&arguments);
    on_each_adapter(|name, device| {
        for probe in PROBES {
            let kernel = match probe.compile(&CompileOptions::default()) {
                Ok(kernel) => kernel,
                Err(e) => panic!("{e}\n{}", probe.text()),
            };
            let words = probe.probes.len() * arguments.len();
            let got = device
                .run_kernel(&kernel, KernelForm::Spirv, &[&input], words, COUNT)
                .expect("the device runs a probe");
            let expected = probe.expected(&arguments);
            if let Some(difference) = probe.difference(&arguments, &got, &expected) {
                panic!("{name}: {difference}");
            }
        }
    });
}
