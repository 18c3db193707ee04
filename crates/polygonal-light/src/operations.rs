//! What exact triangles cost, counted in the text of their kernel.

use manylights_area_lights::{TRANSFORMED_OPERATIONS, cap_operations};
use manylights_gpu::{Error, Operations, operations};
use manylights_reflectance::ReceiverKinds;

use crate::gather::transformed;
use crate::{Approximation, Edges, Settings, linked_shader};

/// Of one receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactOperations {
    /// Once a batch: its lobes into weights.
    pub receiver: Operations,
    /// A near triangle: its solid angle and three edges.
    pub triangle: Operations,
    /// A near edge that triangles share, with its part of the solid angle.
    pub edge: Operations,
    /// A far triangle, by seven points.
    pub far: Operations,
}

/// For receivers of these lobes, in so many bands.
///
/// # Errors
/// Where the kernel does not link.
pub fn exact_operations(
    kinds: ReceiverKinds,
    settings: &Settings,
) -> Result<ExactOperations, Error> {
    let settings = Settings { approximation: Approximation::Exact(Edges::Own), ..*settings };
    let wgsl = linked_shader(kinds, &settings)?.wgsl;
    let of =
        |function: &str, turns| operations(&wgsl, &format!("package_estimator_{function}"), turns);
    Ok(ExactOperations {
        receiver: of("receiver", 1)?,
        triangle: of("near", 3)?,
        edge: of("near", 1)?,
        far: of("far", 7)?,
    })
}

/// What a pixel and a record take, about: runs are cut by it.
pub fn record_operations(kinds: ReceiverKinds, settings: &Settings) -> usize {
    let sphere = cap_operations(kinds, settings.bands);
    let of_bands = match settings.approximation {
        // What does not grow with the bands is less.
        Approximation::Exact(_) => 9 * sphere - 400,
        Approximation::Sphere(_) => sphere,
    };
    of_bands + if transformed(kinds, settings) { TRANSFORMED_OPERATIONS } else { 0 }
}
