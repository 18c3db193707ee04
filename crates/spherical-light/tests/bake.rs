//! Tables are a bake, which nothing that was made before makes cheaper, and which a change of bands asks
//! for.

use crate::common::{DIRECT, GPU, scene};
use manylights_area_lights::AreaLights;
use manylights_gpu::GpuFrame;
use manylights_method::{Dependencies, Frame, Method, Parameters};
use manylights_spherical_light::SphericalLights;

#[test]
fn every_bake_makes_all_of_its_tables() {
    let method = AreaLights(SphericalLights);
    let baking = method.baking().expect("tables");
    let defaults = Parameters::defaults(method.parameters());
    let of_tables = Dependencies { scene: true, amount: true, ..Dependencies::default() };
    assert_eq!(baking.depends_on(&defaults), of_tables);
    let scene = scene(3);
    let (camera, resolution) = (&scene.cameras[0], [16, 12]);
    let on_gpu = GpuFrame::new(&GPU, &scene, camera, resolution).expect("the scene fits");
    let frame =
        Frame { scene: &scene, camera, resolution, transport: DIRECT, seed: 0, gpu: Some(&on_gpu) };
    let made = |coefficients: &str| {
        let settings = [("bands", "3"), ("coefficients", coefficients)];
        let parameters = Parameters::new(method.parameters(), settings).expect("in range");
        let bake = baking.bake(&frame, &parameters).expect("a bake");
        let counters = bake.counters();
        let mut run = bake.prepare(&frame, &parameters).expect("a run");
        // The run keeps what it needs.
        drop(bake);
        while !run.step().expect("a step").finished() {}
        assert_eq!(run.counters(), [("lights", 3)]);
        let passes: Vec<_> = run.pass_times().iter().map(|time| time.pass).collect();
        assert_eq!(passes, ["upload", "gather", "submit"]);
        (counters[0].1, run.resolve().expect("a picture").pixels)
    };
    let (first, picture) = made("analytic");
    // One a roughness: 0.3, 0.35 and 0.55.
    assert_eq!(first, 3);
    assert_eq!(made("tabulated").0, 4);
    assert_eq!(made("analytic"), (first, picture));
}
