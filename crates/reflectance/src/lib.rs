//! Reflectance on spherical harmonics: the cosine-weighted lobes of surfaces, tabulated over the view's
//! angle, and the WGSL that fetches them. Knows no adapter: shaders are text.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod cache;
mod damping;
pub mod diffuse;
mod expansion;
mod half_vectors;
mod lobe_quadrature;
mod lobe_shape;
pub mod lobe_wgsl;
pub mod lobes;
mod materials;
pub mod mirror;
mod product;
pub mod product_oracle;
mod product_wgsl;
mod receiver;
mod tables;
pub mod transformed_cosine;
pub mod zonal;

/// Of the tables' coefficients: raised whenever the same lobe and number of bands give other ones.
pub const TABLES_VERSION: u32 = 1;

pub use cache::Cache;
pub use expansion::{Damping, Form};
pub use lobe_quadrature::{Fixed, LobeQuadrature};
pub use lobe_shape::LobeShape;
pub use lobe_wgsl::LOBES;
pub use materials::{Materials, NARROW, ReceiverKinds, is_narrow, single};
pub use product::{CosineProduct, Diffuse};
pub use receiver::Receiver;
pub use tables::Tables;

/// The table of shapes that the module `receiver` of [`MODULES`] reads, of `vec2f`, as it imports it from
/// `package::bindings`.
pub const SHAPES: &str = "shapes";

/// WESL modules with the switches of [`ReceiverKinds::features`]:
/// - `receiver`: a pixel's reflectance as gathers keep it. It imports the modules that
///   [`lobe_wgsl::module`] and [`diffuse::module`] make, and the tables [`SHAPES`] and [`LOBES`];
/// - `reflection`: its products with a cap of light;
/// - `product`: with any light that is multiplied with the cosine first. It imports what
///   [`CosineProduct::modules`] makes;
/// - `shape_number`: where a lobe stands in [`SHAPES`];
/// - `arc_sine`: to 1e-7.
pub const MODULES: [(&str, &str); 5] = [
    ("receiver", include_str!("shaders/receiver.wesl")),
    ("reflection", include_str!("shaders/reflection.wesl")),
    ("product", include_str!("shaders/product.wesl")),
    ("shape_number", include_str!("shaders/shape_number.wesl")),
    ("arc_sine", include_str!("shaders/arc_sine.wesl")),
];
