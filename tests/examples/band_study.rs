//! How many bands of spherical harmonics capture a material (the study of thesis appendix B): for
//! f(v, ·) n·l of each preset and of each measurement among the assets, written to
//! `results/bands/bands.md`. Run with
//! `MANYLIGHTS_ASSETS=… cargo run -p manylights-tests --example band_study`.
//!
//! The energy is ∫ f² cos² over the hemisphere, summed over red, green and blue; n bands capture the sum
//! of their squared coefficients. Directions lie on Gauss–Legendre rings, equidistant on each ring; a
//! reflectance that does not depend on the side of the plane of incidence has coefficients with m ≥ 0
//! alone, and they are sums over rings of the rings' cosine transforms. Of measurements, which are not
//! quite alike on both sides, one side is taken for both.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::DVec3;
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_harmonics::{Basis, index};
use manylights_scene::presets::PRESETS;
use manylights_scene::{DBrdf, Measured};

const BANDS: usize = 100;
/// Rings over the hemisphere, and directions on half of one: lobes of α = 0.02 are ten of them wide.
const RINGS: usize = 320;
const HALF_RING: usize = 320;
const TARGETS: [f64; 7] = [0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95];

/// What does not depend on the material.
struct Study {
    rings: Vec<Ring>,
    /// cos(m φ_k), m-major.
    cosines: Vec<f64>,
}

struct Ring {
    z: f64,
    /// Of each of its directions.
    weight: f64,
    /// Y_lm at φ = 0.
    values: Vec<f64>,
}

impl Study {
    fn new() -> Self {
        let basis = Basis::new(BANDS);
        let rings = gauss_legendre(RINGS).into_iter().map(|(node, weight)| {
            let z = 0.5 + 0.5 * node;
            let mut values = vec![0.0; BANDS * BANDS];
            basis.evaluate([((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z], &mut values);
            // Both halves of the ring count.
            Ring { z, weight: 0.5 * weight * TAU / HALF_RING as f64, values }
        });
        let angles = |m: usize| (0..HALF_RING).map(move |k| (m as f64 * azimuth(k)).cos());
        Self { rings: rings.collect(), cosines: (0..BANDS).flat_map(angles).collect() }
    }

    /// Energies of each band, and of the whole function, of f(v, ·) n·l for v at θ_o.
    fn energies(&self, brdf: &DBrdf, theta: f64) -> (Vec<f64>, f64) {
        let v = DVec3::new(theta.sin(), 0.0, theta.cos());
        let mut coefficients = vec![DVec3::ZERO; BANDS * BANDS];
        let mut whole = 0.0;
        for ring in &self.rings {
            let sine = ((1.0 - ring.z) * (1.0 + ring.z)).sqrt();
            let values: Vec<DVec3> = (0..HALF_RING)
                .map(|k| {
                    let (s, c) = azimuth(k).sin_cos();
                    brdf.eval(DVec3::Z, v, DVec3::new(sine * c, sine * s, ring.z)) * ring.z
                })
                .collect();
            whole += ring.weight * values.iter().map(|value| value.length_squared()).sum::<f64>();
            for (m, cosines) in self.cosines.chunks_exact(HALF_RING).enumerate() {
                let pairs = values.iter().zip(cosines);
                let moment: DVec3 = pairs.map(|(&value, &cosine)| value * cosine).sum();
                for l in m..BANDS {
                    let at = index(l, m as isize);
                    coefficients[at] += ring.weight * ring.values[at] * moment;
                }
            }
        }
        let band = |l: usize| {
            let of = |m| coefficients[index(l, m as isize)].length_squared();
            (0..=l).map(of).sum::<f64>()
        };
        ((0..BANDS).map(band).collect(), whole)
    }

    /// A table: a row for each θ_o, a column for each share of the energy.
    fn table(&self, name: &str, brdf: &DBrdf) -> String {
        let mut text = format!("\n## {name}\n\n| θ_o |");
        for target in TARGETS {
            write!(text, " {:.0} % |", 100.0 * target).expect("writing to a string");
        }
        text.push_str("\n|---|");
        text.push_str(&"---|".repeat(TARGETS.len()));
        for degrees in (0..=80).step_by(10) {
            let (bands, whole) = self.energies(brdf, f64::from(degrees).to_radians());
            let captured: f64 = bands.iter().sum();
            assert!(captured < 1.001 * whole, "{name} {degrees}: more than all is captured");
            write!(text, "\n| {degrees}° |").expect("writing to a string");
            for target in TARGETS {
                let mut sum = 0.0;
                let enough = bands.iter().position(|energy| {
                    sum += energy;
                    sum >= target * whole
                });
                let count = enough.map_or(format!(">{}", BANDS - 1), |l| (l + 1).to_string());
                write!(text, " {count} |").expect("writing to a string");
            }
        }
        text.push('\n');
        text
    }
}

fn azimuth(index: usize) -> f64 {
    PI * (index as f64 + 0.5) / HALF_RING as f64
}

/// A Lambertian surface has the energies of the clamped cosine in closed form: π/4 and π/3 of 2π/3.
fn check(study: &Study) {
    let (bands, whole) = study.energies(&DBrdf::lambert(DVec3::splat(PI)), 0.5);
    let expected = [PI / 4.0, PI / 3.0, 5.0 * PI / 64.0, 0.0].map(|energy| 3.0 * energy);
    assert!((whole - TAU).abs() < 1e-9, "{whole}");
    for (found, expected) in bands.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

fn measurements(assets: &Path) -> Vec<PathBuf> {
    let files = assets.join("brdf/rgl").read_dir().expect("the assets have brdf/rgl");
    let mut paths: Vec<_> = files.map(|entry| entry.expect("can be read").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "bsdf"));
    paths.sort();
    paths
}

fn main() {
    let study = Study::new();
    check(&study);
    let mut text = "# Bands that capture a material\n\n\
         `cargo run -p manylights-tests --example band_study` (deterministic).\n\n\
         The study of thesis appendix B for the materials at hand: bands of spherical harmonics whose \
         squared coefficients sum up to a share of ∫ f(v, l)² (n·l)² dl, v at θ_o from the normal. \
         The thesis prints one table, that of the measured nickel of MERL, which is none of these; at \
         θ_o = 40° it needs 13, 16, 19, 24, 27, 31, 39 bands.\n"
        .to_owned();
    text.push_str("\n# Presets: fits of MERL materials, α ≥ 0.02\n");
    for preset in &PRESETS {
        eprintln!("{}", preset.name);
        text += &study.table(preset.name, &preset.brdf().into());
    }
    if let Some(assets) = std::env::var_os("MANYLIGHTS_ASSETS") {
        text.push_str("\n# Measurements of RGL\n");
        for path in measurements(Path::new(&assets)) {
            let name = path.file_stem().expect("a file").to_string_lossy().into_owned();
            eprintln!("{name}");
            let measured = Measured::load(&path).unwrap_or_else(|error| panic!("{error}"));
            text += &study.table(&name, &measured.brdf().into());
        }
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../results/bands");
    std::fs::create_dir_all(&folder).expect("can make the folder");
    std::fs::write(folder.join("bands.md"), text).expect("can write the table");
}
