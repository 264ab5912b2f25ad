//! What is left when the device is lost, or never had the room.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use motes::backend::BackendError;
use motes::{AdapterChoice, Options, Simulation, SimulationError};

use super::{Caller, common, failed};

/// Something to ask of a simulation.
type Call = fn(&mut Simulation, &wgpu::Texture) -> Result<(), SimulationError>;

const CALLS: [(&str, Call); 9] = [
    ("step", |on, _| on.step()),
    ("seek", |on, _| on.seek(12)),
    ("draw", |on, _| on.draw()),
    ("image", |on, _| on.image().map(drop)),
    ("particles", |on, _| on.particles().map(drop)),
    ("statistics", |on, _| on.take_statistics().map(drop)),
    ("state digest", |on, _| on.state_digest().map(drop)),
    ("image digest", |on, _| on.image_digest().map(drop)),
    ("draw into", |on, texture| on.draw_into(texture)),
];

#[test]
fn a_simulation_on_a_destroyed_device_says_that_it_is_lost_whatever_it_is_asked() {
    let scene = common::everything();
    // Each may be the first to notice, as far as they have ways of their own of it.
    let first = |at: usize, what: &str| {
        at == 0 && ["draw", "image", "statistics", "draw into"].contains(&what) || what == "step"
    };
    for (at, name) in common::adapters().into_iter().enumerate() {
        for (what, call) in CALLS.into_iter().filter(|(what, _)| first(at, what)) {
            let mut caller = Caller::new(&name, &scene, Options::default());
            let texture = caller.texture(&scene, |_| {});
            let told = Arc::new(AtomicBool::new(false));
            let ear = told.clone();
            caller
                .device
                .set_device_lost_callback(move |_, _| ear.store(true, Ordering::SeqCst));
            // Some of it is still under way.
            caller.simulation.seek(5).expect("it steps");
            caller.simulation.draw().expect("it draws");
            caller.device.destroy();
            let error = failed(call(&mut caller.simulation, &texture));
            assert!(
                matches!(error, BackendError::DeviceLost(_)),
                "{name}, {what}: {error}"
            );
            // And again, whatever else it is asked.
            for (again, call) in CALLS {
                let error = failed(call(&mut caller.simulation, &texture));
                assert!(
                    matches!(error, BackendError::DeviceLost(_)),
                    "{name}, {what}, then {again}: {error}"
                );
            }
            drop(caller.simulation);
            caller
                .device
                .poll(wgpu::PollType::wait_indefinitely())
                .expect("there is nothing left to wait for");
            assert!(told.load(Ordering::SeqCst), "the callback is the caller's");
        }
    }
}

#[test]
fn a_simulation_cannot_begin_on_a_device_that_was_lost_meanwhile() {
    let scene = common::everything();
    let adapter = super::adapter_of(&common::adapters()[0]);
    let (device, queue) = super::opened(&adapter, |_| {});
    let ours = motes::gpu::GpuDevice::from_wgpu(&device, &queue).expect("it fits");
    device.destroy();
    let options = Options {
        adapter: AdapterChoice::Device(ours),
        ..Options::default()
    };
    let error = failed(Simulation::new(&scene, &options));
    assert!(matches!(error, BackendError::DeviceLost(_)), "{error}");
}

#[test]
fn a_device_of_our_own_can_be_lost_too() {
    let scene = common::everything();
    let ours = common::open_anew(&common::adapters()[0]);
    let device = ours.device().clone();
    let options = Options {
        adapter: AdapterChoice::Device(ours),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("it has room");
    simulation.seek(3).expect("it steps");
    device.destroy();
    let error = failed(simulation.step());
    assert!(matches!(error, BackendError::DeviceLost(_)), "{error}");
}

/// Memory that the system can give, bytes.
fn available_bytes() -> u64 {
    static AVAILABLE: OnceLock<u64> = OnceLock::new();
    *AVAILABLE.get_or_init(|| {
        let text = std::fs::read_to_string("/proc/meminfo").unwrap_or_default();
        let line = text.lines().find(|line| line.starts_with("MemAvailable:"));
        let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok());
        kib.map_or(0, |kib| kib << 10)
    })
}

#[test]
fn a_billion_particles_are_refused_before_memory_is_taken() {
    let billion: u32 = 1_000_000_000;
    // Two pools of 32 bytes a particle. A larger machine has the room.
    if available_bytes() > 64 * u64::from(billion) {
        return;
    }
    let mut scene = common::everything();
    scene.capacity = Some(billion);
    for name in common::adapters() {
        let options = Options {
            adapter: AdapterChoice::parse(&name),
            ..Options::default()
        };
        let error = failed(Simulation::new(&scene, &options));
        assert!(
            matches!(
                error,
                BackendError::OutOfMemory(_) | BackendError::Unsupported(_)
            ),
            "{name}: {error}"
        );
    }
}

#[test]
fn births_beyond_memory_end_a_run_on_the_processor_with_an_error() {
    let billion: u32 = 1_000_000_000;
    if available_bytes() > 32 * u64::from(billion) {
        return;
    }
    // All of them in frame 0.
    let text = "capacity = 1000000000
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = \"crowd\"
initial_mean_parts = 16000000
generation_shape = { kind = \"sphere\", radius = 1 }
speed = 0
lifetime = 3
color = [1, 1, 1]
size = 0.01";
    let mut scene = motes::scene::parse(text, "crowd.toml", "crowd").expect("a scene");
    let crowd = scene.systems[0].clone();
    scene.systems.extend((1..64).map(|at| motes::scene::System {
        name: format!("crowd-{at}"),
        ..crowd.clone()
    }));
    let mut simulation = super::on_processor(&scene);
    let error = failed(simulation.step());
    assert!(matches!(error, BackendError::OutOfMemory(_)), "{error}");
}
