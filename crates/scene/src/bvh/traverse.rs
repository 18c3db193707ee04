//! Walks through the hierarchy.
//!
//! No fused multiply-adds: products are rounded alike on every processor.

use std::ops::ControlFlow;

use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8};
use smallvec::SmallVec;

use super::wide::{Block, Child, Node, PACK, Target, WIDTH, Wide};
use super::{Hit, Ray};

/// Entries of the stack that need no allocation; seven for each level but one.
const STACK: usize = 96;

/// Nearest direction component to zero whose inverse does not overflow in products with coordinates.
const SMALLEST: f32 = 1e-18;

/// Widens the far end of a box: the distances to its planes are off by up to 1.5 units in the last
/// place each (Ize 2013, "Robust BVH Ray Traversal", section 3).
const FAR_SCALE: f32 = 1.0 + 4.0 * f32::EPSILON;

impl Wide {
    /// The nearest hit: nearer children first.
    #[inline(always)]
    pub(super) fn closest<S: Simd>(&self, simd: S, ray: &Ray) -> Option<Hit> {
        if self.nodes.is_empty() {
            return None;
        }
        let lanes = Lanes::new(simd, ray);
        let mut nearest = None;
        let mut t_max = ray.t_max;
        let mut stack: SmallVec<[(Child, f32); STACK]> = SmallVec::new();
        let mut current = Child::ROOT;
        loop {
            match current.target() {
                Target::Node(index) => {
                    let node = &self.nodes[index];
                    let (mask, distances) = lanes.node(node, t_max);
                    if let Some(child) = push_sorted(&mut stack, node, mask, &distances) {
                        current = child;
                        continue;
                    }
                }
                Target::Blocks(range) => {
                    for block in &self.blocks[range] {
                        let _: ControlFlow<()> = lanes.block(block, ray.t_min, t_max, |hit| {
                            if hit.t <= t_max {
                                t_max = hit.t;
                                nearest = Some(hit);
                            }
                            ControlFlow::Continue(())
                        });
                    }
                }
            }
            current = loop {
                let Some((child, distance)) = stack.pop() else { return nearest };
                if distance <= t_max {
                    break child;
                }
            };
        }
    }

