use std::path::PathBuf;

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use crate::{AreaLight, Camera, Light, LoadError, Material, SurfacePoint, Texture};

/// A vertex; the same 32 bytes go to the GPU.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Vertex {
    /// World space, metres.
    pub position: Vec3,
    /// Shading normal, unit length.
    pub normal: Vec3,
    /// Texture coordinates; (0, 0) where the mesh has none.
    pub uv: Vec2,
}

/// Three vertices and a material; the same 16 bytes go to the GPU.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Triangle {
    /// Indices into [`Scene::vertices`]; counter-clockwise seen from the front.
    pub vertices: [u32; 3],
    /// Index into [`Scene::materials`].
    pub material: u32,
}

/// Everything that a renderer needs, in flat arrays.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Name in results: that of the built-in or the file's stem.
    pub name: String,
    /// Vertices of all meshes, in world space.
    pub vertices: Vec<Vertex>,
    /// Non-degenerate triangles with finite vertices and indices in range.
    pub triangles: Vec<Triangle>,
    /// At least one where there are triangles.
    pub materials: Vec<Material>,
    /// Base-colour textures.
    pub textures: Vec<Texture>,
    /// Point-like primary lights. Emissive triangles are found through their materials.
    pub lights: Vec<Light>,
    /// Lights with a surface that is none of the scene's.
    pub area_lights: Vec<AreaLight>,
    /// The first is the default.
    pub cameras: Vec<Camera>,
    /// Factor from radiance to display-referred linear values, before clamping and the sRGB curve.
    pub exposure: f32,
    /// What import changed, dropped or made up, in words for the user.
    pub notes: Vec<String>,
    /// The files that it was made from, and those that these name, read or not: nothing may be written
    /// over them. No part of the picture.
    pub sources: Vec<PathBuf>,
}

impl Scene {
    /// The camera of that name, or the default one.
    ///
    /// # Errors
    /// Where there is none of that name (the nearest is suggested) or none at all.
    pub fn camera(&self, name: Option<&str>) -> Result<&Camera, LoadError> {
        let place = format!("scene `{}`", self.name);
        match name {
            Some(name) => self.cameras.iter().find(|camera| camera.name == name).ok_or_else(|| {
                let names = self.cameras.iter().map(|camera| camera.name.as_str());
                LoadError::unknown(place, "camera", name, names)
            }),
            None => self
                .cameras
                .first()
                .ok_or_else(|| LoadError::new(place, "has no camera", "add one in a scene file")),
        }
    }

    /// Lower and upper corner of all triangles; zeros for an empty scene.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut corners = self
            .triangles
            .iter()
            .flat_map(|triangle| triangle.vertices)
            .map(|vertex| self.vertices[vertex as usize].position);
        let Some(first) = corners.next() else { return (Vec3::ZERO, Vec3::ZERO) };
        corners.fold((first, first), |(low, high), p| (low.min(p), high.max(p)))
    }

    /// Diagonal of the bounds in metres: the "scene size" of all relative tolerances.
    pub fn size(&self) -> f32 {
        let (low, high) = self.bounds();
        (high - low).length()
    }

    /// The three corner positions of a triangle.
    #[inline]
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].vertices.map(|v| self.vertices[v as usize].position)
    }

    /// Unit normal of the plane of a triangle, on its front (counter-clockwise) side.
    #[inline]
    pub fn geometric_normal(&self, triangle: u32) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a).normalize()
    }

    /// Whether the material of this triangle emits.
    #[inline]
    pub fn emits(&self, triangle: u32) -> bool {
        self.material_of(triangle).emission != Vec3::ZERO
    }

    /// The material of a triangle.
    #[inline]
    pub fn material_of(&self, triangle: u32) -> &Material {
        &self.materials[self.triangles[triangle as usize].material as usize]
    }

    /// Triangles that emit, in index order.
    pub fn emissive_triangles(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.triangles.len() as u32).filter(|&triangle| self.emits(triangle))
    }

    /// All that shines from a surface: [`Self::area_lights`], then the emissive triangles, in order.
    pub fn all_area_lights(&self) -> impl Iterator<Item = AreaLight> + '_ {
        let of_meshes = self.emissive_triangles().map(|triangle| {
            let material = self.material_of(triangle);
            AreaLight::Triangle {
                corners: self.corners(triangle),
                radiance: material.emission,
                two_sided: material.two_sided,
            }
        });
        self.area_lights.iter().copied().chain(of_meshes)
    }

    /// Whether any material has a specular lobe: pipelines leave GGX out where none has.
    pub fn has_specular(&self) -> bool {
        self.materials.iter().any(Material::has_specular)
    }

    /// The surface where a ray of direction `arriving` (towards the surface) meets `triangle` at
    /// barycentric coordinates (u, v): position = (1−u−v)·a + u·b + v·c.
    ///
    /// Both normals face the side from which the ray arrives (surfaces are two-sided).
    #[inline]
    pub fn surface(&self, triangle: u32, u: f32, v: f32, arriving: Vec3) -> SurfacePoint {
        let indices = self.triangles[triangle as usize];
        let [a, b, c] = indices.vertices.map(|index| self.vertices[index as usize]);
        let w = 1.0 - u - v;
        let front = self.geometric_normal(triangle);
        let side = if front.dot(arriving) <= 0.0 { 1.0 } else { -1.0 };
        let smooth = (w * a.normal + u * b.normal + v * c.normal).try_normalize().unwrap_or(front);
        // A mesh may carry normals against its winding; they are turned to the same side.
        let smooth = if smooth.dot(front) < 0.0 { -smooth } else { smooth };
        let material = &self.materials[indices.material as usize];
        let uv = w * a.uv + u * b.uv + v * c.uv;
        SurfacePoint {
            position: w * a.position + u * b.position + v * c.position,
            geometric_normal: side * front,
            normal: side * smooth,
            triangle,
            material: indices.material,
            brdf: material.brdf(material.base_color_at(&self.textures, uv)),
            emission: if side > 0.0 || material.two_sided { material.emission } else { Vec3::ZERO },
        }
    }
}
