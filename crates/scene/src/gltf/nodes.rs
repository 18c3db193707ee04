//! The node hierarchy: its check, its walk, and the lights and cameras that hang in it.

use std::f32::consts::{FRAC_PI_2, PI};

use ::gltf as gltf_crate;
use gltf_crate::camera::Projection;
use gltf_crate::json::{Root, scene};
use gltf_crate::khr_lights_punctual::Kind;
use glam::{Mat4, Vec3};

use super::notes::Notes;
use super::{Import, broken, primitives};
use crate::{Camera, Light, LoadError, Scene};

/// Widest half-angle of a spot light: at a right angle its map of texels would be infinite.
const MAX_CONE: f32 = FRAC_PI_2 - 0.02;

/// The root nodes of the default scene, or of the first, or of the whole file.
///
/// # Errors
/// Where the hierarchy is not a forest: a node with two parents, or a cycle.
pub(super) fn roots(root: &Root, notes: &mut Notes) -> Result<Vec<usize>, LoadError> {
    let parentless = forest(&root.nodes)?;
    let default = root.scene.map_or(0, |index| index.value());
    let Some(scene) = root.scenes.get(default) else {
        notes.count("no scene defined, all root nodes drawn", parentless.len() as u64);
        return Ok(parentless);
    };
    let mut roots: Vec<_> = scene.nodes.iter().map(|index| index.value()).collect();
    let place = format!("scenes[{default}].nodes");
    if let Some(node) = roots.iter().find(|&node| parentless.binary_search(node).is_err()) {
        return Err(broken(place, format!("node {node} is also the child of another node")));
    }
    roots.sort_unstable();
    if let Some(pair) = roots.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(broken(place, format!("node {} is listed twice", pair[0])));
    }
    Ok(roots)
}

/// The nodes without a parent, in order, after a check that each node is reached exactly once from
/// them.
fn forest(nodes: &[scene::Node]) -> Result<Vec<usize>, LoadError> {
    let mut has_parent = vec![false; nodes.len()];
    for (i, child) in nodes.iter().enumerate().flat_map(|(i, node)| {
        node.children.iter().flatten().map(move |child| (i, child.value()))
    }) {
        if std::mem::replace(&mut has_parent[child], true) {
            let problem = format!("node {child} is the child of more than one node");
            return Err(broken(format!("nodes[{i}].children"), problem));
        }
    }
    let parentless: Vec<_> = (0..nodes.len()).filter(|&i| !has_parent[i]).collect();
    // With one parent each, what cannot be reached from above hangs on a cycle.
    let mut reached = vec![false; nodes.len()];
    let mut stack = parentless.clone();
    while let Some(node) = stack.pop() {
        reached[node] = true;
        stack.extend(nodes[node].children.iter().flatten().map(|child| child.value()));
    }
    match reached.iter().position(|&reached| !reached) {
        Some(node) => Err(broken(format!("nodes[{node}]"), "is below itself (a cycle)")),
        None => Ok(parentless),
    }
}

/// Adds what hangs below `roots` to the scene. The stack is on the heap: depth is no danger.
pub(super) fn add_all(import: &mut Import, roots: Vec<usize>) -> Result<(), LoadError> {
    let nodes: Vec<_> = import.source.document.nodes().collect();
    let mut stack: Vec<_> = roots.into_iter().rev().map(|node| (node, Mat4::IDENTITY)).collect();
    while let Some((index, parent)) = stack.pop() {
        let node = &nodes[index];
        let to_world = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        add(import, node, to_world).map_err(|error| error.within(format!("nodes[{index}]")))?;
        let children: Vec<_> = node.children().map(|child| (child.index(), to_world)).collect();
        stack.extend(children.into_iter().rev());
    }
    Ok(())
}

