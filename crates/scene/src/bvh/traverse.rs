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
                    stack.extend(Set(mask).map(|lane| node.children[lane % WIDTH]));
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
    origin: [f32x4<S>; 3],
    direction: [f32x4<S>; 3],
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray) -> Self {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        let inverse =
            direction.map(|d| if d.abs() < SMALLEST { SMALLEST.copysign(d) } else { d }.recip());
        Self {
            simd,
            inverse: inverse.map(|value| f32x8::splat(simd, value)),
            box_origin: origin.map(|value| f32x8::splat(simd, value)),
            near: std::array::from_fn(|axis| 2 * axis + usize::from(inverse[axis] < 0.0)),
            t_min: f32x8::splat(simd, ray.t_min),
            origin: origin.map(|value| f32x4::splat(simd, value)),
            direction: direction.map(|value| f32x4::splat(simd, value)),
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

    /// Visits the hits of four triangles: the test of Möller and Trumbore 1997 with the normal as the
    /// first product, all numerators scaled by the sign of the determinant.
    #[inline(always)]
    fn block<B>(
        &self,
        block: &Block,
        t_min: f32,
        t_max: f32,
        mut visit: impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let simd = self.simd;
        let load = |axes: &[[f32; PACK]; 3]| {
            axes.each_ref().map(|lanes| f32x4::load_array_ref(simd, lanes))
        };
        let splat = |value| f32x4::splat(simd, value);
        let (corner, from_b, to_c) = (load(&block.corner), load(&block.from_b), load(&block.to_c));
        let normal = cross(from_b, to_c);
        let offset = std::array::from_fn(|axis| corner[axis] - self.origin[axis]);
        let turned = cross(self.direction, offset);
        let determinant = dot(normal, self.direction);
        let sign = splat(1.0).copysign(determinant);
        let scale = determinant * sign;
        let u = dot(turned, to_c) * sign;
        let v = dot(turned, from_b) * sign;
        let t = dot(normal, offset) * sign;
        let zero = splat(0.0);
        let inside = u.min(v).min(scale - u - v).simd_ge(zero) & scale.simd_gt(zero);
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

#[inline(always)]
fn cross<S: Simd>(a: [f32x4<S>; 3], b: [f32x4<S>; 3]) -> [f32x4<S>; 3] {
    let component = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [component(1, 2), component(2, 0), component(0, 1)]
}

#[inline(always)]
fn dot<S: Simd>(a: [f32x4<S>; 3], b: [f32x4<S>; 3]) -> f32x4<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
