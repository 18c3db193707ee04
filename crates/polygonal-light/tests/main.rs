//! All tests of the crate in one executable: each of its own links everything anew.

mod closed_form;
mod common;
mod exact;
mod forms;
mod forms_hard_cases;
mod gather;
mod hard_cases;
mod interpolated;
mod narrow;
mod operations;
mod projection;
mod scenes;
mod shaders;
mod shared;
mod truth;

#[path = "../../../tests/examples/polygon_approximations/study.rs"]
mod study;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;

#[path = "../../reflectance/examples/fit_transformed_cosines/triangles.rs"]
mod triangles;
