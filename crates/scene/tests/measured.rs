//! Measured reflectances: against closed forms on written files, against the networks that Sztrajman et
//! al. 2021 fitted to the same measurements, and how broken files are refused.

use crate::common;
use crate::tensor;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

use glam::DVec3;
use manylights_scene::{Brdf, DBrdf, LoadError, Measured};
use proptest::prelude::*;

fn load(name: &str, bytes: &[u8]) -> Result<Brdf, LoadError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("can write");
    Measured::load(&path).map(Measured::brdf)
}

fn polar(cos: f64, angle: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    DVec3::new(sin * angle.cos(), sin * angle.sin(), cos)
}

fn direction(lowest: f64) -> impl Strategy<Value = DVec3> {
    (lowest..0.999, 0.0..TAU).prop_map(|(cos, angle)| polar(cos, angle))
}

/// √(2θ/π) and the turn of the half vector from the viewer.
fn half_vector(v: DVec3, l: DVec3) -> [f64; 2] {
    let h = (v + l).normalize();
    let turn = (h.y.atan2(h.x) - v.y.atan2(v.x)) / TAU + 0.5;
    [(h.z.acos() / FRAC_PI_2).sqrt(), turn - turn.floor()]
}

/// Linear interpolation of a function at equidistant points, as tables hold it.
fn tabulated(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let cells = (tensor::DENSITY[0] - 1) as f64;
    let low = (x * cells).floor().min(cells - 1.0);
    let fraction = x * cells - low;
    (1.0 - fraction) * f(low / cells) + fraction * f((low + 1.0) / cells)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// With X = x − 1/2, Y = y − 1/2 a density 1 + bX + dY + eXY of b, d, e linear in θ_v integrates to
    /// 1 for each θ_v and is what the table interpolates; a factor in θ_v goes with normalisation. Its
    /// integrals, and colours that are linear in each coordinate, are known in closed form.
    #[test]
    fn interpolation_is_the_closed_form(
        v in direction(0.05),
        l in direction(0.05),
        [b, d, e] in prop::array::uniform3(-0.4_f32..0.4),
        [b_slope, d_slope, e_slope] in prop::array::uniform3(-0.2_f32..0.2),
    ) {
        let fields = tensor::material(
            |x, y, theta| {
                let (x, y) = (x - 0.5, y - 0.5);
                let [b, d, e] = [b + b_slope * theta, d + d_slope * theta, e + e_slope * theta];
                (1.0 + theta) * (1.0 + b * x + d * y + e * x * y)
            },
            |x| 2.0 - x,
            |x| 1.0 - 0.5 * x,
            |x, y, theta, c| {
                (0.2 + 0.5 * x + 0.25 * y + 0.125 * c as f32 * x * y) * (1.0 + 0.5 * theta)
            },
        );
        let brdf = DBrdf::from(load("a.bsdf", &tensor::file(&fields)).expect("valid"));
        let [x, y] = half_vector(v, l);
        let theta_v = v.z.acos();
        let [b, d, e] = [(b, b_slope), (d, d_slope), (e, e_slope)]
            .map(|(at_normal, slope)| f64::from(at_normal) + theta_v * f64::from(slope));
        // ∫₀ˣ X, and all of a row, where that vanishes at its end.
        let up_to = |x: f64| 0.5 * x * (x - 1.0);
        let row = 1.0 + d * (y - 0.5);
        let x_u = (row * x + (b + e * (y - 0.5)) * up_to(x)) / row;
        let y_u = y + d * up_to(y);
        let unit_v = (theta_v / FRAC_PI_2).sqrt();
        let scale = (2.0 - x) / (4.0 * (1.0 - 0.5 * unit_v)) / l.z * (1.0 + 0.5 * theta_v);
        let found = brdf.eval(DVec3::Z, v, l);
        for channel in 0..3 {
            let color = 0.2 + 0.5 * x_u + 0.25 * y_u + 0.125 * channel as f64 * x_u * y_u;
            // The tables are rounded to f32.
            prop_assert!((found[channel] / (scale * color) - 1.0).abs() < 1e-6, "{found}");
        }
    }

    /// Single precision: angles of h are good to 1e-7, a table changes by some of itself over a cell.
    #[test]
    fn single_precision_agrees(v in direction(0.02), l in direction(0.02)) {
        let brdf = load("satin.bsdf", &tensor::satin()).expect("valid");
        let (v, l) = (v.as_vec3(), l.as_vec3());
        let single = brdf.eval(glam::Vec3::Z, v, l).as_dvec3();
        let double = DBrdf::from(brdf).eval(DVec3::Z, v.as_dvec3(), l.as_dvec3());
        prop_assert!((single / double - 1.0).abs().max_element() < 1e-5, "{single} {double}");
    }
}

