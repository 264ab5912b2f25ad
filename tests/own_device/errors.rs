//! Whose errors are whose, and that errors can travel.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use motes::{Options, Simulation};

use super::{Caller, common, texture_for};

/// A mistake of the caller's own.
fn blunder(device: &wgpu::Device) {
    let _ = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("a blunder"),
        size: 4,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::MAP_WRITE,
        mapped_at_creation: false,
    });
}

#[test]
fn the_callers_errors_reach_the_caller_and_ours_do_not() {
    let scene = common::everything();
    for name in common::adapters() {
        let adapter = super::adapter_of(&name);
        let (device, queue) = super::opened(&adapter, |_| {});
        let heard = Arc::new(AtomicU32::new(0));
        let ear = heard.clone();
        device.on_uncaptured_error(Arc::new(move |_| {
            ear.fetch_add(1, Ordering::SeqCst);
        }));
        let ours = motes::gpu::GpuDevice::from_wgpu(&device, &queue).expect("it fits");
        let options = Options {
            adapter: motes::AdapterChoice::Device(ours),
            ..Options::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("it has room");
        simulation.seek(3).expect("it steps");

        blunder(&device);
        assert_eq!(heard.load(Ordering::SeqCst), 1, "the caller's handler");
        simulation.step().expect("the caller's mistake is not ours");

        let (other, _queue) = super::opened(&adapter, |_| {});
        let foreign = other.create_texture(&texture_for(&scene));
        super::failed(simulation.draw_into(&foreign));
        assert_eq!(heard.load(Ordering::SeqCst), 1, "our mistake is not theirs");

        // A scope of the caller's around all of it.
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        super::failed(simulation.draw_into(&foreign));
        assert!(pollster::block_on(scope.pop()).is_none());
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        simulation.step().expect("it steps");
        blunder(&device);
        simulation.draw().expect("it draws");
        assert!(pollster::block_on(scope.pop()).is_some());
        assert_eq!(heard.load(Ordering::SeqCst), 1);
        assert!(!simulation.particles().expect("it reads").is_empty());
    }
}

#[test]
fn a_simulation_can_move_to_another_thread() {
    let scene = common::everything();
    let mut caller = Caller::new(&common::adapters()[0], &scene, Options::default());
    caller.simulation.seek(2).expect("it steps");
    let mut simulation = caller.simulation;
    let there = std::thread::spawn(move || {
        simulation.seek(5).expect("it steps");
        simulation.state_digest().expect("it reads")
    });
    let mut here = super::on_processor(&scene);
    here.seek(5).expect("it steps");
    assert_eq!(
        there.join().expect("it does not panic"),
        here.state_digest().expect("it reads")
    );
}

fn is_error<T: std::error::Error + Send + Sync + 'static>() {}
fn is_send<T: Send + 'static>() {}
fn is_sync<T: Send + Sync + 'static>() {}

/// Holds when it compiles.
#[test]
fn all_errors_can_be_boxed_and_sent() {
    is_error::<motes::SimulationError>();
    is_error::<motes::backend::BackendError>();
    is_error::<motes::gpu::UnfitDevice>();
    is_error::<motes::gpu::TextureError>();
    is_error::<motes::gpu::shader::ShaderError>();
    is_error::<motes::plan::PlanError>();
    is_error::<motes::scene::SceneError>();
    is_error::<motes::recording::RecordingError>();
    is_error::<motes::recording::RefusedChange>();
    is_error::<motes::output::OutputError>();
    is_send::<Simulation>();
    is_sync::<Options>();
    is_sync::<motes::gpu::GpuDevice>();
    is_sync::<motes::plan::Plan>();
    is_sync::<motes::scene::Scene>();
}
