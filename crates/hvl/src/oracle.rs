//! The same estimator in f64 on the CPU, and the integral that it approximates.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::DVec3;
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_harmonics::zonal::{Cap, cap_stable, evaluate, rotate};
use manylights_harmonics::{Basis, count, even_index, index};
use manylights_scene::{DBrdf, Lobe};
use manylights_virtual_lights::VirtualSphere;

use crate::{Settings, emission, horizon};
use manylights_reflectance::lobes::LobeTable;
use manylights_reflectance::zonal::ZonalTable;
use manylights_reflectance::{Form, LobeShape, diffuse};

/// As in the shader: stands for the sine of a sphere without extent.
const SMALLEST_SINE: f64 = 1e-9;

/// Radiance from `surface` towards `camera`, summed over `lights`: the formula of the crate's head,
/// in f64, from the same f32 inputs. Negative where the expansion is.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    lights: &[VirtualSphere],
    settings: &Settings,
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let receiver = Receiver::new(surface, camera, settings);
    let sum = |sphere: &VirtualSphere| {
        let Some(seen) = Seen::new(surface, sphere, settings.emission_bands) else {
            return DVec3::ZERO;
        };
        seen.irradiance * receiver.reflected(seen.direction, seen.cap, settings)
    };
    lights.iter().map(sum).sum()
}

/// The same with ∫ f cos⁺ over the cap by quadrature, times `share`(cosine, cap): infinitely many
/// bands, no tabulation. `nodes` as in [`sphere_nodes`].
pub fn by_quadrature(
    surface: &SurfaceRecord,
    camera: DVec3,
    sphere: &VirtualSphere,
    share: impl Fn(f64, Cap<f64>) -> f64,
    nodes: usize,
) -> DVec3 {
    let Some(seen) = Seen::new(surface, sphere, 0) else { return DVec3::ZERO };
    let normal = surface.normal.as_dvec3().normalize();
    let view = (camera - surface.position.as_dvec3()).normalize();
    let brdf = DBrdf::from(surface.brdf());
    let (a, b) = seen.direction.any_orthonormal_pair();
    let reflected: DVec3 = sphere_nodes(nodes, [seen.cap.cosine, 1.0])
        .into_iter()
        .map(|([x, y, z], weight)| {
            let w = x * a + y * b + z * seen.direction;
            weight * normal.dot(w).max(0.0) * brdf.eval(normal, view, w)
        })
        .sum();
    let share = share(normal.dot(seen.direction), seen.cap);
    seen.irradiance * reflected * (share / seen.cap.sine.powi(2))
}

/// A sphere as the shaded point sees it.
struct Seen {
    direction: DVec3,
    cap: Cap<f64>,
    /// s² Φ f(ω_p, −ω) ⟨n_j·−ω⟩/(π r²), W·m⁻²·sr⁻¹: the sphere's radiance times the square of its
    /// sine, which does not grow as the radius shrinks.
    irradiance: DVec3,
}

impl Seen {
    /// `None` where nothing arrives.
    fn new(surface: &SurfaceRecord, sphere: &VirtualSphere, emission_bands: usize) -> Option<Self> {
        let light = &sphere.light;
        let offset = light.position.as_dvec3() - surface.position.as_dvec3();
        // A light at the shaded point itself has no direction.
        let direction = offset.try_normalize()?;
        let (distance, radius) = (offset.length(), f64::from(sphere.radius));
        let sine = (radius / distance).clamp(SMALLEST_SINE, 1.0);
        let cap = Cap { sine, cosine: ((1.0 - sine) * (1.0 + sine)).sqrt() };
        let emitted = light.geometric_normal.as_dvec3().normalize().dot(-direction);
        let density = FRAC_1_PI / distance.max(radius).powi(2);
        let emission = emission::reflectance(light, -direction, emission_bands);
        let irradiance = light.flux.as_dvec3() * emission * (emitted * density);
        (emitted > 0.0).then_some(Self { direction, cap, irradiance })
    }
}

/// A shaded point's reflectance in harmonics.
struct Receiver {
    /// Tangent, bitangent, normal.
    frame: [DVec3; 3],
    basis: Basis<f64>,
    brdf: DBrdf,
    /// Lambertian reflectance times the transmission towards the camera, sr⁻¹.
    lambert: DVec3,
    diffuse: Vec<f64>,
    specular: Specular,
}

