//! Layout and construction: an eight-wide hierarchy, collapsed from the binary one of `obvhs`, with
//! leaves of packed triangles.
//!
//! Node and leaf tests work on all lanes at once. Bounds are full single precision: quantised nodes
//! are smaller but cost arithmetic in every visit.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ploc::PlocSearchDistance;

/// Children of a node.
pub(super) const WIDTH: usize = 8;
/// Triangles in a block.
pub(super) const PACK: usize = 4;

/// Leaves of up to two blocks, and a box test that costs as much as four triangles (a block): the
/// fastest of the settings tried on the room of `benches/rays.rs`. Triangles are not split, so that
/// each is met once.
const BUILD: BvhBuildParams = BvhBuildParams {
    pre_split: false,
    ploc_search_distance: PlocSearchDistance::High,
    reinsertion_batch_ratio: 0.2,
    max_prims_per_leaf: 2 * PACK as u32,
    collapse_traversal_cost: PACK as f32,
    ..BvhBuildParams::medium_build()
};

/// Bounds of up to eight children.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Low x, high x, low y, high y, low z, high z of each child; inverted infinities where there is
    /// none.
    pub(super) planes: [[f32; WIDTH]; 6],
    pub(super) children: [Child; WIDTH],
}

/// A node, or blocks of triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Child(u32);

/// Four triangles, as the intersection test wants them: `[corner][axis][lane]`. Unused lanes are degenerate.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Block {
    pub(super) corners: [[[f32; PACK]; 3]; 3],
    pub(super) triangles: [u32; PACK],
}

/// The hierarchy; the first node is the root.
#[derive(Debug, Default)]
pub(super) struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
}

/// The hierarchy in the words that shaders read: children as in `Child`, floats as their bits.
pub struct BvhWords {
    /// 48 planes (low x, high x, low y, … of eight children each) and eight children a node.
    pub nodes: Vec<[u32; 56]>,
    /// Four triangles a block: the x, y, z of four first corners each, then of the second, the third.
    pub blocks: Vec<[u32; 36]>,
    /// Entries that the stack of a walk needs.
    pub stack: u32,
}

/// What a [`Child`] stands for.
pub(super) enum Target {
    Node(usize),
    Blocks(std::ops::Range<usize>),
}

impl Child {
    const LEAF: u32 = 1 << 31;
    const COUNT_BITS: u32 = 2;

    pub(super) const ROOT: Self = Self(0);
    /// A leaf without blocks.
    const NONE: Self = Self(Self::LEAF);

    fn node(index: usize) -> Self {
        assert!(index < Self::LEAF as usize, "more than 2³¹ nodes");
        Self(index as u32)
    }

    fn blocks(first: usize, count: usize) -> Self {
        assert!(count < 1 << Self::COUNT_BITS, "a leaf has one or two blocks");
        assert!(first < (Self::LEAF >> Self::COUNT_BITS) as usize, "more than 2²⁹ blocks");
        Self(Self::LEAF | (first as u32) << Self::COUNT_BITS | count as u32)
    }

    #[inline(always)]
    pub(super) fn target(self) -> Target {
        if self.0 & Self::LEAF == 0 {
            return Target::Node(self.0 as usize);
        }
        let first = ((self.0 & !Self::LEAF) >> Self::COUNT_BITS) as usize;
        Target::Blocks(first..first + (self.0 as usize & ((1 << Self::COUNT_BITS) - 1)))
    }
}

