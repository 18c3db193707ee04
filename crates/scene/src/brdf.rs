//! The one reflectance model: a Lambertian lobe under an isotropic GGX lobe.
//!
//! f(v, l) = diffuse/π · T(n·l) T(n·v)  +  F(v·h) D(h) V(v, l)
//!
//! with D of Walter et al. 2007, the height-correlated Smith term V = G/(4 n·l n·v) of Heitz 2014, and
//! one of two Fresnel terms ([`Lobe`]):
//!
//! - Schlick's F(c) = f0 + (f90 − f0)(1 − c)⁵, with T = 1 − F: glTF's materials;
//! - f0 times the exact unpolarised reflectance of a dielectric over its value at normal incidence,
//!   with T = 1: fitted materials, f0 = ks ((n − 1)/(n + 1))².
//!
//! [`Lobe::Measured`] puts a table ([`crate::measured`]) in the place of both lobes.
//!
//! Deviation from the glTF 2.0 sample implementation, which couples the lobes by 1 − F(v·h): that
//! reflects up to 1.95 times the incident energy at grazing view. The product of the two transmissions
//! (Shirley et al. 1997, without their normalisation) is reciprocal and loses energy instead.
//!
//! The text exists once and is compiled in f32 ([`Brdf`]) and f64 ([`DBrdf`], the oracle).

use crate::measured::Estimate;
use crate::{Lobe, Measured};

