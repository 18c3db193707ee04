//! Pinhole cameras.

use glam::Vec3;

/// A pinhole camera. Rays pass through pixel centres: edges cost nobody anything.
#[derive(Clone, Debug)]
pub struct Camera {
    /// Name on the command line.
    pub name: String,
    /// Metres.
    pub position: Vec3,
    /// Unit, to the right of the picture.
    pub right: Vec3,
    /// Unit, to its top.
    pub up: Vec3,
    /// Unit viewing direction.
    pub forward: Vec3,
    /// Full vertical angle of view, radians.
    pub vertical_fov: f32,
}

impl Camera {
    /// A camera at `position` that looks at `target`; `up` need not be orthogonal.
    pub fn look_at(name: &str, position: Vec3, target: Vec3, up: Vec3, vertical_fov: f32) -> Self {
        let forward = (target - position).normalize();
        let right =
            forward.cross(up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        let up = right.cross(forward);
        Self { name: name.to_owned(), position, right, up, forward, vertical_fov }
    }

    /// Unit direction through the centre of pixel (x, y); row 0 is the top.
    pub fn direction(&self, x: u32, y: u32, resolution: [u32; 2]) -> Vec3 {
        let [width, height] = resolution.map(|n| n as f32);
        let half_height = (0.5 * self.vertical_fov).tan();
        let half_width = half_height * width / height;
        let horizontal = ((x as f32 + 0.5) / width * 2.0 - 1.0) * half_width;
        let vertical = (1.0 - (y as f32 + 0.5) / height * 2.0) * half_height;
        (self.forward + horizontal * self.right + vertical * self.up).normalize()
    }
}
