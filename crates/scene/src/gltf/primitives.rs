//! Triangles of a mesh primitive, brought to world space.

use ::gltf as gltf_crate;
use glam::{Mat3, Vec2, Vec3};
use gltf_crate::mesh::Mode;
use gltf_crate::{Primitive, Semantic};

use super::fault::broken;
use super::import::Import;
use super::place::Place;
use crate::{LoadError, Scene, Triangle, Vertex};

/// Lengths of a triangle's longest edge between it and the origin up to which single precision rounds
/// its corners by less than 1/2048 of that edge.
const MAX_REACH: f32 = 8192.0;

/// Appends a primitive to the scene.
///
/// # Errors
/// Indices out of range, materials that cannot be had.
pub(super) fn add(
    import: &mut Import,
    primitive: &Primitive,
    place: Place,
) -> Result<(), LoadError> {
    if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        import.notes.count("primitives of points or lines left out", 1);
        return Ok(());
    }
    let vertices = Vertices::read(import, primitive, place);
    let indices = indices(import, primitive, vertices.positions.len())?;
    let material = primitive.material();
    let material =
        import.materials.index(&material, import.source, &mut import.scene, &mut import.notes)?;

    let left_over = match primitive.mode() {
        Mode::Triangles => indices.len() % 3 != 0,
        _ => matches!(indices.len(), 1 | 2),
    };
    import.notes.count("primitives with incomplete triangles at their end", left_over.into());
    let shared = vec![None; vertices.positions.len()];
    let mut builder = Builder { vertices: &vertices, shared, material, rounded: 0 };
    let mirrored = place.to_world.determinant() < 0.0;
    for mut corners in triangles(primitive.mode(), &indices) {
        if mirrored {
            corners.swap(1, 2);
        }
        if let Some(flaw) = builder.add(&mut import.scene, corners) {
            import.notes.count(flaw, 1);
        }
    }
    import.rounded += builder.rounded;
    if MAX_REACH * vertices.extent() < vertices.reach {
        import.rounded_whole += builder.rounded;
    }
    Ok(())
}

/// Vertex indices of all triangles in the file's winding (glTF 2.0, section 3.7.2.1).
fn triangles(mode: Mode, indices: &[u32]) -> Box<dyn Iterator<Item = [u32; 3]> + '_> {
    match mode {
        Mode::TriangleStrip => Box::new(
            indices
                .windows(3)
                .enumerate()
                .map(|(i, corner)| [corner[0], corner[1 + i % 2], corner[2 - i % 2]]),
        ),
        Mode::TriangleFan => {
            Box::new(indices.windows(2).skip(1).map(|edge| [edge[0], edge[1], indices[0]]))
        }
        _ => Box::new(indices.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]])),
    }
}

fn indices(import: &Import, primitive: &Primitive, count: usize) -> Result<Vec<u32>, LoadError> {
    let buffers = import.source.buffers;
    let reader = primitive.reader(|buffer| Some(buffers.get(buffer.index())));
    let Some(indices) = reader.read_indices() else { return Ok((0..count as u32).collect()) };
    let indices: Vec<_> = indices.into_u32().collect();
    match indices.iter().find(|&&index| index as usize >= count) {
        Some(index) => {
            Err(broken("indices", format!("one is {index}, but there are {count} vertices")))
        }
        None => Ok(indices),
    }
}

/// The attributes that are used, in world space. Empty where the file has none.
struct Vertices {
    positions: Vec<Vec3>,
    /// Unit, or `None` where the file's normal has no direction.
    normals: Vec<Option<Vec3>>,
    uvs: Vec<Vec2>,
    /// Largest coordinate that was rounded on their way here.
    reach: f32,
}

