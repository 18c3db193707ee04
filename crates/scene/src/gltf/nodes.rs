//! The node hierarchy: its check and its walk.

use ::gltf as gltf_crate;
use glam::Mat4;
use gltf_crate::json::mesh::{Primitive, Semantic};
use gltf_crate::json::validation::Checked;
use gltf_crate::json::{Accessor, Index, Root, scene};

use super::fault::broken;
use super::import::Import;
use super::notes::Notes;
use super::place::Place;
use super::{optics, primitives};
use crate::LoadError;

/// Most vertices and indices that are drawn: some 4 GiB of them.
pub(crate) const MAX_ELEMENTS: u128 = 1 << 27;

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
    notes.count("scenes besides the one drawn, left out", root.scenes.len() as u64 - 1);
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
    for (i, child) in nodes
        .iter()
        .enumerate()
        .flat_map(|(i, node)| node.children.iter().flatten().map(move |child| (i, child.value())))
    {
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
    let mut placed = Vec::new();
    let mut stack: Vec<_> = roots.into_iter().rev().map(|node| (node, Place::ORIGIN)).collect();
    while let Some((index, parent)) = stack.pop() {
        let node = &nodes[index];
        let place = parent.of(Mat4::from_cols_array_2d(&node.transform().matrix()));
        placed.push((index, place));
        let children: Vec<_> = node.children().map(|child| (child.index(), place)).collect();
        stack.extend(children.into_iter().rev());
    }
    check_size(import.source.document.as_json(), placed.iter().map(|&(index, _)| index))?;
    for (index, place) in placed {
        add(import, &nodes[index], place)
            .map_err(|error| error.within(format!("nodes[{index}]")))?;
    }
    Ok(())
}

/// Refuses scenes that would not fit into memory: many nodes of a small file can show one mesh.
fn check_size(root: &Root, nodes: impl Iterator<Item = usize>) -> Result<(), LoadError> {
    let count = |index: Index<Accessor>| u128::from(root.accessors[index.value()].count.0);
    let size = |primitive: &Primitive| {
        let positions = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
        let vertices = positions.map_or(0, |&index| count(index));
        vertices + primitive.indices.map_or(vertices, count)
    };
    let meshes: Vec<u128> =
        root.meshes.iter().map(|mesh| mesh.primitives.iter().map(size).sum()).collect();
    let total: u128 =
        nodes.filter_map(|node| root.nodes[node].mesh).map(|mesh| meshes[mesh.value()]).sum();
    if total <= MAX_ELEMENTS {
        return Ok(());
    }
    let problem =
        format!("{total} vertices and indices in all instances, more than {MAX_ELEMENTS}");
    Err(LoadError::new("nodes", problem, "reduce the meshes or their instances"))
}

fn add(import: &mut Import, node: &gltf_crate::Node, place: Place) -> Result<(), LoadError> {
    let Place { to_world, .. } = place;
    if let Some(mesh) = node.mesh() {
        for primitive in mesh.primitives() {
            primitives::add(import, &primitive, place).map_err(|error| {
                error.within(format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index()))
            })?;
        }
    }
    if let Some(light) = node.light().filter(|_| import.keep_lights) {
        optics::add_light(import, &light, to_world)?;
    }
    if let Some(camera) = node.camera() {
        optics::add_camera(import, &camera, node.name(), to_world)?;
    }
    Ok(())
}
