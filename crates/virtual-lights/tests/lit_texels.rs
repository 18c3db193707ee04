//! The adapter's texels against the virtual lights that the processor makes of the same cells.

use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_virtual_lights::{LitTexel, lit_maps, lit_texels, scene_maps};

#[test]
fn texels_are_the_virtual_lights_of_their_cells() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    // A spot, a cube of six maps, a directional light; interpolated normals.
    for name in ["cornell-glossy", "integrating-sphere", "atrium", "trio"] {
        let scene = manylights_scene::load(name, None).expect("built in");
        let frame = GpuFrame::new(&gpu, &scene, &scene.cameras[0], [4, 4]).expect("fits");
        for (count, seed) in [(1, 0), (500, 0), (500, 3)] {
            let maps = scene_maps(&frame, &scene, count, seed).expect("maps");
            let (maps, _) = lit_maps(&frame, &scene, &maps).expect("maps");
            for lit in maps {
                let (map, _) = lit_texels(&frame, &lit.map).expect("texels");
                let texels: Vec<LitTexel> = gpu.read(&map.texels).expect("read-back");
                let surfaces: Vec<SurfaceRecord> = gpu.read(&map.surfaces).expect("read-back");
                assert_eq!(texels.len(), lit.lights.len());
                let fluxes = lit.lights.iter().flatten().map(|light| light.flux.length());
                let largest = fluxes.fold(0.0, f32::max);
                for ((texel, surface), light) in texels.iter().zip(&surfaces).zip(&lit.lights) {
                    let Some(light) = light else {
                        assert_eq!(texel.flux.max_element(), 0.0, "{name}");
                        continue;
                    };
                    let close = |a: glam::Vec3, b: glam::Vec3| (a - b).length() < 2e-6 * b.length();
                    // The quotient of the cosines loses digits at the horizon, the rim of a spot the
                    // difference of cosines.
                    let cosine = light.geometric_normal.dot(light.incoming);
                    let bound = (5e-6 + 1e-6 / cosine) * light.flux.length() + 5e-6 * largest;
                    assert!(
                        (texel.flux - light.flux).length() < bound,
                        "{name} {texel:?} {light:?}"
                    );
                    assert!(close(texel.incoming, light.incoming), "{name}");
                    assert!(close(texel.geometric_normal, light.geometric_normal), "{name}");
                    assert_eq!(surface.position, light.position, "{name}");
                }
            }
        }
    }
}

/// E_s ΔA = Φ cos_s/cos_g where normals are interpolated (Veach 1997, 5.3): of the lights, and by the test
/// above of the texels.
#[test]
fn flux_is_that_of_the_cell_times_the_quotient_of_its_cosines() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let scene = manylights_scene::load("trio", None).expect("built in");
    let frame = GpuFrame::new(&gpu, &scene, &scene.cameras[0], [4, 4]).expect("fits");
    let maps = scene_maps(&frame, &scene, 2000, 3).expect("maps");
    let (maps, _) = lit_maps(&frame, &scene, &maps).expect("maps");
    let mut farthest: f32 = 1.0;
    for lit in maps {
        let columns = lit.map.projection.resolution[0];
        for (index, light) in (0..).zip(&lit.lights) {
            let Some(light) = light else { continue };
            let cell = lit.map.cell(index % columns, index / columns);
            assert_eq!(light.incoming, -cell.direction);
            let quotient =
                light.normal.dot(light.incoming) / light.geometric_normal.dot(light.incoming);
            let error = (light.flux - cell.flux * quotient).abs().max_element();
            assert!(error <= 1e-6 * light.flux.max_element(), "{light:?}, {cell:?}");
            farthest = farthest.max(quotient.max(1.0 / quotient));
        }
    }
    assert!(farthest > 1.2, "a weak test: the quotients are within {farthest}");
}

/// Cells that are cut finer see the same flux, and their patches cover the same surface.
#[test]
fn refined_cells_add_up() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let scene = manylights_scene::load("integrating-sphere", None).expect("built in");
    let frame = GpuFrame::new(&gpu, &scene, &scene.cameras[0], [4, 4]).expect("fits");
    let sums = |side: u32| {
        let mut sums = [0.0_f64; 2];
        for map in scene_maps(&frame, &scene, 600, 0).expect("maps") {
            let (map, _) = lit_texels(&frame, &map.refined(side)).expect("texels");
            let texels: Vec<LitTexel> = gpu.read(&map.texels).expect("read-back");
            for texel in texels {
                sums[0] += f64::from(texel.flux.x);
                // Facets nearly face the light at the centre: a patch's area is 12 variances.
                sums[1] += 12.0 * f64::from(texel.variance);
            }
        }
        sums
    };
    use manylights_scene::builtin::integrating_sphere::{INTENSITY, RADIUS};
    let sphere = 4.0 * std::f64::consts::PI;
    let expected = [sphere * f64::from(INTENSITY), sphere * f64::from(RADIUS).powi(2)];
    for side in [1, 3] {
        let [flux, area] = sums(side);
        // Interpolated normals on facets: the quotient of the two cosines.
        assert!((flux / expected[0] - 1.0).abs() < 2e-4, "{flux}");
        // The facets lie inside the sphere, by 0.1 % of its radius.
        assert!((area / expected[1] - 1.0).abs() < 3e-3, "{area}");
    }
}