impl Wide {
    /// Boxes are wider than their triangles by `margin` on each side.
    pub(super) fn build(triangles: &[[Vec3; 3]], margin: f32) -> Self {
        if triangles.is_empty() {
            return Self::default();
        }
        let inputs: Vec<_> = triangles
            .iter()
            .map(|corners| corners.map(Vec3A::from))
            .map(|[v0, v1, v2]| obvhs::triangle::Triangle { v0, v1, v2 })
            .collect();
        let binary = build_bvh2_from_tris(&inputs, BUILD, &mut Duration::default());
        let mut wide = Self { nodes: vec![Node::EMPTY], blocks: Vec::new() };
        // (slot in `nodes`, index of the binary node that it replaces)
        let mut pending = vec![(0, 0)];
        while let Some((slot, root)) = pending.pop() {
            let mut node = Node::EMPTY;
            for (lane, index) in children(&binary, root).into_iter().enumerate() {
                let child = &binary.nodes[index];
                for axis in 0..3 {
                    node.planes[2 * axis][lane] = child.aabb().min[axis] - margin;
                    node.planes[2 * axis + 1][lane] = child.aabb().max[axis] + margin;
                }
                node.children[lane] = if child.is_leaf() {
                    let first = child.first_index as usize;
                    let members = &binary.primitive_indices[first..][..child.prim_count as usize];
                    wide.push_leaf(triangles, members)
                } else {
                    pending.push((wide.nodes.len(), index));
                    wide.nodes.push(Node::EMPTY);
                    Child::node(wide.nodes.len() - 1)
                };
            }
            wide.nodes[slot] = node;
        }
        wide
    }

    pub(super) fn words(&self) -> BvhWords {
        let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        let node = |node: &Node| {
            let planes = bits(node.planes.as_flattened());
            std::array::from_fn(|i| match i.checked_sub(6 * WIDTH) {
                None => planes[i],
                Some(lane) => node.children[lane].0,
            })
        };
        let block = |block: &Block| {
            let corners = bits(block.corners.as_flattened().as_flattened());
            std::array::from_fn(|i| corners[i])
        };
        // A walk through nothing still starts at a root.
        let nodes = if self.nodes.is_empty() { &[Node::EMPTY][..] } else { &self.nodes };
        // Each visited node leaves its entry and adds eight.
        let stack = 1 + (WIDTH as u32 - 1) * self.depth(0);
        BvhWords {
            nodes: nodes.iter().map(node).collect(),
            blocks: self.blocks.iter().map(block).collect(),
            stack,
        }
    }

    /// Levels of nodes below and with this one.
    fn depth(&self, node: usize) -> u32 {
        let Some(node) = self.nodes.get(node) else { return 0 };
        let inner = node.children.iter().filter_map(|child| match child.target() {
            Target::Node(index) => Some(self.depth(index)),
            Target::Blocks(_) => None,
        });
        1 + inner.max().unwrap_or(0)
    }

    fn push_leaf(&mut self, triangles: &[[Vec3; 3]], members: &[u32]) -> Child {
        let first = self.blocks.len();
        self.blocks.extend(members.chunks(PACK).map(|members| Block::new(triangles, members)));
        Child::blocks(first, self.blocks.len() - first)
    }
}

impl Node {
    const EMPTY: Self = {
        let (low, high) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
        Self { planes: [low, high, low, high, low, high], children: [Child::NONE; WIDTH] }
    };
}

impl Block {
    fn new(triangles: &[[Vec3; 3]], members: &[u32]) -> Self {
        let mut block = Self { corners: [[[0.0; PACK]; 3]; 3], triangles: [0; PACK] };
        for (lane, &triangle) in members.iter().enumerate() {
            for (target, corner) in block.corners.iter_mut().zip(triangles[triangle as usize]) {
                for axis in 0..3 {
                    target[axis][lane] = corner[axis];
                }
            }
            block.triangles[lane] = triangle;
        }
        block
    }
}

/// Up to eight descendants that replace a binary node: the one of the largest surface is opened until
/// there are eight.
fn children(binary: &Bvh2, root: usize) -> Vec<usize> {
    let mut children = vec![root];
    while children.len() < WIDTH {
        let area = |index: usize| binary.nodes[index].aabb().half_area();
        let largest = (0..children.len())
            .filter(|&position| !binary.nodes[children[position]].is_leaf())
            .max_by(|&a, &b| area(children[a]).total_cmp(&area(children[b])));
        let Some(position) = largest else { break };
        let first = binary.nodes[children[position]].first_index as usize;
        children[position] = first;
        children.push(first + 1);
    }
    children
}