macro_rules! brdf {
    ($name:ident, $real:ident, $vec3:ident, $doc:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            /// Albedo of the Lambertian lobe, in [0, 1].
            pub diffuse: glam::$vec3,
            /// Specular reflectance at normal incidence.
            pub f0: glam::$vec3,
            /// What the specular lobe is.
            pub lobe: Lobe,
            /// GGX width α = roughness².
            pub alpha: $real,
        }

        impl $name {
            /// A Lambertian surface.
            pub fn lambert(diffuse: glam::$vec3) -> Self {
                Self { diffuse, f0: glam::$vec3::ZERO, lobe: Lobe::NONE, alpha: 1.0 }
            }

            /// Whether there is a specular lobe.
            #[inline]
            pub fn has_specular(&self) -> bool {
                self.lobe != Lobe::NONE || self.f0 != glam::$vec3::ZERO
            }

            /// Fresnel reflectance for the cosine `cos` between direction and (micro-)normal; that of
            /// the sampled lobe for a measurement.
            pub fn fresnel(&self, cos: $real) -> glam::$vec3 {
                match self.lobe {
                    Lobe::Schlick { f90 } => {
                        let grazing = (1.0 - cos).clamp(0.0, 1.0).powi(5);
                        self.f0 + (glam::$vec3::splat(f90.into()) - self.f0) * grazing
                    }
                    Lobe::Dielectric { index } => {
                        self.f0 * Self::relative_fresnel(index.into(), cos)
                    }
                    Lobe::Measured(_) => self.f0,
                }
            }

            /// Exact unpolarised Fresnel reflectance of a dielectric of real index n, over its value
            /// ((n − 1)/(n + 1))² at normal incidence; `cos` c from 0.
            ///
            /// With g² = n² − 1 + c² the amplitudes are (g − c)/(g + c) and (n²c − g)/(n²c + g). Both
            /// differences cancel for n → 1; multiplied out they are (n² − 1)/(g + c)² and
            /// (n² − 1)((n² + 1)c² − 1)/(n²c + g)², and n² − 1 cancels against the value at normal
            /// incidence.
            pub fn relative_fresnel(index: $real, cos: $real) -> $real {
                let cos2 = cos * cos;
                let n2 = index * index;
                let g = ((index - 1.0) * (index + 1.0) + cos2).sqrt();
                let across = (index + 1.0) / (g + cos);
                let along = (index + 1.0) / (n2 * cos + g);
                let brewster = (n2 + 1.0) * cos2 - 1.0;
                0.5 * (across.powi(4) + brewster * brewster * along.powi(4))
            }

            /// T: the share of the light that enters the layer of the Lambertian lobe; none for a
            /// measurement, which holds it all.
            pub fn transmission(&self, cos: $real) -> $real {
                match self.lobe {
                    Lobe::Schlick { .. } => 1.0 - self.fresnel(cos.max(0.0)).max_element(),
                    Lobe::Dielectric { .. } => 1.0,
                    Lobe::Measured(_) => 0.0,
                }
            }

            /// Share of the specular lobe in what is reflected towards a view at the cosine `n_v`, as
            /// its Fresnel reflectance estimates it: the probability to sample it. Zero for views
            /// below the horizon.
            pub fn specular_share(&self, n_v: $real) -> $real {
                if n_v <= 0.0 {
                    return 0.0;
                }
                let specular = self.fresnel(n_v).max_element();
                let entering = match self.lobe {
                    Lobe::Measured(_) => 1.0,
                    _ => self.transmission(n_v),
                };
                let diffuse = self.diffuse.max_element() * entering;
                if specular > 0.0 { specular / (specular + diffuse) } else { 0.0 }
            }

            /// f(v, l) in sr⁻¹, without the cosine. All directions are unit and point away from the
            /// surface. Zero for `l` below the horizon of `normal`; only the specular lobe vanishes
            /// for `v` below it: which side is visible is the geometric normal's business.
            #[inline]
            pub fn eval(&self, normal: glam::$vec3, v: glam::$vec3, l: glam::$vec3) -> glam::$vec3 {
                let n_l = normal.dot(l);
                let n_v = normal.dot(v);
                if n_l <= 0.0 {
                    return glam::$vec3::ZERO;
                }
                let lambert = self.diffuse * std::$real::consts::FRAC_1_PI;
                if !self.has_specular() {
                    return lambert;
                }
                let coupling = self.transmission(n_l) * self.transmission(n_v);
                lambert * coupling + self.specular(normal, v, l)
            }

            /// The GGX lobe alone, sr⁻¹; all of a measurement.
            pub fn specular(
                &self,
                normal: glam::$vec3,
                v: glam::$vec3,
                l: glam::$vec3,
            ) -> glam::$vec3 {
                let n_l = normal.dot(l);
                let n_v = normal.dot(v);
                if n_l <= 0.0 || n_v <= 0.0 || !self.has_specular() {
                    return glam::$vec3::ZERO;
                }
                if let Lobe::Measured(measured) = self.lobe {
                    return Self::measured(measured, normal, v, l) / n_l;
                }
                let Some(h) = (v + l).try_normalize() else { return glam::$vec3::ZERO };
                self.fresnel(v.dot(h)) * (self.distribution(normal, h) * self.visibility(n_v, n_l))
            }

            /// f(v, l) n·l of a measurement, in the frame that it is tabulated in.
            fn measured(
                measured: Measured,
                normal: glam::$vec3,
                v: glam::$vec3,
                l: glam::$vec3,
            ) -> glam::$vec3 {
                let n_v = normal.dot(v);
                let tangent = (v - n_v * normal)
                    .try_normalize()
                    .unwrap_or_else(|| normal.any_orthonormal_vector());
                let local =
                    |d: glam::$vec3| [tangent.dot(d), normal.cross(tangent).dot(d), normal.dot(d)];
                measured.eval([tangent.dot(v), 0.0, n_v], local(l)).into()
            }

            /// GGX distribution of micro-normals D(h), sr⁻¹.
            ///
            /// The denominator (n·h)²(α² − 1) + 1 cancels for small α near the peak; sin² from the
            /// cross product keeps all digits: α² cos² + sin².
            pub fn distribution(&self, normal: glam::$vec3, h: glam::$vec3) -> $real {
                let a2 = self.alpha * self.alpha;
                let cos = normal.dot(h);
                let denominator = a2 * cos * cos + normal.cross(h).length_squared();
                a2 / (std::$real::consts::PI * denominator * denominator)
            }

            /// Height-correlated Smith shadowing and masking over 4 n·l n·v.
            pub fn visibility(&self, n_v: $real, n_l: $real) -> $real {
                let a2 = self.alpha * self.alpha;
                let lambda_v = n_l * (a2 + (1.0 - a2) * n_v * n_v).sqrt();
                let lambda_l = n_v * (a2 + (1.0 - a2) * n_l * n_l).sqrt();
                0.5 / (lambda_v + lambda_l)
            }
        }
    };
}

brdf!(Brdf, f32, Vec3, "Reflectance at a point, single precision.");
brdf!(
    DBrdf,
    f64,
    DVec3,
    "Reflectance at a point, double precision: the oracle of the f32 and WGSL forms."
);

impl From<Brdf> for DBrdf {
    fn from(brdf: Brdf) -> Self {
        Self {
            diffuse: brdf.diffuse.as_dvec3(),
            f0: brdf.f0.as_dvec3(),
            lobe: brdf.lobe,
            alpha: brdf.alpha.into(),
        }
    }
}

impl Measured {
    /// The reflectance. `alpha`, `f0` and `diffuse` are those of a GGX and a Lambertian lobe that
    /// share out its albedo: what samplers follow; [`Brdf::eval`] reads the table.
    pub fn brdf(self) -> Brdf {
        let Estimate { diffuse, f0, alpha } = self.estimate();
        Brdf { diffuse, f0, alpha, lobe: Lobe::Measured(self) }
    }
}
