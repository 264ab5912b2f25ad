//! The families of records that a run is made of.

use super::Plan;
use crate::scene::Scene;

/// Those whose state a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Population {
    /// Systems that others bear.
    Systems,
    /// Those of all particle systems.
    Particles,
    /// Those of all flocks.
    Boids,
    /// Those of all fires.
    Flames,
    /// Control points of fires that spread.
    Points,
}

impl Population {
    /// Each of them.
    pub const ALL: [Self; 5] = [
        Self::Particles,
        Self::Systems,
        Self::Boids,
        Self::Flames,
        Self::Points,
    ];

    /// Its name in tables and of its dumps; also that of its state buffer, but for systems, whose is
    /// `nodes`, and points, whose is `control_points`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Systems => "systems",
            Self::Particles => "particles",
            Self::Boids => "boids",
            Self::Flames => "flames",
            Self::Points => "points",
        }
    }

    /// The populations of the scene that are dumped: those that it has anybody of, but for systems, whose records no
    /// file has.
    pub(crate) fn dumped_of(scene: &Scene) -> Vec<Self> {
        let has = |population: &Self| match population {
            Self::Systems => false,
            Self::Particles => !scene.systems.is_empty(),
            Self::Boids => !scene.flocks.is_empty(),
            Self::Flames => !scene.fires.is_empty(),
            Self::Points => scene.fires.iter().any(|fire| fire.spread.is_some()),
        };
        Self::ALL.into_iter().filter(has).collect()
    }

    /// Index of its first record in digests: equal records of two populations count differently.
    pub(crate) fn first_index(self) -> u32 {
        match self {
            Self::Systems => 3 << 30,
            Self::Particles => 0,
            Self::Boids => 1 << 31,
            Self::Flames => 5 << 29,
            Self::Points => 7 << 29,
        }
    }
}

impl Plan {
    /// Whether the scene has anybody of that population.
    pub fn has_population(&self, population: Population) -> bool {
        match population {
            Population::Systems => self.tree_levels > 0,
            Population::Particles => self.own_system_count > 0,
            Population::Boids => self.flock_count > 0,
            Population::Flames => self.fire_count > 0,
            Population::Points => self.spread_count > 0,
        }
    }

    /// The populations that the scene has anybody of.
    pub fn populations(&self) -> impl Iterator<Item = Population> + '_ {
        let all = Population::ALL.into_iter();
        all.filter(|population| self.has_population(*population))
    }
}