    /// Every hit, until `visit` breaks.
    #[inline(always)]
    pub(super) fn each<S: Simd, B>(
        &self,
        simd: S,
        ray: &Ray,
        mut visit: impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        if self.nodes.is_empty() {
            return ControlFlow::Continue(());
        }
        let lanes = Lanes::new(simd, ray);
        let mut stack: SmallVec<[Child; STACK]> = SmallVec::new();
        stack.push(Child::ROOT);
        while let Some(child) = stack.pop() {
            match child.target() {
                Target::Node(index) => {
                    let node = &self.nodes[index];
                    let (mask, _) = lanes.node(node, ray.t_max);
                    for lane in Set(mask) {
                        stack.push(node.children[lane % WIDTH]);
                    }
                }
                Target::Blocks(range) => {
                    for block in &self.blocks[range] {
                        lanes.block(block, ray.t_min, ray.t_max, &mut visit)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// Returns the nearest of the children in `mask` and pushes the others, the farthest first.
#[inline(always)]
fn push_sorted(
    stack: &mut SmallVec<[(Child, f32); STACK]>,
    node: &Node,
    mask: u32,
    distances: &[f32; WIDTH],
) -> Option<Child> {
    let mut hits = Set(mask).map(|lane| lane % WIDTH).map(|l| (node.children[l], distances[l]));
    let mut nearest = hits.next()?;
    let base = stack.len();
    for mut hit in hits {
        if hit.1 < nearest.1 {
            std::mem::swap(&mut hit, &mut nearest);
        }
        let mut position = stack.len();
        stack.push(hit);
        while position > base && stack[position - 1].1 < hit.1 {
            stack.swap(position, position - 1);
            position -= 1;
        }
    }
    Some(nearest.0)
}

/// The positions of the ones in a number.
struct Set(u32);

impl Iterator for Set {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let first = self.0.trailing_zeros();
        (self.0 != 0).then(|| {
            self.0 &= self.0 - 1;
            first as usize
        })
    }
}

/// A ray, spread over the lanes.
struct Lanes<S: Simd> {
    simd: S,
    inverse: [f32x8<S>; 3],
    box_origin: [f32x8<S>; 3],
    /// Index of the plane of each axis that the ray meets first.
    near: [usize; 3],
    t_min: f32x8<S>,
    /// The axes in the order of the triangle test: the last is the ray's longest.
    axes: [usize; 3],
    /// Of those axes.
    origin: [f32x4<S>; 3],
    /// x and y of the direction over its z, and one over its z.
    shear: [f32x4<S>; 3],
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray) -> Self {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        let inverse =
            direction.map(|d| if d.abs() < SMALLEST { SMALLEST.copysign(d) } else { d }.recip());
        let longest = ray.direction.abs().max_position();
        let axes = [(longest + 1) % 3, (longest + 2) % 3, longest];
        let along = direction[longest];
        let shear = [direction[axes[0]] / along, direction[axes[1]] / along, along.recip()];
        Self {
            simd,
            inverse: inverse.map(|value| f32x8::splat(simd, value)),
            box_origin: origin.map(|value| f32x8::splat(simd, value)),
            near: std::array::from_fn(|axis| 2 * axis + usize::from(inverse[axis] < 0.0)),
            t_min: f32x8::splat(simd, ray.t_min),
            axes,
            origin: axes.map(|axis| f32x4::splat(simd, origin[axis])),
            shear: shear.map(|value| f32x4::splat(simd, value)),
        }
    }

    /// Which children the ray enters before `t_max`, and where.
    #[inline(always)]
    fn node(&self, node: &Node, t_max: f32) -> (u32, [f32; WIDTH]) {
        let plane = |axis: usize, index: usize| {
            let plane = f32x8::load_array_ref(self.simd, &node.planes[index % 6]);
            (plane - self.box_origin[axis]) * self.inverse[axis]
        };
        let [x, y, z] = self.near;
        let near = plane(0, x).max(plane(1, y)).max(plane(2, z).max(self.t_min));
        let far = plane(0, x ^ 1).min(plane(1, y ^ 1)).min(plane(2, z ^ 1)) * FAR_SCALE;
        let far = far.min(f32x8::splat(self.simd, t_max));
        (near.simd_le(far).to_bitmask() as u32, near.to_array())
    }

    /// Visits the hits of four triangles: the watertight test of Woop, Benthin and Wald 2013
    /// ("Watertight Ray/Triangle Intersection", JCGT 2(1)). Corners are sheared so that the ray runs
    /// along z, each alike for all triangles that share it, and edges are tested in that plane.
    ///
    /// Their second look in double precision at edges that come out as zero is left out: such an edge
    /// counts as met on both of its sides, which opens no gap, for rounding never turns a sign.
    #[inline(always)]
    fn block<B>(
        &self,
        block: &Block,
        t_min: f32,
        t_max: f32,
        mut visit: impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let simd = self.simd;
        let splat = |value| f32x4::splat(simd, value);
        let sheared = |corner: &[[f32; PACK]; 3]| {
            let [x, y, z] = std::array::from_fn(|i| {
                f32x4::load_array_ref(simd, &corner[self.axes[i] % 3]) - self.origin[i]
            });
            [x - self.shear[0] * z, y - self.shear[1] * z, z]
        };
        let [a, b, c] = block.corners.each_ref().map(sheared);
        let (at_a, at_b, at_c) = (edge(c, b), edge(a, c), edge(b, a));
        let sum = at_a + at_b + at_c;
        let sign = splat(1.0).copysign(sum);
        let (scale, u, v) = (sum * sign, at_b * sign, at_c * sign);
        let t = (at_a * a[2] + at_b * b[2] + at_c * c[2]) * sign * self.shear[2];
        let zero = splat(0.0);
        let inside = (at_a * sign).min(u).min(v).simd_ge(zero) & scale.simd_gt(zero);
        let within = t.simd_gt(scale * splat(t_min)) & t.simd_le(scale * splat(t_max));
        let mask = (inside & within).to_bitmask() as u32;
        if mask == 0 {
            return ControlFlow::Continue(());
        }
        let inverse = splat(1.0) / scale;
        let (t, u, v) =
            ((t * inverse).to_array(), (u * inverse).to_array(), (v * inverse).to_array());
        for lane in Set(mask).map(|lane| lane % PACK) {
            let triangle = block.triangles[lane];
            visit(Hit { t: t[lane], triangle, u: u[lane], v: v[lane] })?;
        }
        ControlFlow::Continue(())
    }
}

/// Twice the signed area between the ray and an edge, in the plane across the ray; exactly the
/// negative of that of the edge the other way round.
#[inline(always)]
fn edge<S: Simd>(from: [f32x4<S>; 3], to: [f32x4<S>; 3]) -> f32x4<S> {
    from[0] * to[1] - from[1] * to[0]
}
