//! Tables of reflectances are a bake, which nothing that was made before makes cheaper.

use crate::common::GPU;
use manylights_gpu::GpuFrame;
use manylights_hvl::Hvl;
use manylights_method::{Frame, Method, Parameters};
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::VirtualLights;

#[test]
fn every_bake_makes_all_of_its_tables() {
    let method = VirtualLights(Hvl);
    let baking = method.baking().expect("tables");
    let scene = manylights_scene::load("trio", None).expect("built in");
    let (camera, resolution) = (&scene.cameras[0], [16, 12]);
    let on_gpu = GpuFrame::new(&GPU, &scene, camera, resolution).expect("the scene fits");
    let transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };
    let gpu = Some(&on_gpu);
    let frame = Frame { scene: &scene, camera, resolution, transport, seed: 0, gpu };
    let made = |bands: &str| {
        let settings = [("bands", bands), ("emission_bands", "2")];
        let parameters = Parameters::new(method.parameters(), settings).expect("in range");
        let bake = baking.bake(&frame, &parameters).expect("a bake");
        let counters = bake.counters();
        assert_eq!(counters[0].0, "tables");
        let mut run = bake.prepare(&frame, &parameters).expect("a run");
        // The run keeps what it needs.
        drop(bake);
        while !run.step().expect("a step").finished() {}
        (counters[0].1, run.resolve().expect("a picture"))
    };
    let (first, picture) = made("3");
    // A receiver's and a light's for each of three roughnesses.
    assert!(first >= 2 && first % 2 == 0, "{first}");
    assert_eq!(made("4").0, first, "the emission of the first must not be there already");
    let (again, same) = made("3");
    assert_eq!((again, same.pixels), (first, picture.pixels));
}
