//! What lights cost, counted in the text of their kernel.

use manylights_gpu::{Error, Operations, operations};
use manylights_reflectance::ReceiverKinds;

use crate::{LightKinds, linked_shader};

/// Of one light on one receiver: on Lambertian ones a single irradiance, else, as of Schlick's transmission to
/// grazing light, which is 0, one of the Lambertian lobe and one of the specular one. Triangles are as if the
/// surface's horizon alone cut them to four corners, and the axis of an ellipse as if found in [`STEPS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightOperations {
    /// Once a batch: the lobe's transform.
    pub receiver: Operations,
    /// A near triangle, by its edges.
    pub near: Operations,
    /// A far triangle, by seven points a triangle.
    pub far: Operations,
    /// A sphere from outside, whole.
    pub sphere: Operations,
    /// A near one that the horizon cuts: an arc and two chords behind the transform.
    pub cut: Operations,
}

/// Laguerre's steps towards an ellipse's axis.
pub const STEPS: u64 = 3;

/// For receivers of these lobes.
///
/// # Errors
/// Where the kernel does not link.
pub fn light_operations(kinds: ReceiverKinds) -> Result<LightOperations, Error> {
    let wgsl = linked_shader(kinds, LightKinds { triangles: true, spheres: true })?.wgsl;
    let of = |function: &str| operations(&wgsl, &format!("package_{function}"), STEPS);
    let irradiance = of("_1triangle_irradiance__1signed_irradiance")?;
    let [points, edges] =
        [of("_1triangle_irradiance__1by_points")?, of("_1triangle_irradiance__1by_edges")?];
    // In the text: of the cosine, and with a specular layer of both parts of what it lets through and of the lobe.
    let [counted, taken] = if kinds.specular { [3, 2] } else { [1, 1] };
    let frame = less(of("estimator__1of_triangle")?, irradiance * counted);
    let triangle = |other| frame + less(irradiance, other) * taken;
    // Of five edges in the text four are taken: the one along the horizon replaces that between its ends.
    let edge = of("_1triangle_irradiance_edge")?;
    let all = of("estimator__1of_sphere")?;
    let (mut sphere, mut cut) = (all, all);
    if kinds.specular {
        // Neither the cosine's part nor what is inside.
        let inside = of("_1disk_irradiance__1transformed_hemisphere")? * taken;
        let all = less(all, of("_1disk_irradiance__1cap_irradiance")? + inside);
        let segment = of("_1segment_irradiance__1segment_irradiance")?;
        // Of six arcs and three pairs of chords in the text one is taken.
        let chords = of("_1segment_irradiance_level")? + of("_1triangle_irradiance_edge")?;
        let others = of("_1segment_irradiance_arc")? * 5 + chords * 2;
        let others = others + of("_1segment_irradiance__1by_points")?;
        sphere = less(all, segment * taken);
        let ellipse = of("_1disk_irradiance__1ellipse_irradiance")?;
        cut = less(all, (ellipse + others) * taken);
    }
    Ok(LightOperations {
        receiver: of("estimator_receiver")?,
        near: less(triangle(points), edge * taken),
        far: triangle(edges),
        sphere,
        cut,
    })
}

fn less(all: Operations, part: Operations) -> Operations {
    Operations { simple: all.simple - part.simple, special: all.special - part.special }
}
