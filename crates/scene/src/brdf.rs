//! The one reflectance model: a Lambertian lobe under an isotropic GGX lobe with Schlick's Fresnel.
//!
//! f(v, l) = diffuse/π · (1 − F(n·l)) (1 − F(n·v))  +  F(v·h) D(h) V(v, l)
//!
//! with D of Walter et al. 2007, the height-correlated Smith term V = G/(4 n·l n·v) of Heitz 2014,
//! F(c) = f0 + (f90 − f0)(1 − c)⁵.
//!
//! Deviation from the glTF 2.0 sample implementation, which couples the lobes by 1 − F(v·h): that
//! reflects up to 1.95 times the incident energy at grazing view. The product of the two transmissions
//! (Shirley et al. 1997, without their normalisation) is reciprocal and loses energy instead.
//!
//! The text exists once and is compiled in f32 ([`Brdf`]) and f64 ([`DBrdf`], the oracle).

macro_rules! brdf {
    ($name:ident, $real:ident, $vec3:ident, $doc:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            /// Albedo of the Lambertian lobe, in [0, 1].
            pub diffuse: glam::$vec3,
            /// Specular reflectance at normal incidence.
            pub f0: glam::$vec3,
            /// Specular reflectance at grazing incidence; 0 together with `f0` = 0 removes the lobe.
            pub f90: $real,
            /// GGX width α = roughness².
            pub alpha: $real,
        }

        impl $name {
            /// A Lambertian surface.
            pub fn lambert(diffuse: glam::$vec3) -> Self {
                Self { diffuse, f0: glam::$vec3::ZERO, f90: 0.0, alpha: 1.0 }
            }

            /// Whether there is a specular lobe.
            #[inline]
            pub fn has_specular(&self) -> bool {
                self.f90 > 0.0 || self.f0 != glam::$vec3::ZERO
            }

            /// Schlick's Fresnel reflectance for the cosine `cos` between direction and (micro-)normal.
            pub fn fresnel(&self, cos: $real) -> glam::$vec3 {
                let grazing = (1.0 - cos).clamp(0.0, 1.0).powi(5);
                self.f0 + (glam::$vec3::splat(self.f90) - self.f0) * grazing
            }

            /// Share of the light that enters the layer of the Lambertian lobe: 1 − max F.
            pub fn transmission(&self, cos: $real) -> $real {
                1.0 - self.fresnel(cos.max(0.0)).max_element()
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

            /// The GGX lobe alone, sr⁻¹.
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
                let Some(h) = (v + l).try_normalize() else { return glam::$vec3::ZERO };
                self.fresnel(v.dot(h)) * (self.distribution(normal, h) * self.visibility(n_v, n_l))
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
            f90: brdf.f90.into(),
            alpha: brdf.alpha.into(),
        }
    }
}