#[test]
fn distribution_and_area_are_linear_between_their_points() {
    let fields = tensor::material(
        |_, _, _| 1.0,
        |x| (3.0 * x).cos() + 2.0,
        |x| (1.0 + x * x).recip(),
        |_, _, _, _| 0.5,
    );
    let brdf = DBrdf::from(load("b.bsdf", &tensor::file(&fields)).expect("valid"));
    let (v, l) = (polar(0.6, 1.0), polar(0.3, 2.5));
    let distribution = tabulated(|x| (3.0 * x).cos() + 2.0, half_vector(v, l)[0]);
    let area = tabulated(|x| (1.0 + x * x).recip(), (v.z.acos() / FRAC_PI_2).sqrt());
    let expected = 0.5 * distribution / (4.0 * area) / l.z;
    assert!((brdf.eval(DVec3::Z, v, l).x / expected - 1.0).abs() < 1e-6);
    // Without the Jacobian the colours are the values.
    let mut fields = fields;
    fields[8].bytes = vec![0];
    let brdf = DBrdf::from(load("c.bsdf", &tensor::file(&fields)).expect("valid"));
    assert!((brdf.eval(DVec3::Z, v, l).x * l.z - 0.5).abs() < 1e-6);
}

#[test]
fn negative_colors_count_nothing() {
    let fields = tensor::material(|_, _, _| 1.0, |_| 1.0, |_| 1.0, |_, _, _, c| c as f32 - 1.0);
    let brdf = load("d.bsdf", &tensor::file(&fields)).expect("valid");
    let found = DBrdf::from(brdf).eval(DVec3::Z, polar(0.6, 1.0), polar(0.3, 2.5));
    assert!(found.x == 0.0 && found.y == 0.0 && found.z > 0.0, "{found}");
}

#[test]
fn the_same_data_is_one_table() {
    let [first, again] = [0, 1].map(|_| load("e.bsdf", &tensor::satin()).expect("valid"));
    assert_eq!(first, again);
    let other = tensor::material(|_, _, _| 1.0, |_| 1.0, |_| 0.9, |_, _, _, _| 0.1);
    assert_ne!(first, load("e.bsdf", &tensor::file(&other)).expect("valid"));
    assert_eq!(manylights_scene::Lobe::from_slot(first.lobe.slot()), first.lobe);
    assert_eq!(manylights_scene::Lobe::from_slot(first.lobe.light_slot()), first.lobe);
}

