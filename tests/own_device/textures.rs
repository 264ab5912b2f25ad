//! The picture in a texture of the caller's.

use motes::gpu::TextureError;
use motes::{Options, SimulationError};

use super::{Caller, common, on_processor, texture_for};

#[test]
fn a_texture_gets_the_bytes_of_the_image_whatever_its_width() {
    for (width, height) in [(64, 48), (100, 33), (1, 40), (161, 7), (192, 1), (3, 3)] {
        let mut scene = common::everything();
        (scene.image.width, scene.image.height) = (width, height);
        let mut processor = on_processor(&scene);
        processor.seek(7).expect("it steps");
        processor.draw().expect("it draws");
        let expected = processor.image().expect("it reads");
        for name in common::adapters() {
            let mut caller = Caller::new(&name, &scene, Options::default());
            caller.simulation.seek(7).expect("it steps");
            for format in [
                wgpu::TextureFormat::Rgba8Unorm,
                wgpu::TextureFormat::Rgba8UnormSrgb,
            ] {
                let texture = caller.texture(&scene, |texture| texture.format = format);
                caller.simulation.draw_into(&texture).expect("it fits");
                let got = caller.pixels_of(&texture);
                assert!(got == expected, "{name}, {width} x {height}, {format:?}");
                assert_eq!(caller.simulation.image().expect("it reads"), got);
            }
        }
    }
}

#[test]
fn a_layer_can_be_copied_too_and_a_texture_follows_the_steps() {
    let scene = common::everything();
    let mut caller = Caller::new(&common::adapters()[0], &scene, Options::default());
    let texture = caller.texture(&scene, |_| {});
    let mut seen = Vec::new();
    for frame in [3, 8] {
        caller.simulation.seek(frame).expect("it steps");
        caller.simulation.draw_into(&texture).expect("it fits");
        seen.push(caller.pixels_of(&texture));
    }
    assert!(seen[0] != seen[1], "two frames");
    // On black.
    caller.simulation.draw_layer(0).expect("it draws");
    caller.simulation.image_into(&texture).expect("it fits");
    let layer = caller.pixels_of(&texture);
    assert!(layer != seen[1]);
    assert_eq!(layer, caller.simulation.image().expect("it reads"));
}

#[test]
fn a_texture_that_cannot_take_the_picture_is_refused_before_anything_is_drawn() {
    let scene = common::everything();
    let (width, height) = (scene.image.width, scene.image.height);
    let mut caller = Caller::new(&common::adapters()[0], &scene, Options::default());
    caller.simulation.seek(4).expect("it steps");
    let before = caller.simulation.image().expect("it reads");
    let copied = wgpu::TextureUsages::COPY_DST;
    let bound = wgpu::TextureUsages::TEXTURE_BINDING;
    let error = |caller: &mut Caller, change: fn(&mut wgpu::TextureDescriptor)| {
        let texture = caller.texture(&scene, change);
        match caller.simulation.draw_into(&texture) {
            Err(SimulationError::Texture(error)) => error,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(
        error(&mut caller, |texture| texture.size.width += 1),
        TextureError::Size {
            needed: [width, height, 1],
            got: [width + 1, height, 1],
        }
    );
    assert_eq!(
        error(&mut caller, |texture| texture.size.depth_or_array_layers =
            2),
        TextureError::Size {
            needed: [width, height, 1],
            got: [width, height, 2],
        }
    );
    assert_eq!(
        error(&mut caller, |texture| {
            texture.dimension = wgpu::TextureDimension::D3;
        }),
        TextureError::Kind {
            dimension: wgpu::TextureDimension::D3,
            samples: 1,
        }
    );
    assert_eq!(
        error(&mut caller, |texture| {
            texture.sample_count = 4;
            texture.usage |= wgpu::TextureUsages::RENDER_ATTACHMENT;
        }),
        TextureError::Kind {
            dimension: wgpu::TextureDimension::D2,
            samples: 4,
        }
    );
    assert_eq!(
        error(&mut caller, |texture| {
            texture.format = wgpu::TextureFormat::Bgra8Unorm;
        }),
        TextureError::Format(wgpu::TextureFormat::Bgra8Unorm)
    );
    let usage = error(&mut caller, |texture| {
        texture.usage = wgpu::TextureUsages::TEXTURE_BINDING;
    });
    assert_eq!(usage, TextureError::Usage(bound));
    assert!(usage.to_string().contains("COPY_DST") && !bound.contains(copied));
    let after = caller.simulation.image().expect("it reads");
    assert!(before == after, "nothing was drawn");

    let texture = caller.texture(&scene, |_| {});
    let refused = on_processor(&scene).draw_into(&texture);
    assert_eq!(
        refused,
        Err(SimulationError::Texture(TextureError::Processor))
    );
}

#[test]
fn a_texture_of_another_device_is_an_error_and_not_the_end_of_the_run() {
    let scene = common::everything();
    let mut caller = Caller::new(&common::adapters()[0], &scene, Options::default());
    caller.simulation.seek(4).expect("it steps");
    let (other, _queue) = super::opened(&caller.adapter, |_| {});
    let foreign = other.create_texture(&texture_for(&scene));
    let error = super::failed(caller.simulation.draw_into(&foreign));
    assert!(
        matches!(error, motes::backend::BackendError::Internal(_)),
        "{error}"
    );
    let texture = caller.texture(&scene, |_| {});
    caller.simulation.step().expect("it goes on");
    caller.simulation.draw_into(&texture).expect("it fits");
    let got = caller.pixels_of(&texture);
    assert_eq!(got, caller.simulation.image().expect("it reads"));
}
