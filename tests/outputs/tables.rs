//! Dumps and statistics.

use std::fs;

use motes::output::{Measured, ParticleCounts, StatsRow, StatsWriter, dump_path, write_particles};
use motes::simulation::{FlockMetrics, ParticleState};

use crate::{names_in, set};

#[test]
fn ply_reads_back() {
    let dir = tempfile::tempdir().unwrap();
    // More than one buffer's worth.
    let records: Vec<_> = (0..10_000_u32)
        .map(|i| ParticleState {
            position: [i as f32, -0.5, f32::MIN_POSITIVE],
            velocity: [1.0 / (i + 1) as f32, 3e30, -0.0],
            age: i % 50,
            lifetime: 50,
            system: u32::MAX - i,
            id: i.wrapping_mul(0x9E37_79B9),
        })
        .collect();
    let path = dump_path(dir.path(), "particles", 7);
    assert_eq!(path, dir.path().join("particles-0007.ply"));
    assert!(dump_path(dir.path(), "a", 12345).ends_with("a-12345.ply"));
    write_particles(&path, &records).unwrap();

    let bytes = fs::read(&path).unwrap();
    let end = b"end_header\n";
    let header_len = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = std::str::from_utf8(&bytes[..header_len]).unwrap();
    let lines: Vec<_> = header
        .lines()
        .filter(|line| !line.starts_with("comment"))
        .collect();
    assert_eq!(
        lines[..3],
        [
            "ply",
            "format binary_little_endian 1.0",
            "element vertex 10000"
        ]
    );
    let names = "float x,float y,float z,float vx,float vy,float vz,\
                 uint age,uint lifetime,uint system,uint id";
    let properties: Vec<_> = names.split(',').map(|p| format!("property {p}")).collect();
    assert_eq!(lines[3..lines.len() - 1], properties);
    let (words, rest) = bytes[header_len..].as_chunks::<4>();
    assert!(rest.is_empty());
    assert_eq!(words.len(), 10 * records.len());
    for (vertex, record) in words.chunks(10).zip(&records) {
        let float = |i: usize| f32::from_le_bytes(vertex[i]).to_bits();
        let uint = |i: usize| u32::from_le_bytes(vertex[i]);
        assert_eq!([0, 1, 2].map(float), record.position.map(f32::to_bits));
        assert_eq!([3, 4, 5].map(float), record.velocity.map(f32::to_bits));
        let ParticleState {
            age,
            lifetime,
            system,
            id,
            ..
        } = *record;
        assert_eq!([6, 7, 8, 9].map(uint), [age, lifetime, system, id]);
    }
    write_particles(&path, &[]).unwrap();
    let empty = fs::read_to_string(&path).unwrap();
    assert!(empty.contains("element vertex 0\n") && empty.ends_with("end_header\n"));
}

#[test]
fn stats_are_lines_of_the_contract() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("stats/run.csv");
    let mut stats = StatsWriter::create(&path).unwrap();
    let counts = ParticleCounts {
        requested: 12,
        born: 10,
        died: 6,
        live: 5_000_000_000,
        dropped: 2,
        died_of_intensity: 1,
        died_of_bounds: 2,
    };
    let metrics = FlockMetrics {
        count: 7,
        polarisation: 0.25,
        mean_speed: 1.5,
        median_nearest_distance: Some(0.1),
        mean_neighbours: 6.0,
    };
    let alone = FlockMetrics {
        count: 1,
        polarisation: 1.0,
        mean_speed: 0.0,
        median_nearest_distance: None,
        mean_neighbours: 0.0,
    };
    for (frame, population, measured, digest) in [
        (0, "particles", Measured::Particles(counts), None),
        (1, "a, \"b\"", Measured::Particles(counts), Some(u64::MAX)),
        (1, "image", Measured::Image, Some(0xABC)),
        (2, "image", Measured::Image, None),
        (2, "starlings", Measured::Flock { born: 7, metrics }, None),
        (
            2,
            "one",
            Measured::Flock {
                born: 0,
                metrics: alone,
            },
            None,
        ),
    ] {
        stats
            .row(&StatsRow {
                frame,
                population,
                measured,
                digest,
            })
            .unwrap();
    }
    assert!(!path.exists());
    stats.finish().unwrap();
    assert_eq!(
        fs::read_to_string(&path).unwrap(),
        "frame,population,kind,requested,born,died,live,dropped,digest,\
         died_of_age,died_of_intensity,died_of_bounds,\
         polarisation,mean_speed,median_nearest_distance,mean_neighbours\n\
         0,particles,particles,12,10,6,5000000000,2,,3,1,2,,,,\n\
         1,\"a, \"\"b\"\"\",particles,12,10,6,5000000000,2,ffffffffffffffff,3,1,2,,,,\n\
         1,image,image,,,,,,0000000000000abc,,,,,,,\n\
         2,image,image,,,,,,,,,,,,,\n\
         2,starlings,flock,7,7,0,7,0,,,,,0.25,1.5,0.1,6\n\
         2,one,flock,0,0,0,1,0,,,,,1,0,,0\n"
    );
    assert_eq!(names_in(path.parent().unwrap()), set(&["run.csv"]));
}
