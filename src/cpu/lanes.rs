//! Several of a kind side by side: loops over all of them are what the processor takes several turns of in
//! one instruction.

use glam::Vec3;

/// How many are taken together.
pub(crate) const LANES: usize = 16;

/// Something of each of them.
pub(crate) type Lanes<T> = [T; LANES];

/// Vectors by their components.
pub(crate) type VecLanes = [Lanes<f32>; 3];

/// What `of` tells of each lane.
#[inline(always)]
pub(crate) fn lanes<T: Copy + Default>(of: impl Fn(usize) -> T) -> Lanes<T> {
    let mut all = [T::default(); LANES];
    for (lane, own) in all.iter_mut().enumerate() {
        *own = of(lane);
    }
    all
}

/// The vector of a lane.
#[inline]
pub(crate) fn lane_of(lanes: &VecLanes, lane: usize) -> Vec3 {
    Vec3::new(lanes[0][lane], lanes[1][lane], lanes[2][lane])
}

/// Sets the vector of a lane.
#[inline]
pub(crate) fn set_lane(lanes: &mut VecLanes, lane: usize, v: Vec3) {
    [lanes[0][lane], lanes[1][lane], lanes[2][lane]] = v.to_array();
}