#[test]
fn broken_files_are_refused_with_a_line() {
    let refused = |name: &str, bytes: &[u8], expected: &str| {
        let line = common::check_line(&load(name, bytes).expect_err(expected));
        assert!(line.contains(expected), "{line}: not `{expected}`");
    };
    let twice = |field: &mut tensor::Field| {
        field.shape[0] = 2;
        field.bytes = field.bytes.repeat(2);
    };
    let changed = |index: usize, change: &dyn Fn(&mut tensor::Field)| {
        let mut fields =
            tensor::material(|x, _, _| 1.0 - 0.1 * x, |_| 1.0, |_| 1.0, |_, _, _, _| 0.5);
        change(&mut fields[index]);
        tensor::file(&fields)
    };
    refused("a.txt", b"", "is not a known measurement");
    refused("a.bsdf", b"", "is not that of a tensor file");
    refused("a.bsdf", b"tensor_file\0\x02\x00\0\0\0\0", "another version");
    refused("a.bsdf", b"tensor_file\0\x01\x00\xff\xff\xff\xff", "ends too soon");
    refused("a.bsdf", &changed(0, &|field| field.name = "phi"), "phi_i: is missing");
    refused("a.bsdf", &changed(0, &|field| field.shape = vec![4]), "anisotropic");
    refused("a.bsdf", &changed(0, &|field| field.name = "wavelengths"), "spectral");
    refused("a.bsdf", &changed(1, &|field| field.shape = vec![1]), "does not ascend");
    refused("a.bsdf", &changed(2, &|field| field.bytes.fill(0)), "sigma: is not positive");
    refused("a.bsdf", &changed(3, &|field| field.bytes[3] ^= 1), "depends on the azimuth");
    let negative = |field: &mut tensor::Field| field.bytes = (-1.0_f32).to_le_bytes().repeat(2 * 9);
    refused("a.bsdf", &changed(3, &negative), "ndf: is negative");
    refused("a.bsdf", &changed(3, &|field| field.kind = 11), "type 11");
    refused("a.bsdf", &changed(3, &|field| field.shape = vec![0, 9]), "ndf: is empty");
    refused("a.bsdf", &changed(4, &|field| field.bytes.fill(0)), "vndf: is zero");
    refused("a.bsdf", &changed(4, &|field| field.bytes.fill(0xff)), "vndf: is not finite");
    refused("a.bsdf", &changed(4, &|field| field.shape = vec![u64::MAX; 4]), "beyond the file");
    refused("a.bsdf", &changed(4, &|field| field.shape[2] += 1 << 40), "beyond the file");
    refused("a.bsdf", &changed(4, &|field| field.shape = vec![1; 9]), "rank 9");
    refused("a.bsdf", &changed(4, &twice), "more than one azimuth");
    refused("a.bsdf", &changed(5, &twice), "more than one azimuth");
    refused("a.bsdf", &changed(5, &|field| field.shape[1] = 2), "do not fit theta_i");
    refused("a.bsdf", &changed(8, &|field| field.shape = vec![0]), "jacobian");
    refused("a.binary", &[0; 40], "is not 90");
    let missing = Measured::load(Path::new("nowhere.bsdf")).expect_err("no file");
    assert!(common::check_line(&missing).contains("nowhere.bsdf"));
}

/// Whatever a byte becomes and wherever the file ends: a measurement or a line, never a panic.
#[test]
fn hostile_bytes_are_no_panic() {
    let whole = tensor::satin();
    // Some of the numbers too.
    let head = tensor::head_size(&tensor::satin_fields()) + 16;
    for end in (0..head).chain([whole.len() - 1]) {
        common::check_line(&load("a.bsdf", &whole[..end]).expect_err("cut"));
    }
    for place in 0..head {
        for byte in [0, 0x7f, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[place] = byte;
            if let Err(error) = load("a.bsdf", &bytes) {
                common::check_line(&error);
            }
        }
    }
}

const MERL: [usize; 3] = [90, 90, 180];

/// A file of the MERL database whose planes are functions of the three indices.
fn merl(value: impl Fn(usize, [usize; 3]) -> f64) -> Vec<u8> {
    let mut bytes: Vec<u8> = MERL.iter().flat_map(|&size| (size as u32).to_le_bytes()).collect();
    for channel in 0..3 {
        for h in 0..MERL[0] {
            for d in 0..MERL[1] {
                for p in 0..MERL[2] {
                    bytes.extend(value(channel, [h, d, p]).to_le_bytes());
                }
            }
        }
    }
    bytes
}

