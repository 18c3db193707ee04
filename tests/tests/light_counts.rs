//! What methods with virtual lights count against what they were asked for.

use manylights_hvl::Hvl;
use manylights_method::Method;
use manylights_scene::{Transport, Visibility};
use manylights_tests::Stage;
use manylights_virtual_lights::VirtualLights;
use manylights_vpl::Vpl;
use manylights_vsgl::Vsgl;
use manylights_vsl::Vsl;

const ONE_BOUNCE: Transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };

fn lights(stage: &Stage, method: &dyn Method, seed: u64) -> u64 {
    let mut run = stage.prepare(method, &[("lights", "400")], ONE_BOUNCE, seed).expect("a run");
    while !run.step().expect("a step").finished() {}
    let counters = run.counters();
    counters.iter().find(|(name, _)| *name == "lights").expect("it counts them").1
}

/// All have the same cells. A cell whose middle is dark and of which some texel is lit gives a Gaussian.
#[test]
fn all_methods_have_as_many_lights_as_asked_for() {
    for name in ["cornell", "atrium"] {
        let stage = Stage::builtin(name, [4, 4]);
        for seed in [0, 1] {
            let methods: [&dyn Method; 3] =
                [&VirtualLights(Vpl), &VirtualLights(Vsl), &VirtualLights(Hvl)];
            let [points, spheres, harmonics] = methods.map(|method| lights(&stage, method, seed));
            assert_eq!([points, points], [spheres, harmonics], "{name} {seed}");
            assert!((392..=408).contains(&points), "{name} {seed}: {points}");
            let gaussians = lights(&stage, &VirtualLights(Vsgl), seed);
            println!("{name} {seed}: {points} {gaussians}");
            assert!((points..=points * 5 / 4).contains(&gaussians), "{name} {seed}: {gaussians}");
        }
    }
}
