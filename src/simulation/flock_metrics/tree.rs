//! A k-d tree over places, for questions about neighbours that stay quick however crowded they are.

use glam::DVec3;

/// Places in a leaf, at most.
const LEAF: usize = 8;

/// Places, sorted so that each node is a slice, halves of it its children. Nodes are in preorder;
/// all leaves are equally deep.
pub(super) struct Tree {
    places: Vec<[f32; 3]>,
    nodes: Vec<Extent>,
    /// Halvings above a leaf.
    depth: u32,
}

/// The least box around some places.
#[derive(Clone, Copy)]
struct Extent {
    min: [f32; 3],
    max: [f32; 3],
}

impl Extent {
    const EMPTY: Self = Self {
        min: [f32::INFINITY; 3],
        max: [f32::NEG_INFINITY; 3],
    };

    fn of(places: &[[f32; 3]]) -> Self {
        places.iter().fold(Self::EMPTY, |all, place| Self {
            min: [0, 1, 2].map(|axis| all.min[axis].min(place[axis])),
            max: [0, 1, 2].map(|axis| all.max[axis].max(place[axis])),
        })
    }

    fn widest_axis(&self) -> usize {
        let width = |axis: usize| self.max[axis] - self.min[axis];
        (1..3).fold(0, |widest, axis| {
            if width(axis) > width(widest) {
                axis
            } else {
                widest
            }
        })
    }

    /// Squared distances from there to the nearest and to the farthest place of the box.
    fn distances_squared(&self, from: DVec3) -> [f64; 2] {
        let (min, max) = (wide(self.min), wide(self.max));
        let nearest = (min - from).max(from - max).max(DVec3::ZERO);
        let farthest = (from - min).abs().max((max - from).abs());
        [nearest.length_squared(), farthest.length_squared()]
    }
}

fn wide(place: [f32; 3]) -> DVec3 {
    DVec3::from(place.map(f64::from))
}

/// Sorts the places into the nodes of a subtree of that depth.
fn build(places: &mut [[f32; 3]], nodes: &mut [Extent], depth: u32) {
    let Some((node, children)) = nodes.split_first_mut() else {
        return;
    };
    *node = Extent::of(places);
    if depth == 0 {
        return;
    }
    let axis = node.widest_axis();
    let half = places.len() / 2;
    places.select_nth_unstable_by(half, |a, b| a[axis].total_cmp(&b[axis]));
    let (low, high) = places.split_at_mut(half);
    let (left, right) = children.split_at_mut(children.len() / 2);
    rayon::join(
        || build(low, left, depth - 1),
        || build(high, right, depth - 1),
    );
}

/// A node: its index, its slice of the places, and how many halvings are left.
#[derive(Clone, Copy)]
struct Node {
    at: usize,
    first: usize,
    end: usize,
    depth: u32,
}

impl Node {
    fn children(self) -> [Self; 2] {
        let Self {
            at,
            first,
            end,
            depth,
        } = self;
        let half = first + (end - first) / 2;
        let depth = depth - 1;
        [
            Self {
                at: at + 1,
                first,
                end: half,
                depth,
            },
            Self {
                at: at + (2 << depth),
                first: half,
                end,
                depth,
            },
        ]
    }
}

impl Tree {
    pub(super) fn new(mut places: Vec<[f32; 3]>) -> Self {
        let leaves = places.len().div_ceil(LEAF).next_power_of_two();
        let depth = leaves.ilog2();
        let mut nodes = vec![Extent::EMPTY; 2 * leaves - 1];
        build(&mut places, &mut nodes, depth);
        Self {
            places,
            nodes,
            depth,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    pub(super) fn place(&self, index: usize) -> DVec3 {
        wide(self.places[index])
    }

    fn root(&self) -> Node {
        Node {
            at: 0,
            first: 0,
            end: self.places.len(),
            depth: self.depth,
        }
    }

    /// Squared distance from there to the nearest place but that of index `but`, or `least` if that
    /// is less.
    pub(super) fn nearest_squared(&self, from: DVec3, but: usize, least: f64) -> f64 {
        self.nearest_in(self.root(), from, but, least)
    }

    fn nearest_in(&self, node: Node, from: DVec3, but: usize, least: f64) -> f64 {
        if node.depth == 0 {
            let others = (node.first..node.end).filter(|other| *other != but);
            return others
                .map(|other| self.place(other).distance_squared(from))
                .fold(least, f64::min);
        }
        let mut children = node
            .children()
            .map(|child| (self.nodes[child.at].distances_squared(from)[0], child));
        if children[1].0 < children[0].0 {
            children.swap(0, 1);
        }
        children.into_iter().fold(least, |least, (gap, child)| {
            if gap < least {
                self.nearest_in(child, from, but, least)
            } else {
                least
            }
        })
    }

    /// How many places are nearer to there than the root of `squared`.
    pub(super) fn count_within(&self, from: DVec3, squared: f64) -> u64 {
        self.count_in(self.root(), from, squared)
    }

    fn count_in(&self, node: Node, from: DVec3, squared: f64) -> u64 {
        let [nearest, farthest] = self.nodes[node.at].distances_squared(from);
        if nearest >= squared {
            return 0;
        }
        if farthest < squared {
            return (node.end - node.first) as u64;
        }
        if node.depth == 0 {
            let near = |place: &&[f32; 3]| wide(**place).distance_squared(from) < squared;
            return self.places[node.first..node.end]
                .iter()
                .filter(near)
                .count() as u64;
        }
        let children = node.children();
        children
            .map(|child| self.count_in(child, from, squared))
            .iter()
            .sum()
    }
}
