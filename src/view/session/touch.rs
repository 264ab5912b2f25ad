//! Clicks into the picture: what can burn burns there, flocks steer there.

use super::{Session, Told};
use crate::scene::{Corners, Dimensions, Flock, Goal, Ignition, UNSET};
use crate::simulation::{Pick, Ray};

/// How much boids accelerate, as a share of their greatest speed, to where somebody calls them.
const CALLED_LIMIT: f32 = 0.05;

impl Session {
    /// What a click at a place of the picture would do, in words; `None` where it does nothing.
    pub fn touch_hint(&self) -> Option<&'static str> {
        let burns = self.scene.fires.iter().any(|fire| fire.spread.is_some());
        match (burns, self.scene.flocks.is_empty()) {
            (true, _) => Some("click: it burns there; drag: look around"),
            (false, false) => {
                Some("click: boids steer there, right button: away from there; drag: look around")
            }
            (false, true) => None,
        }
    }

    /// A click at a place of the picture drawn last, pixels from its upper left corner: from the next frame
    /// on, what can burn burns there, or flocks steer there; or `away` from there. What was done, in
    /// words; `None` where there is nothing to do.
    ///
    /// # Errors
    /// The scene has no room for it.
    pub fn touch(&mut self, at_px: [f32; 2], away: bool) -> Result<Option<String>, Told> {
        if self.scene.fires.iter().any(|fire| fire.spread.is_some()) {
            return match self.simulation.pick(at_px) {
                Some(pick) if !away => self.ignite(&pick).map(Some),
                _ => Ok(None),
            };
        }
        let Some(ray) = self.simulation.ray_through(at_px) else {
            return Ok(None);
        };
        let (mut done, mut all, mut before) = (None, Vec::new(), Vec::new());
        for flock in &self.scene.flocks {
            let Some(place) = place_for(flock, &ray) else {
                continue;
            };
            let weight = if away { -1.0 } else { 1.0 };
            let path = format!("flock.{}.goal", flock.name);
            let [known, new] = goals(flock, place, weight);
            all.push((path.clone(), new));
            before.push((path, known));
            let [x, y, z] = place;
            let way = if away { "away from" } else { "to" };
            done = Some(format!("boids steer {way} {x:.2}, {y:.2}, {z:.2}"));
        }
        self.change_all(&all)?;
        if !before.is_empty() {
            self.note(before);
        }
        Ok(done)
    }

    fn ignite(&mut self, pick: &Pick) -> Result<String, Told> {
        let fire = &self.scene.fires[pick.fire];
        let known = fire.spread.as_ref().map_or(&[][..], |it| &it.ignitions);
        let new = Ignition {
            position: pick.position,
            first_frame: self.next_frame(),
            points: known.first().map_or(16, |first| first.points),
        };
        let text = |one: &Ignition| {
            format!(
                "{{ position = {:?}, first_frame = {}, points = {} }}",
                one.position, one.first_frame, one.points
            )
        };
        let all: Vec<String> = known.iter().chain([&new]).map(text).collect();
        let path = format!("fire.{}.spread.ignition", fire.name);
        let [x, y, z] = pick.position;
        let done = format!("`fire.{}` burns at {x:.3}, {y:.3}, {z:.3}", fire.name);
        let listed = |all: &[String]| format!("[{}]", all.join(", "));
        let before = listed(&all[..all.len() - 1]);
        self.change(&path, &listed(&all))?;
        self.note(vec![(path, before)]);
        Ok(done)
    }
}

/// The goal that a flock has, and one at a place, in TOML.
fn goals(flock: &Flock, position: [f32; 3], weight: f32) -> [String; 2] {
    let called = Goal {
        position,
        weight,
        speed: 2.0 * flock.max_speed,
        limit: CALLED_LIMIT * flock.max_speed,
        slowing_radius: 0.0,
    };
    let now = flock.goal.map_or(called, |known| Goal {
        position,
        weight,
        ..known
    });
    let text = |goal: Goal| {
        format!(
            "{{ position = {:?}, weight = {:?}, speed = {:?}, limit = {:?}, slowing_radius = {:?} }}",
            goal.position, goal.weight, goal.speed, goal.limit, goal.slowing_radius
        )
    };
    [flock.goal.map_or(UNSET.to_owned(), text), text(now)]
}

/// Where a ray meets the plane that a flock lives in; for one in space, that of the middle of where it
/// begins, as the ray's viewer has it before them.
fn place_for(flock: &Flock, ray: &Ray) -> Option<[f32; 3]> {
    match flock.dimensions {
        Dimensions::Two => {
            let [x, y, _] = ray.meets_plane([0.0; 3], [0.0, 0.0, 1.0])?;
            Some([x, y, 0.0])
        }
        Dimensions::Three => {
            let Corners { min, max } = flock.region;
            let middle = [0, 1, 2].map(|axis| 0.5 * (min[axis] + max[axis]));
            ray.meets_plane(middle, ray.direction)
        }
    }
}
