//! Operations of lights.

use manylights_gpu::Operations;
use manylights_ltc::{LightOperations, OPERATIONS, light_operations};
use manylights_reflectance::ReceiverKinds;

/// The crate's head has them in its table, and runs are cut by the largest.
#[test]
fn of_lights_on_every_lobe() {
    let lambertian = ReceiverKinds::default();
    let specular = ReceiverKinds { specular: true, ..lambertian };
    let colored = ReceiverKinds { colored: true, ..specular };
    let count = |of: Operations| of.simple + of.special;
    for (kinds, known) in [
        (lambertian, [70, 589, 520, 130, 130]),
        (specular, [223, 1053, 915, 922, 1792]),
        (colored, [223, 1053, 915, 922, 1792]),
    ] {
        let found = light_operations(kinds).expect("it links");
        let LightOperations { receiver, near, far, sphere, cut } = found;
        assert_eq!([receiver, near, far, sphere, cut].map(count), known, "{kinds:?}");
    }
    let dearest = count(light_operations(specular).expect("it links").near) as f64;
    assert!((dearest / OPERATIONS as f64 - 1.0).abs() < 0.2, "{dearest} for {OPERATIONS}");
}
