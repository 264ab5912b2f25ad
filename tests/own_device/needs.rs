//! What a caller's device must have.

use motes::gpu::{GpuDevice, UnfitDevice};
use motes::{AdapterChoice, Options, Simulation};

use super::{Caller, adapter_of, common, on_processor, opened};

#[test]
fn a_device_opened_as_asked_for_makes_the_processors_bits() {
    let scene = common::everything();
    let mut expected = on_processor(&scene);
    expected.seek(9).expect("it steps");
    expected.draw().expect("it draws");
    let expected = (
        expected.state_digest().expect("it reads"),
        expected.image().expect("it reads"),
    );
    for name in common::adapters() {
        let mut caller = Caller::new(&name, &scene, Options::default());
        let simulation = &mut caller.simulation;
        assert!(simulation.is_exact());
        simulation.seek(9).expect("it steps");
        simulation.draw().expect("it draws");
        let got = (
            simulation.state_digest().expect("it reads"),
            simulation.image().expect("it reads"),
        );
        assert!(got == expected, "{name}");
    }
}

#[test]
fn a_device_without_raw_shaders_runs_and_does_not_call_itself_exact() {
    let adapter = adapter_of(&common::adapters()[0]);
    let (device, queue) = opened(&adapter, |descriptor| {
        descriptor.required_features = wgpu::Features::IMMEDIATES;
    });
    let ours = GpuDevice::from_wgpu(&device, &queue).expect("plain WGSL will do");
    assert!(!ours.is_exact() && !ours.description.exact);
    let options = Options {
        adapter: AdapterChoice::Device(ours),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&common::everything(), &options).expect("it has room");
    assert!(!simulation.is_exact());
    simulation.seek(3).expect("it steps");
    assert!(!simulation.particles().expect("it reads").is_empty());
}

#[test]
fn a_device_without_immediates_is_refused() {
    let adapter = adapter_of(&common::adapters()[0]);
    let (device, queue) = opened(&adapter, |descriptor| {
        descriptor.required_features = wgpu::Features::PASSTHROUGH_SHADERS;
        descriptor.required_limits.max_immediate_size = 0;
    });
    assert_eq!(
        GpuDevice::from_wgpu(&device, &queue),
        Err(UnfitDevice::Features(wgpu::Features::IMMEDIATES))
    );
}

/// A limit, and how to set it.
type Limit = (&'static str, fn(&mut wgpu::Limits) -> &mut u32);

#[test]
fn each_limit_that_is_too_low_is_refused_by_name() {
    let limits: [Limit; 7] = [
        ("max_bind_groups", |of| &mut of.max_bind_groups),
        ("max_storage_buffers_per_shader_stage", |of| {
            &mut of.max_storage_buffers_per_shader_stage
        }),
        ("max_uniform_buffers_per_shader_stage", |of| {
            &mut of.max_uniform_buffers_per_shader_stage
        }),
        ("max_compute_invocations_per_workgroup", |of| {
            &mut of.max_compute_invocations_per_workgroup
        }),
        ("max_compute_workgroup_size_x", |of| {
            &mut of.max_compute_workgroup_size_x
        }),
        ("max_compute_workgroups_per_dimension", |of| {
            &mut of.max_compute_workgroups_per_dimension
        }),
        ("max_immediate_size", |of| &mut of.max_immediate_size),
    ];
    let adapter = adapter_of(&common::adapters()[0]);
    for (name, limit) in limits {
        let needed = refused_limit(&adapter, name, |limits| *limit(limits) = 0);
        // What is named as needed is enough.
        let (device, queue) = opened(&adapter, |descriptor| {
            *limit(&mut descriptor.required_limits) = needed.try_into().expect("it is small");
        });
        let enough = GpuDevice::from_wgpu(&device, &queue);
        assert!(enough.is_ok(), "{name}: {enough:?}");
        // And less is not.
        refused_limit(&adapter, name, |limits| *limit(limits) = needed as u32 - 1);
    }
    refused_limit(&adapter, "max_storage_buffer_binding_size", |limits| {
        limits.max_storage_buffer_binding_size = 4096;
    });
    refused_limit(&adapter, "max_uniform_buffer_binding_size", |limits| {
        limits.max_uniform_buffer_binding_size = 16;
    });
}

/// What is needed of a limit, by the error that names it.
fn refused_limit(
    adapter: &wgpu::Adapter,
    expected: &str,
    change: impl FnOnce(&mut wgpu::Limits),
) -> u64 {
    let (device, queue) = opened(adapter, |descriptor| {
        change(&mut descriptor.required_limits);
    });
    match GpuDevice::from_wgpu(&device, &queue) {
        Err(UnfitDevice::Limit { name, needed, got }) => {
            assert_eq!(name, expected);
            assert!(got < needed, "{name}: {got}, {needed}");
            needed
        }
        other => panic!("{expected}: {other:?}"),
    }
}

#[test]
fn a_lost_device_is_refused() {
    let adapter = adapter_of(&common::adapters()[0]);
    let (device, queue) = opened(&adapter, |_| {});
    assert!(GpuDevice::from_wgpu(&device, &queue).is_ok());
    device.destroy();
    assert_eq!(
        GpuDevice::from_wgpu(&device, &queue),
        Err(UnfitDevice::Lost)
    );
}

#[test]
fn a_scene_too_large_for_the_devices_buffers_is_refused_by_the_buffers_name() {
    let adapter = adapter_of(&common::adapters()[0]);
    let (device, queue) = opened(&adapter, |descriptor| {
        descriptor.required_limits.max_storage_buffer_binding_size = 1 << 20;
    });
    let ours = GpuDevice::from_wgpu(&device, &queue).expect("it fits small scenes");
    let mut scene = common::everything();
    (scene.image.width, scene.image.height) = (640, 480);
    let options = Options {
        adapter: AdapterChoice::Device(ours),
        ..Options::default()
    };
    let error = super::failed(Simulation::new(&scene, &options)).to_string();
    assert!(
        error.contains("`light_low` takes 3686400 bytes") && error.contains("1048576"),
        "{error}"
    );
}
