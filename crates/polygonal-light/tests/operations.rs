//! Operations of exact triangles beside those of spheres.

use crate::common::{exact, settings};
use manylights_gpu::operations;
use manylights_harmonics::wgsl::polygon;
use manylights_polygonal_light::{
    Edges, Narrow, Settings, TriangleForm, exact_operations, linked_shader, record_operations,
};
use manylights_reflectance::ReceiverKinds;

/// Simple and special operations of a light: near triangle, edge, far triangle; sphere.
fn counts(kinds: ReceiverKinds, bands: usize) -> [u64; 5] {
    let of = exact_operations(kinds, &Settings { bands, ..exact(Edges::Own) }).expect("it links");
    let sphere = Settings { bands, ..settings(TriangleForm::Sphere) };
    let sphere = linked_shader(kinds, &sphere).expect("it links").wgsl;
    let sphere = operations(&sphere, "package_estimator__1add_light", 1).expect("a function");
    [of.receiver, of.triangle, of.edge, of.far, sphere].map(|found| found.simple + found.special)
}

#[test]
fn a_triangle_takes_five_to_nine_spheres() {
    let grey = ReceiverKinds { specular: true, ..ReceiverKinds::default() };
    let kinds = [
        ("Lambertian", ReceiverKinds::default()),
        ("grey", grey),
        ("coloured", ReceiverKinds { colored: true, ..grey }),
    ];
    println!("receiver, triangle, edge, far, sphere; triangle and far over sphere");
    for (name, kinds) in kinds {
        for bands in 5..=9 {
            let found = counts(kinds, bands);
            let [_, triangle, edge, far, sphere] = found.map(|count| count as f64);
            println!(
                "{name}, {bands} bands: {found:?}; {:.1} {:.1}",
                triangle / sphere,
                far / sphere
            );
            let ratio = triangle / sphere;
            assert!((5.0..9.0).contains(&ratio), "{name}, {bands} bands: {ratio}");
            // A square's four edges, however many triangles it is cut into.
            assert!(4.0 * edge < 1.8 * triangle && far < 8.0 * sphere, "{name}, {bands} bands");
        }
    }
}

/// Wang's directions, whose integrals are summed light by light before they become coefficients, are 2n − 1 of
/// the same edges.
#[test]
fn directions_of_the_plane_of_symmetry_are_half_as_many() {
    for bands in 5..=9 {
        let of = |lobes| {
            let found = polygon::edge(bands, lobes).operations;
            (found.additions + found.multiplications) as f64
        };
        let (grey, colored) = (of(1), of(2));
        let lobe = colored - grey;
        let direction = (grey - lobe) / bands as f64;
        // Sums of n − 1 integrals for each channel instead of products with weights.
        let sums = (2 * bands - 1) as f64 * (direction + 6.0 * (bands - 1) as f64);
        println!("{bands} bands, an edge: {grey} grey, {colored} coloured, {sums:.0} by sums");
        assert!(sums > 1.8 * grey, "{bands} bands: {sums} for {grey}");
    }
}

/// Submissions are cut by what a record is said to take.
#[test]
fn records_take_what_they_are_said_to() {
    let grey = ReceiverKinds { specular: true, narrow: true, ..ReceiverKinds::default() };
    for kinds in [ReceiverKinds::default(), grey, ReceiverKinds { colored: true, ..grey }] {
        for bands in [1, 2, 5, 9, 15] {
            for narrow in [Narrow::Keep, Narrow::Transformed] {
                let main = Settings { bands, narrow, ..settings(TriangleForm::Main) };
                let exact = Settings { bands, narrow, ..exact(Edges::Own) };
                let of = |settings, function: &str| {
                    let wgsl = linked_shader(kinds, settings).expect("it links").wgsl;
                    let found = operations(&wgsl, &format!("package_{function}"), 3);
                    let found = found.expect("a function");
                    found.simple + found.special
                };
                let specular = if kinds.narrow && narrow == Narrow::Transformed {
                    of(&exact, "narrow__1narrow_product")
                } else {
                    0
                };
                let near = of(&exact, "estimator_near") + specular;
                for (settings, found) in [(main, of(&main, "estimator__1add_light")), (exact, near)]
                {
                    let said = record_operations(kinds, &settings);
                    println!("{bands} bands, {:?}: {found} of {said}", settings.approximation);
                    let ratio = found as f64 / said as f64;
                    assert!(
                        (0.6..1.6).contains(&ratio),
                        "{kinds:?} {settings:?}: {found} of {said}"
                    );
                }
            }
        }
    }
}