fn add(import: &mut Import, node: &gltf_crate::Node, to_world: Mat4) -> Result<(), LoadError> {
    if let Some(mesh) = node.mesh() {
        for primitive in mesh.primitives() {
            primitives::add(import, &primitive, to_world).map_err(|error| {
                error.within(format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index()))
            })?;
        }
    }
    if let Some(light) = node.light() {
        let light = new_light(&light, to_world, &mut import.notes)?;
        import.scene.lights.push(light);
    }
    if let Some(camera) = node.camera() {
        let fallback = format!("camera-{}", import.scene.cameras.len());
        let name = node.name().or(camera.name()).map_or(fallback, str::to_owned);
        match camera.projection() {
            Projection::Perspective(lens) => {
                let camera = new_camera(&import.scene, name, lens.yfov(), to_world)?;
                import.scene.cameras.push(camera);
            }
            Projection::Orthographic(_) => {
                import.notes.count("orthographic cameras left out", 1);
            }
        }
    }
    Ok(())
}

/// A unit direction of a node's frame in world space.
fn axis(to_world: Mat4, local: Vec3) -> Result<Vec3, LoadError> {
    let axis = to_world.transform_vector3(local).try_normalize();
    axis.ok_or_else(|| broken("transform", "has no finite, non-zero scale"))
}

fn origin(to_world: Mat4) -> Result<Vec3, LoadError> {
    let origin = to_world.w_axis.truncate();
    if origin.is_finite() { Ok(origin) } else { Err(broken("transform", "is not finite")) }
}

fn new_camera(
    scene: &Scene,
    mut name: String,
    fov: f32,
    to_world: Mat4,
) -> Result<Camera, LoadError> {
    if !(fov > 0.0 && fov < PI) {
        return Err(broken("camera.perspective.yfov", format!("{fov} is not between 0 and π")));
    }
    while scene.cameras.iter().any(|camera| camera.name == name) {
        name.push('+');
    }
    let position = origin(to_world)?;
    let forward = axis(to_world, Vec3::NEG_Z)?;
    let up = axis(to_world, Vec3::Y)?;
    Ok(Camera::look_at(&name, position, position + forward, up, fov))
}

fn new_light(
    light: &gltf_crate::khr_lights_punctual::Light,
    to_world: Mat4,
    notes: &mut Notes,
) -> Result<Light, LoadError> {
    let intensity = Vec3::from(light.color()) * light.intensity();
    if !intensity.is_finite() || intensity.min_element() < 0.0 {
        return Err(broken("light", "its colour times its intensity is negative or infinite"));
    }
    notes.count("lights whose range is ignored", u64::from(light.range().is_some()));
    Ok(match light.kind() {
        Kind::Point => Light::Point { position: origin(to_world)?, intensity },
        Kind::Directional => {
            Light::Directional { direction: axis(to_world, Vec3::NEG_Z)?, irradiance: intensity }
        }
        Kind::Spot { inner_cone_angle: inner, outer_cone_angle: outer } => {
            if !(0.0 <= inner && inner < outer && outer <= FRAC_PI_2 + 1e-4) {
                let problem = format!("the angles {inner}, {outer} are not 0 ≤ inner < outer ≤ π/2");
                return Err(broken("light.spot", problem));
            }
            notes.count("spot lights narrowed to 89°", u64::from(outer > MAX_CONE));
            let outer = outer.min(MAX_CONE);
            let direction = axis(to_world, Vec3::NEG_Z)?;
            Light::Spot { position: origin(to_world)?, direction, intensity, inner: inner.min(outer), outer }
        }
    })
}

/// Gives a scene without cameras one that sees it whole, from the front and a little above.
pub(super) fn frame(scene: &mut Scene, notes: &mut Notes) {
    notes.count("no light in the file", u64::from(scene.lights.is_empty() && scene.emissive_triangles().next().is_none()));
    if !scene.cameras.is_empty() {
        return;
    }
    const FOV: f32 = 0.7;
    notes.count("no camera in the file, framed from outside", 1);
    let (low, high) = scene.bounds();
    let centre = low.midpoint(high);
    let radius = 0.5 * low.distance(high);
    let distance = if radius > 0.0 { radius / (0.5 * FOV).sin() } else { 1.0 };
    let position = centre + distance * Vec3::new(0.4, 0.35, 1.0).normalize();
    scene.cameras.push(Camera::look_at("framed", position, centre, Vec3::Y, FOV));
}
