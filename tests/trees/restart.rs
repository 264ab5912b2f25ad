//! Runs that are entered in the middle (Reeves 1983, section 3; RA12).

use motes::plan::Population;
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::common;
use crate::support::{family, simulation};

#[test]
fn ra12_systems_are_born_again_where_a_run_is_entered() {
    let scene = family("", "");
    let mut whole = simulation(&scene);
    whole.seek_from(0, 55).expect("it steps");
    let digests = |simulation: &mut Simulation| {
        let of = |population| {
            simulation
                .population_digest(population)
                .expect("it digests")
        };
        [Population::Particles, Population::Systems].map(of)
    };
    let expected = digests(&mut whole);
    let mut entered = simulation(&scene);
    entered.seek(55).expect("it steps");
    let steps = entered.take_statistics().expect("they can be read").len();
    // The longest lifetime of a particle is 12 frames.
    assert_eq!(steps, 13);
    assert_eq!(digests(&mut entered), expected);
    // And on a device.
    common::on_each_adapter(|name, _| {
        let options = Options {
            adapter: AdapterChoice::Named(name.to_owned()),
            ..Options::default()
        };
        let mut device = Simulation::new(&scene, &options).expect("it can be planned");
        device.seek(55).expect("it steps");
        assert_eq!(digests(&mut device), expected, "{name}");
    });
}

#[test]
fn ra12_a_snapshot_stands_for_the_systems_before_it() {
    let scene = family("", "");
    let mut whole = simulation(&scene);
    whole.seek_from(0, 30).expect("it steps");
    let snapshot = whole
        .snapshot()
        .expect("it can be read")
        .expect("it has begun");
    whole.seek(50).expect("it steps");
    let expected = whole.state_digest().expect("it digests");
    let mut later = simulation(&scene);
    later.restore(&snapshot).expect("it is of this run");
    later.seek(50).expect("it steps");
    assert_eq!(later.state_digest().expect("it digests"), expected);
    // Also over a run that has gone elsewhere.
    whole.restore(&snapshot).expect("it is of this run");
    whole.seek(50).expect("it steps");
    assert_eq!(whole.state_digest().expect("it digests"), expected);
}
