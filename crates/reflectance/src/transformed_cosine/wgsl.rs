//! What kernels read.

use crate::materials::NARROW_ALPHA;

use super::{Layered, TransformedLobe, VIEWS};

/// The table that [`module`] reads beside [`SHAPES`](crate::SHAPES), of `vec4f`.
pub const TRANSFORMED_LOBES: &str = "transformed_lobes";

/// The module `transformed_cosine`:
/// - `transformed_lobe(alpha: f32, frame: Glossy) -> TransformedLobe` of a surface, from
///   [`TRANSFORMED_LOBES`];
/// - `NARROW_ALPHA: f32`: [`is_narrow`](crate::is_narrow);
/// - `LAYERED: vec4f`, `LAYERED_ALBEDO: f32`: [`Layered`].
pub fn module() -> String {
    format!(
        "{}\nconst VIEWS = {VIEWS}u;\nconst LAYERED = vec4f(1.0, 0.0, 0.0, {:?});\n\
         const LAYERED_ALBEDO = {:?};\nconst NARROW_ALPHA = {NARROW_ALPHA:?};\n",
        include_str!("../shaders/transformed_cosine.wesl"),
        Layered::FITTED.height as f32,
        Layered::ALBEDO as f32,
    )
}

/// A lobe as kernels read it.
pub(crate) fn record(lobe: &TransformedLobe) -> [[f32; 4]; 2] {
    let [[xx, xz], [zx, zz]] = [lobe.cosine.across, lobe.cosine.along];
    let [a, b] = lobe.magnitudes;
    [[xx, xz, zx, zz], [a, b, 0.0, 0.0]].map(|numbers| numbers.map(|number| number as f32))
}