#[test]
fn merl_files_come_through_the_same_door() {
    // Linear in the cells' middles, so that interpolation is exact between them.
    let bytes = merl(|channel, [h, d, p]| match channel {
        0 => 1500.0 * (1.0 + h as f64 + 0.5),
        1 => 1500.0 / 1.15 * (1.0 + d as f64 + 0.5),
        _ if p < 60 => -1.0,
        _ => 1500.0 / 1.66 * (1.0 + p as f64 + 0.5),
    });
    let brdf = load("a.binary", &bytes).expect("valid");
    let (mut checked, mut unmeasured) = (0, 0);
    for step in 0..400 {
        let step = f64::from(step);
        let v = polar(0.1 + 0.8 * (0.618 * step % 1.0), 1.7 * step);
        let l = polar(0.1 + 0.8 * (0.414 * step % 1.0), 0.9 * step);
        let h = (v + l).normalize();
        let [theta_h, theta_d] = [h.z.acos(), v.dot(h).acos()];
        let [across, down] =
            [DVec3::Z.cross(h).normalize(), DVec3::Z.cross(h).normalize().cross(h)];
        let phi_d = v.dot(across).atan2(v.dot(down)).rem_euclid(PI);
        let cells =
            [90.0 * (theta_h / FRAC_PI_2).sqrt(), 90.0 * theta_d / FRAC_PI_2, 180.0 * phi_d / PI];
        let found = DBrdf::from(brdf).eval(DVec3::Z, v, l);
        let back = DBrdf::from(brdf).eval(DVec3::Z, l, v);
        assert!(found.abs_diff_eq(back, 1e-9 * found.max_element()), "{found} {back}");
        let ends = [89.5, 89.5, 179.5];
        if std::iter::zip(cells, ends).any(|(cell, end)| !(0.5..end).contains(&cell)) {
            continue;
        }
        checked += 1;
        assert!((found.x - 1.0 - cells[0]).abs() < 2e-5, "{found} {cells:?}");
        assert!((found.y - 1.0 - cells[1]).abs() < 2e-5, "{found} {cells:?}");
        if cells[2] < 59.5 {
            unmeasured += 1;
            assert_eq!(found.z, 0.0);
        } else if cells[2] > 60.5 {
            assert!((found.z - 1.0 - cells[2]).abs() < 2e-5, "{found} {cells:?}");
            let single = brdf.eval(glam::Vec3::Z, v.as_vec3(), l.as_vec3()).as_dvec3();
            // Angles are good to 1e-7, of 180 cells.
            assert!(single.abs_diff_eq(found, 1e-4), "{single} {found}");
        }
    }
    assert!(checked > 300 && unmeasured > 10, "{checked} {unmeasured}");

    let cut = load("b.binary", &bytes[..bytes.len() - 8]).expect_err("cut");
    assert!(common::check_line(&cut).contains("are not 4374000 numbers"));
    let mut broken = bytes;
    let end = broken.len();
    broken[end - 8..].copy_from_slice(&f64::NAN.to_le_bytes());
    assert!(common::check_line(&load("c.binary", &broken).expect_err("NaN")).contains("finite"));
}

/// The network of one material (Sztrajman et al. 2021): half and difference vector to RGB.
struct Network(Vec<f32>);

impl Network {
    fn read(name: &str) -> Self {
        let folder = common::assets().join("brdf/nbrdf");
        let names = std::fs::read_to_string(folder.join("rgl_isotropic.names.txt")).expect("names");
        let index = names.lines().position(|line| line == name).expect("a network");
        let bytes = std::fs::read(folder.join("rgl_isotropic.nbrdf.f32")).expect("weights");
        let weights = bytes[index * 2700..][..2700].as_chunks().0;
        Self(weights.iter().copied().map(f32::from_le_bytes).collect())
    }

