//! WESL modules with the irradiance of lights in closed form.

/// For linearly transformed cosines, a kernel's modules
/// - `triangle_irradiance`: `above_horizon(corner, first, second) -> Above` of a triangle and
///   `signed_irradiance(m: vec4f, above: Above) -> f32` through a transform;
/// - `disk_irradiance`: `cap_irradiance(cosine, sine) -> f32` of a sphere as it is, and
///   `transformed_cap(m: vec4f, w: vec3f, sine: f32) -> f32` through a transform;
/// - `segment_irradiance`, `cone`: what it needs of cones;
/// - `arc_tangent`: to 2e-7;
/// - `seven_points`: `rule_point(i) -> vec4f` of means over triangles, barycentric coordinates and a weight.
pub const IRRADIANCE: [(&str, &str); 6] = [
    ("triangle_irradiance", include_str!("shaders/triangle_irradiance.wesl")),
    ("disk_irradiance", include_str!("shaders/disk_irradiance.wesl")),
    ("segment_irradiance", include_str!("shaders/segment_irradiance.wesl")),
    ("cone", include_str!("shaders/cone.wesl")),
    ("arc_tangent", include_str!("shaders/arc_tangent.wesl")),
    ("seven_points", include_str!("shaders/seven_points.wesl")),
];