enum Specular {
    None,
    /// One a coefficient of m ≥ 0.
    Full(Vec<DVec3>),
    /// Axis; (2l + 1)/4π times the scales.
    Zonal(DVec3, Vec<DVec3>),
}

impl Receiver {
    fn new(surface: &SurfaceRecord, camera: DVec3, settings: &Settings) -> Self {
        let Settings { bands, damping, .. } = *settings;
        let brdf = DBrdf::from(surface.brdf());
        let normal = surface.normal.as_dvec3().normalize();
        let view = (camera - surface.position.as_dvec3()).normalize();
        let view_n = normal.dot(view);
        let across = view - view_n * normal;
        let tangent = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let angle = view.dot(tangent).atan2(view_n);
        let colors = |row: Vec<[f64; 2]>| {
            row.into_iter()
                .map(|[a, b]| brdf.f0 * a + DVec3::splat(f64::from(brdf.lobe.f90()) * b))
                .collect()
        };
        let shape = LobeShape::from(surface.brdf());
        let full = |shape| LobeTable::of(shape, bands, damping).at(angle);
        let specular = if let Lobe::Measured(_) = brdf.lobe {
            let [red_green, blue] = shape.of_measurement().map(full);
            let color = |([r, g], [b, _]): ([f64; 2], [f64; 2])| DVec3::new(r, g, b);
            Specular::Full(red_green.into_iter().zip(blue).map(color).collect())
        } else if brdf.has_specular() {
            match settings.form {
                Form::Full => Specular::Full(colors(full(shape))),
                Form::Zonal => {
                    let ([x, z], row) = ZonalTable::of(shape, bands, damping).at(angle);
                    Specular::Zonal(x * tangent + z * normal, colors(row))
                }
            }
        } else {
            Specular::None
        };
        let [entering, fall] = diffuse::transmission(&brdf);
        let lobes = diffuse::lobes(bands, damping);
        Self {
            frame: [tangent, normal.cross(tangent), normal],
            basis: Basis::new(bands),
            lambert: brdf.diffuse * (FRAC_1_PI * brdf.transmission(view_n)),
            diffuse: lobes.into_iter().map(|[k, g]| entering * k - fall * g).collect(),
            specular,
            brdf,
        }
    }

    /// ∫ f cos⁺ H over the cap, over the square of its sine.
    fn reflected(&self, direction: DVec3, cap: Cap<f64>, settings: &Settings) -> DVec3 {
        let mut scales = vec![0.0; self.basis.bands()];
        cap_stable(cap, &mut scales);
        let local = self.frame.map(|axis| axis.dot(direction));
        let above = horizon::above(settings.horizon, local[2], cap) / cap.sine.powi(2);
        let diffuse = match settings.form {
            Form::Full => above * zonal_dot(&scales, local[2], &self.diffuse),
            Form::Zonal => {
                let entering = self.brdf.transmission(local[2].max(0.0));
                entering * horizon::irradiance(local[2], cap)
            }
        };
        let specular = match &self.specular {
            Specular::None => DVec3::ZERO,
            Specular::Full(lobe) => {
                let mut light = vec![0.0; count(scales.len())];
                rotate(&self.basis, &scales, local, &mut light);
                let orders = (0..scales.len()).flat_map(|l| (0..=l).map(move |m| (l, m)));
                let term = |(l, m)| light[index(l, m as isize)] * lobe[even_index(l, m)];
                orders.map(term).sum()
            }
            Specular::Zonal(axis, lobe) => DVec3::from_array([0, 1, 2].map(|channel| {
                let lobe: Vec<_> = lobe.iter().map(|scale| scale[channel]).collect();
                zonal_dot(&scales, axis.dot(direction), &lobe)
            })),
        };
        self.lambert * diffuse + specular * above
    }
}

/// Σ_l c_l f_l P_l(cosine), where f_l holds the (2l + 1)/4π that `evaluate` brings.
fn zonal_dot(scales: &[f64], cosine: f64, lobe: &[f64]) -> f64 {
    let weighted = |(l, (c, f)): (usize, (&f64, &f64))| c * f * 4.0 * PI / (2 * l + 1) as f64;
    let products: Vec<_> = scales.iter().zip(lobe).enumerate().map(weighted).collect();
    evaluate(&products, cosine)
}
