//! Kernels alone.

use motes::backend::Backend;
use motes::bench::{Clock, Measure, Target, micro};
use motes::gpu::{GpuOptions, SortYardstick, Yardstick, YardstickMemory, dispatch::dispatch_for};
use motes::plan::Plan;

use crate::{common, counted, targets};

fn of<'a>(measures: &'a [Measure], name: &str) -> &'a Measure {
    let found = measures.iter().find(|measure| measure.name == name);
    found.unwrap_or_else(|| panic!("no `{name}`"))
}

#[test]
fn kernels_alone_have_the_work_that_they_say() {
    for target in targets() {
        let measures = micro(&target, 3000, &counted(2), &mut |_| true).expect("it is measured");
        let names: Vec<_> = measures
            .iter()
            .map(|measure| measure.name.as_str())
            .collect();
        assert_eq!(names[0], "copy_kernel", "{names:?}");
        for (name, items, bytes) in [
            ("copy_kernel", 3000, 3000 * 64),
            ("copy_buffer", 3000, 3000 * 64),
            ("read_only", 3000, 3000 * 32),
            ("write_only", 3000, 3000 * 32),
            ("atomic_add_spread", 3000, 3000 * 8),
            ("atomic_add_contended", 3000, 0),
        ] {
            let measure = of(&measures, name);
            assert_eq!((measure.items, measure.bytes), (items, bytes), "{name}");
        }
        assert_eq!(of(&measures, "noise_simplex").items, 3000);
        // Fewer of those that cover more.
        let splats = ["points", "discs_small", "streaks", "discs_large"];
        let counts = splats.map(|name| of(&measures, &format!("splat_{name}")).items);
        assert_eq!(counts, [3000, 3000, 750, 46]);
        // Whole flames of 25, one at least.
        let sizes = ["8", "32", "128"];
        let fans = sizes.map(|size| of(&measures, &format!("flames_{size}_px")).items);
        assert_eq!(fans, [175, 25, 25]);
        let pixels = of(&measures, "splat_discs_large")
            .note
            .as_deref()
            .unwrap_or_default();
        assert!(pixels.contains("490.6 pixels each") && pixels.contains("ns a covered pixel"));
        if let Target::Gpu(_) = target {
            assert_eq!(of(&measures, "scan").items, 3000);
            // Keys are read twice, pairs read and written once, in each of four passes; six runs of
            // 512 pairs have 256 counts each.
            let counts = 4 * 6 * 256;
            let sort = of(&measures, "sort");
            let bytes = 4 * 3000 * 20 + 4 * (counts * 4) + 4 * 256 * 4 * 4;
            assert_eq!((sort.items, sort.bytes), (3000, bytes));
            let fastest = measures
                .iter()
                .filter(|measure| measure.name.starts_with("form_"))
                .map(|measure| measure.ms.median)
                .fold(f64::INFINITY, f64::min);
            assert_eq!(of(&measures, "copy_kernel").ms.median, fastest);
            for name in ["raster_points_half", "raster_quads_half"] {
                assert_eq!(of(&measures, name).items, 3000, "{name}");
            }
            for (size, fans) in sizes.into_iter().zip(fans) {
                let raster = of(&measures, &format!("raster_fans_{size}_px_half"));
                assert_eq!(raster.items, fans, "as many fans, of {size} px");
            }
        } else {
            assert!(
                measures
                    .iter()
                    .all(|measure| measure.ms.clock == Clock::Wall)
            );
        }
        for measure in &measures {
            let Measure { name, ms, .. } = measure;
            assert_eq!(ms.samples.len(), 2, "{name}");
            assert!(ms.median > 0.0 && ms.median.is_finite(), "{name}: {ms:?}");
        }
    }
}

#[test]
fn r88_what_streaks_cost_is_told_beside_the_rasteriser() {
    let measures = micro(&Target::Cpu, 500, &counted(1), &mut |_| true).expect("it is measured");
    let streaks = of(&measures, "splat_streaks")
        .note
        .as_deref()
        .unwrap_or_default();
    assert!(
        streaks.contains("12 px long") && streaks.contains("27.9 pixels each"),
        "{streaks}"
    );
}

