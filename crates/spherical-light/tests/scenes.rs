//! Scenes and transports that are declined, each in one line, and pictures of many lights.

use crate::common::{DIRECT, render, scene};
use glam::Vec3;
use manylights_method::Error;
use manylights_scene::{AreaLight, Light, Scene, Transport, Visibility};

fn refusal(scene: &Scene, texts: &[(&str, &str)], transport: Transport) -> String {
    match render(scene, [16, 12], texts, transport) {
        Err(Error::Declined(reason)) => reason,
        Err(error) => panic!("failed: {error}"),
        Ok(_) => panic!("rendered"),
    }
}

#[test]
fn what_is_not_the_methods_is_declined() {
    let plain = scene(3);
    let declined = |change: &dyn Fn(&mut Scene), transport, words: &str| {
        let mut scene = scene(3);
        change(&mut scene);
        let reason = refusal(&scene, &[], transport);
        assert!(reason.contains(words) && !reason.contains('\n'), "{reason}");
    };
    let nothing = |_: &mut Scene| {};
    let bounced = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };
    declined(&nothing, bounced, "--transport direct");
    let traced = Transport::Direct { visibility: Visibility::Traced };
    declined(&nothing, traced, "--visibility ignored");
    declined(&|scene| scene.area_lights.clear(), DIRECT, "this scene has none");
    let intensity = Vec3::ONE;
    let point = Light::Point { position: Vec3::Y, intensity };
    declined(&|scene| scene.lights.push(point), DIRECT, "lights with a surface alone");
    let corners = [Vec3::X, Vec3::Y, Vec3::Z];
    let triangle = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false };
    let words = "takes lights that are spheres; of this scene's 4 lights 1 are others";
    declined(&|scene| scene.area_lights.push(triangle), DIRECT, words);
    assert!(render(&plain, [16, 12], &[], DIRECT).is_ok());
}

/// Roughness 0.3 is wide enough, 0.29 is not, unless it is asked for; a colour without a lobe is no lobe.
#[test]
fn narrow_lobes_are_declined_unless_kept() {
    let mut scene = scene(3);
    let narrow = scene.materials.iter_mut().find(|material| material.roughness == 0.3);
    let narrow = narrow.expect("the lacquer of trio");
    narrow.roughness = 0.29;
    let name = narrow.name.clone();
    let reason = refusal(&scene, &[], DIRECT);
    assert!(reason.contains(&name) && reason.contains("narrow=keep"), "{reason}");
    render(&scene, [16, 12], &[("narrow", "keep")], DIRECT).expect("kept");
}

/// More lights than batches hold, in several submissions or one: the same bits twice.
#[test]
fn many_lights_give_the_same_bits_twice() {
    let scene = scene(1200);
    let picture = || render(&scene, [16, 12], &[], DIRECT).expect("a picture").0;
    let first = picture();
    assert!(first.pixels.as_flattened().iter().any(|value| *value > 0.0));
    assert!(first == picture());
}
