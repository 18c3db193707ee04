use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_scene::Camera;

/// A map from the scene to a grid of texels, with its inverse: the ray of each texel. The same
/// bytes go to the GPU.
///
/// A texel (i, j) at sample offset (a, b) has map coordinates x = 2(i + a)/width − 1,
/// y = 1 − 2(j + b)/height. Perspective: rays from `origin` along forward + x·right + y·up.
/// Orthographic: rays along forward from origin + x·right + y·up.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Projection {
    /// Centre of perspective, or of the orthographic start plane; metres.
    pub origin: Vec3,
    /// 0 perspective, 1 orthographic.
    pub orthographic: u32,
    /// To the right edge of the map: a tangent, or metres.
    pub right: Vec3,
    /// Nearest depth that is drawn, metres (perspective).
    pub near: f32,
    /// To the upper edge.
    pub up: Vec3,
    /// Farthest depth that is drawn, metres (orthographic).
    pub far: f32,
    /// Unit.
    pub forward: Vec3,
    /// 1 where shading normals that face away from the viewer give way to geometric ones (primary
    /// hits; see `SurfacePoint::facing`).
    pub facing: u32,
    /// Where in its texel the ray passes, in [0, 1]².
    pub offset: [f32; 2],
    /// Width, height.
    pub resolution: [u32; 2],
}

impl Projection {
    /// Reversed depth near/w keeps all digits of f32 at any distance, so the near plane may be as
    /// close as this fraction of the scene.
    const NEAR: f32 = 1e-6;

    /// The pixels of a camera.
    pub fn camera(camera: &Camera, resolution: [u32; 2], scene_size: f32) -> Self {
        let half_height = (0.5 * camera.vertical_fov).tan();
        let half_width = half_height * resolution[0] as f32 / resolution[1] as f32;
        Self {
            facing: 1,
            ..Self::perspective(
                camera.position,
                [half_width * camera.right, half_height * camera.up, camera.forward],
                resolution,
                scene_size,
            )
        }
    }

    /// A perspective map; `axes` are scaled right, scaled up, unit forward.
    pub fn perspective(
        origin: Vec3,
        [right, up, forward]: [Vec3; 3],
        resolution: [u32; 2],
        scene_size: f32,
    ) -> Self {
        let near = Self::NEAR * scene_size;
        let offset = [0.5; 2];
        let (orthographic, far, facing) = (0, 0.0, 0);
        Self { origin, orthographic, right, near, up, far, forward, facing, offset, resolution }
    }

    /// An orthographic map that reaches `far` metres beyond `origin`.
    pub fn orthographic(
        origin: Vec3,
        [right, up, forward]: [Vec3; 3],
        resolution: [u32; 2],
        far: f32,
    ) -> Self {
        let offset = [0.5; 2];
        let (orthographic, near, facing) = (1, 0.0, 0);
        Self { origin, orthographic, right, near, up, far, forward, facing, offset, resolution }
    }

    /// Origin and unit direction of the ray of a texel.
    pub fn ray(&self, column: u32, row: u32) -> (Vec3, Vec3) {
        let [width, height] = self.resolution.map(|n| n as f32);
        let x = 2.0 * (column as f32 + self.offset[0]) / width - 1.0;
        let y = 1.0 - 2.0 * (row as f32 + self.offset[1]) / height;
        let across = x * self.right + y * self.up;
        if self.orthographic == 1 {
            (self.origin + across, self.forward)
        } else {
            (self.origin, (self.forward + across).normalize())
        }
    }
}