/// A kernel, with its invocations for so many records.
type Form = (&'static str, fn(u32) -> u32);

/// The sizes at which pages, runs and rows of workgroups begin and end.
#[test]
fn yardsticks_do_their_work_at_every_size() {
    let forms: [Form; 5] = [
        ("bench/copy", |records| records),
        ("bench/copy_vec4", |records| 2 * records),
        ("bench/copy_wide", |records| records),
        ("bench/copy_runs", |records| records.div_ceil(16)),
        ("bench/copy_strides", |records| records.div_ceil(4)),
    ];
    common::on_each_adapter(|name, device| {
        for (records, size) in [(1, 64), (17, 256), (64, 64), (2049, 64), (70_001, 256)] {
            let fits = |(kernel, _): &Form| device.is_wide() || *kernel != "bench/copy_wide";
            for (kernel, invocations) in forms.into_iter().filter(fits) {
                // A memory of its own: nothing that another form has written.
                let memory = YardstickMemory::new(device, records).expect("there is room");
                let before = memory.read_destination().expect("it is read");
                let made = Yardstick::kernel(&memory, "copy", kernel, size, invocations);
                made.expect("it compiles").run().expect("it runs");
                let [source, destination] = [memory.read_source(), memory.read_destination()]
                    .map(|read| read.expect("it is read"));
                assert_eq!(source.len(), records as usize * 8);
                assert!(source == destination, "{kernel} of {records} on {name}");
                assert!(before != destination, "nothing was to be done");
            }
        }
    });
    assert_eq!(dispatch_for(0, 64), (0, 0));
}

/// Against the standard library's; and again, for what is timed is to be the same each time.
#[test]
fn the_sort_alone_sorts() {
    common::on_each_adapter(|name, device| {
        for pairs in [1, 511, 513, 70_001] {
            let mut sort = SortYardstick::new(device, pairs, 64).expect("there is room");
            let words = sort.read_unsorted().expect("it is read");
            let mut expected: Vec<[u32; 2]> =
                words.chunks(2).map(|pair| [pair[0], pair[1]]).collect();
            assert_eq!(expected.len(), pairs as usize);
            expected.sort_by_key(|pair| pair[0]);
            for _ in 0..2 {
                sort.yardstick.run().expect("it runs");
                let sorted = sort.read_sorted().expect("it is read");
                let is_same = sorted.chunks(2).eq(expected.iter().map(|pair| &pair[..]));
                assert!(is_same, "{pairs} on {name}");
            }
        }
    });
}

/// More passes than a set of queries holds, between two calls that take their times.
#[test]
fn no_pass_goes_untimed_however_many_there_are() {
    let plan = Plan::new(&crate::small(), 400).expect("it is planned");
    let options = GpuOptions {
        timed: true,
        ..GpuOptions::default()
    };
    let device = common::open("llvmpipe");
    let mut backend = common::on_gpu(&device, &plan, &options);
    let frames = 300;
    for frame in 0..frames {
        backend.step(&plan.inputs(frame)).expect("it steps");
    }
    let times = backend.take_times().expect("they are there");
    assert_eq!(times.len(), frames as usize);
    let passes = times[0].len();
    assert!(passes * 2 * frames as usize > 4096, "{passes} are too few");
    for (frame, kernels) in times.iter().enumerate() {
        assert_eq!(kernels.len(), passes, "frame {frame}");
        let sane = |ms: f64| (0.0..60e3).contains(&ms);
        assert!(kernels.iter().all(|(_, ms)| sane(*ms)), "{kernels:?}");
        assert!(kernels.iter().any(|(_, ms)| *ms > 0.0), "frame {frame}");
    }
    backend.step(&plan.inputs(frames)).expect("it steps");
    let again = backend.take_times().expect("they are there");
    assert_eq!((again.len(), again[0].len()), (1, passes));
}

#[test]
fn records_are_cut_into_pages_that_a_binding_holds() {
    common::on_each_adapter(|name, device| {
        // One more than lavapipe's 128 MiB hold.
        let records = 4_194_304 + 1;
        let memory = YardstickMemory::new(device, records).expect("there is room");
        let mut copy = Yardstick::copy_buffer(&memory).expect("it is made");
        copy.run().expect("it runs");
        let [source, destination] = [memory.read_source(), memory.read_destination()];
        let (source, destination) = (source.expect("read"), destination.expect("read"));
        assert_eq!(source.len(), records as usize * 8, "{name}");
        assert!(source == destination, "{name}");
        let tail = &source[source.len() - 8..];
        assert!(tail.iter().any(|word| *word != source[0]), "{name}");
    });
}
