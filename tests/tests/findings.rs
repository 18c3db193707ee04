//! What the thesis found out about virtual lights, as far as no clock is needed (5.2.8): the rest, and
//! where we differ, stands in METHODOLOGY.md.

use manylights_hvl::Hvl;
use manylights_method::Method;
use manylights_metrics::{compare_display, compare_linear};
use manylights_scene::Visibility;
use manylights_tests::Stage;
use manylights_virtual_lights::VirtualLights;
use manylights_vpl::Vpl;
use manylights_vsl::Vsl;

/// His settings for harmonics.
const HVL: &[(&str, &str)] = &[("bands", "5"), ("emission_bands", "3")];
/// Nothing expanded that need not be.
const FINE: &[(&str, &str)] = &[("bands", "15"), ("emission_bands", "0")];
/// Samples of lobe and cone: of the lobe alone, as he takes them, they are noise on narrow cones.
const VSL: &[(&str, &str)] = &[("directions", "25"), ("sampling", "both")];

/// Method, parameters, count.
type Column<'a> = (&'a dyn Method, &'a [(&'a str, &'a str)], &'a str);

/// Of pictures with three seeds against the reference without visibility.
#[derive(Debug)]
struct Found {
    /// Of sRGB values.
    rmse: f64,
    /// 99.9th percentile of the relative error of radiance.
    spikes: f64,
}

fn find<const N: usize>(scene: &str, columns: [Column<'_>; N]) -> [Found; N] {
    let stage = Stage::builtin(scene, [64, 48]);
    let reference = stage.reference(Visibility::Ignored, 1024).image;
    columns.map(|(method, parameters, lights)| {
        let parameters = [parameters, &[("lights", lights)]].concat();
        let errors = [1, 2, 3].map(|seed| {
            let image = stage.picture(method, &parameters, Visibility::Ignored, seed);
            let display = compare_display(&image, &reference, stage.scene.exposure);
            let linear = compare_linear(&image, &reference).expect("comparable");
            (display.expect("comparable").rmse, linear.rel_p999)
        });
        let found = Found {
            rmse: (errors.iter().map(|(rmse, _)| rmse * rmse).sum::<f64>() / 3.0).sqrt(),
            spikes: errors.iter().map(|(_, spikes)| spikes).sum::<f64>() / 3.0,
        };
        println!("{scene}, {} lights={lights}: {found:.4?}", method.id());
        found
    })
}

/// Figure 5.10: the spikes of spheres are far below those of points, and samples of the whole sphere leave
/// less error than points.
#[test]
fn at_equal_count_spheres_have_lower_spikes() {
    for scene in ["trio", "cornell-glossy"] {
        let [points, harmonics, samples] = find(
            scene,
            [
                (&VirtualLights(Vpl), &[], "400"),
                (&VirtualLights(Hvl), HVL, "400"),
                (&VirtualLights(Vsl), VSL, "400"),
            ],
        );
        assert!(harmonics.spikes < 0.7 * points.spikes, "{scene}");
        assert!(samples.spikes < 0.7 * points.spikes, "{scene}");
        assert!(samples.rmse < points.rmse, "{scene}");
    }
}

/// Figure 5.11: in the long run points win, for harmonics keep the error of their bands.
#[test]
fn with_many_lights_points_win() {
    for scene in ["trio", "cornell-glossy"] {
        let [points, harmonics, fine] = find(
            scene,
            [
                (&VirtualLights(Vpl), &[], "20000"),
                (&VirtualLights(Hvl), HVL, "20000"),
                (&VirtualLights(Hvl), FINE, "20000"),
            ],
        );
        assert!(points.rmse < 0.8 * harmonics.rmse, "{scene}");
        assert!(fine.rmse < 0.9 * harmonics.rmse, "{scene}");
    }
}