    fn eval(&self, v: DVec3, l: DVec3) -> DVec3 {
        let h = (v + l).normalize();
        let along = glam::DVec2::new(h.x, h.y).normalize_or(glam::DVec2::X);
        // l in the frame of h whose azimuth is 0.
        let forward = along.dot(l.truncate());
        let sine = h.truncate().length();
        let d = DVec3::new(
            h.z * forward - sine * l.z,
            along.perp_dot(l.truncate()),
            sine * forward + h.z * l.z,
        );
        let inputs = [sine, 0.0, h.z, d.x, d.y, d.z];
        let mut weights = &self.0[..];
        let mut layer = |inputs: &[f64], outputs: usize| -> Vec<f64> {
            let (matrix, rest) = weights.split_at(inputs.len() * outputs);
            let (bias, rest) = rest.split_at(outputs);
            weights = rest;
            let output = |j: usize| {
                let terms = inputs.iter().enumerate();
                let sum: f64 = terms.map(|(i, x)| x * f64::from(matrix[i * outputs + j])).sum();
                sum + f64::from(bias[j])
            };
            (0..outputs).map(output).collect()
        };
        let relu = |values: Vec<f64>| values.into_iter().map(|x| x.max(0.0)).collect::<Vec<_>>();
        let hidden = relu(layer(&inputs, 21));
        let hidden = relu(layer(&hidden, 21));
        let output = layer(&hidden, 3);
        DVec3::new(output[0].exp() - 1.0, output[1].exp() - 1.0, output[2].exp() - 1.0)
    }
}

fn albedo(v: DVec3, f: impl Fn(DVec3, DVec3) -> DVec3) -> DVec3 {
    const STEPS: usize = 64;
    let mut sum = DVec3::ZERO;
    for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
        let middle = |index: usize| (index as f64 + 0.5) / STEPS as f64;
        sum += f(v, polar(middle(i).sqrt(), TAU * middle(j)));
    }
    sum * PI / (STEPS * STEPS) as f64
}

/// Networks and measurements of rough materials reflect the same light within 2 %; less well at normal
/// incidence, where few of the directions that a network was fitted to lie.
#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn real_measurements_reflect_what_their_networks_do() {
    for name in ["paper_white_rgb", "colodur_napoli_4f_rgb", "satin_rosaline_rgb"] {
        let path = common::assets().join(format!("brdf/rgl/{name}.bsdf"));
        let brdf = DBrdf::from(Measured::load(&path).expect("a measurement").brdf());
        let network = Network::read(name);
        for (degrees, bound) in [(0.5_f64, 0.035), (30.0, 0.02), (45.0, 0.02), (60.0, 0.02)] {
            let v = polar(degrees.to_radians().cos(), 0.3);
            let measured = albedo(v, |v, l| brdf.eval(DVec3::Z, v, l));
            let fitted = albedo(v, |v, l| network.eval(v, l));
            println!("{name} {degrees}: {measured:.4} {fitted:.4}");
            assert!((measured / fitted - 1.0).abs().max_element() < bound, "{name} {degrees}");
        }
    }
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn all_real_measurements_load() {
    let folder = common::assets().join("brdf/rgl");
    let (mut count, mut largest) = (0, 0.0_f64);
    for entry in folder.read_dir().expect("a folder") {
        let path = entry.expect("a file").path();
        let brdf = Measured::load(&path).unwrap_or_else(|error| panic!("{error}")).brdf();
        println!("{}: {brdf:?}", path.display());
        for cos in [0.05, 0.5, 0.99] {
            let v = polar(cos, 0.3);
            let albedo = albedo(v, |v, l| DBrdf::from(brdf).eval(DVec3::Z, v, l));
            assert!(albedo.is_finite() && albedo.min_element() >= 0.0, "{albedo}");
            println!("{cos}: {albedo:.4}");
            largest = largest.max(albedo.max_element());
        }
        count += 1;
    }
    assert_eq!(count, 7);
    println!("largest albedo {largest:.4}");
    assert!(largest < 1.0);
}
