use glam::Mat4;

/// Where a node is.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) to_world: Mat4,
    /// Largest coordinate on the way from the root: what is rounded there stays so where a later
    /// translation leads back to the origin.
    pub(super) reach: f32,
}

impl Place {
    /// A root's parent.
    pub(super) const ORIGIN: Self = Self { to_world: Mat4::IDENTITY, reach: 0.0 };

    /// That of a node with this transform below this one.
    pub(super) fn of(self, transform: Mat4) -> Self {
        let to_world = self.to_world * transform;
        let step = self.to_world.transform_vector3(transform.w_axis.truncate());
        let farthest = step.abs().max(to_world.w_axis.truncate().abs()).max_element();
        Self { to_world, reach: self.reach.max(farthest) }
    }
}
