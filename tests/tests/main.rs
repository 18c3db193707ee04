//! All tests that span crates in one executable: each of its own links everything anew.

mod area_lights;
mod check_experiment;
mod conformance;
mod contact_shadows;
mod convergence;
#[cfg(unix)] // it is a bash script
mod documents;
mod dummy_method;
mod findings;
mod grid_orders;
mod harmonics_wgsl;
mod import_circles;
mod integrating_sphere;
mod invariants;
mod light_counts;
mod limits;
mod results_age;
mod single_lights;
mod spheres_agree;
mod versions;
mod visibility;