impl Vertices {
    fn read(import: &mut Import, primitive: &Primitive, place: Place) -> Self {
        let Place { to_world, mut reach } = place;
        let buffers = import.source.buffers;
        let reader = primitive.reader(|buffer| Some(buffers.get(buffer.index())));
        // Cofactors carry normals also where the matrix has no inverse.
        let linear = Mat3::from_mat4(to_world);
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let side = 1_f32.copysign(linear.determinant());
        let cofactors = side * Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));

        let positions = reader.read_positions().into_iter().flatten();
        let positions: Vec<_> = positions
            .map(|position| {
                let offset = to_world.transform_vector3(position.into());
                reach = reach.max(offset.abs().max_element());
                to_world.transform_point3(position.into())
            })
            .collect();
        let normals = reader.read_normals().into_iter().flatten();
        let normals: Vec<_> =
            normals.map(|normal| (cofactors * Vec3::from(normal)).try_normalize()).collect();
        let texture = primitive.material().pbr_metallic_roughness().base_color_texture();
        let uvs = texture.as_ref().and_then(|info| reader.read_tex_coords(info.tex_coord()));
        let uvs: Vec<_> = uvs.into_iter().flat_map(|uvs| uvs.into_f32().map(Vec2::from)).collect();
        import.notes.count(
            "primitives without the texture coordinates that their material asks for, drawn in the \
             colour at (0, 0)",
            (texture.is_some() && uvs.is_empty()).into(),
        );
        let colors = primitive.get(&Semantic::Colors(0)).is_some();
        import.notes.count("primitives whose vertex colours are ignored", colors.into());
        import
            .notes
            .count("primitives without normals, flat ones computed", u64::from(normals.is_empty()));
        Self { positions, normals, uvs, reach }
    }

    /// Diagonal of their bounds.
    fn extent(&self) -> f32 {
        let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let bounds = |(low, high): (Vec3, Vec3), p: &Vec3| (low.min(*p), high.max(*p));
        let (low, high) = self.positions.iter().fold(empty, bounds);
        low.distance(high)
    }
}

/// Appends triangles of one primitive, with the vertices that they use.
struct Builder<'a> {
    vertices: &'a Vertices,
    /// Where the scene has a vertex already.
    shared: Vec<Option<u32>>,
    material: u32,
    /// Triangles that are small for their distance from the origin.
    rounded: u64,
}

impl Builder<'_> {
    /// Appends a triangle; or leaves it out and says why.
    fn add(&mut self, scene: &mut Scene, corners: [u32; 3]) -> Option<&'static str> {
        let positions = corners.map(|corner| self.vertices.positions[corner as usize]);
        let uvs = corners.map(|corner| self.uv(corner));
        if !positions.iter().all(|p| p.is_finite()) || !uvs.iter().all(|uv| uv.is_finite()) {
            return Some("triangles with non-finite vertices left out");
        }
        let [a, b, c] = positions;
        let Some(flat) = (b - a).cross(c - a).try_normalize() else {
            return Some("triangles without area left out");
        };
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        self.rounded += u64::from(MAX_REACH * longest < self.vertices.reach);
        let vertices = corners.map(|corner| self.vertex(scene, corner, flat));
        scene.triangles.push(Triangle { vertices, material: self.material });
        None
    }

    fn uv(&self, corner: u32) -> Vec2 {
        self.vertices.uvs.get(corner as usize).copied().unwrap_or_default()
    }

    /// The scene's index of a vertex: shared among triangles, unless it takes the triangle's normal.
    fn vertex(&mut self, scene: &mut Scene, corner: u32, flat: Vec3) -> u32 {
        let normal = self.vertices.normals.get(corner as usize).copied().flatten();
        if let (Some(_), Some(index)) = (normal, self.shared[corner as usize]) {
            return index;
        }
        let index = scene.vertices.len() as u32;
        let position = self.vertices.positions[corner as usize];
        let normal_or_flat = normal.unwrap_or(flat);
        scene.vertices.push(Vertex { position, normal: normal_or_flat, uv: self.uv(corner) });
        self.shared[corner as usize] = normal.map(|_| index);
        index
    }
}
