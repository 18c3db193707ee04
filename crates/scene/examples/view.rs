//! throw-away: view SCENE OUT.png [camera] [spp] [bounces] [width]
use glam::*;
use manylights_scene::{
    bvh::{Bvh, Ray},
    *,
};
use rayon::prelude::*;
struct R(u64);
impl R {
    fn f(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E3779B97F4A7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58476D1CE4E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D049BB133111EB);
        z ^= z >> 31;
        (z >> 40) as f32 / (1u64 << 24) as f32
    }
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let s = load(&a[1], Some(std::path::Path::new("/work/shared/assets"))).unwrap_or_else(|e| {
        println!("{e}");
        std::process::exit(2)
    });
    let cam = s.camera(a.get(3).map(|s| s.as_str()).filter(|s| !s.is_empty())).unwrap();
    let spp: u32 = a.get(4).map_or(64, |s| s.parse().unwrap());
    let bounces: u32 = a.get(5).map_or(4, |s| s.parse().unwrap());
    let w: u32 = a.get(6).map_or(480, |s| s.parse().unwrap());
    let h = w * 3 / 4;
    let bvh = Bvh::build(&s);
    let px: Vec<[Vec3; 2]> = (0..w * h)
        .into_par_iter()
        .map(|i| {
            let (x, y) = (i % w, i / w);
            let mut r = R(i as u64 * 7919 + 1);
            let mut sum = Vec3::ZERO;
            let mut dsum = Vec3::ZERO;
            for _ in 0..spp {
                let mut d = cam.direction(x, y, [w, h]);
                let mut o = cam.position;
                let mut t = Vec3::ONE;
                for b in 0..=bounces {
                    let Some(hit) = bvh.closest(&Ray::new(o, d)) else { break };
                    let mut p = s.surface(hit.triangle, hit.u, hit.v, d);
                    if b == 0 {
                        p = p.facing(-d);
                    }
                    if b < 5 {
                        sum += t * p.emission;
                    }
                    for l in &s.lights {
                        let il = l.illuminate(p.position);
                        let c = p.normal.dot(il.to_light);
                        if c > 0.0
                            && p.geometric_normal.dot(il.to_light) > 0.0
                            && il.irradiance != Vec3::ZERO
                        {
                            let from = bvh.shifted(p.position, p.geometric_normal);
                            let ray = if il.distance.is_finite() {
                                Ray::between(from, from + il.to_light * (il.distance * 0.9999))
                            } else {
                                Ray::new(from, il.to_light)
                            };
                            if !bvh.occluded(&ray) {
                                let v =
                                    t * p.brdf.eval(p.normal, -d, il.to_light) * il.irradiance * c;
                                sum += v;
                                if b == 0 {
                                    dsum += v;
                                }
                            }
                        }
                    }
                    let (u1, u2) = (r.f(), r.f());
                    let (ph, z) = (std::f32::consts::TAU * u1, 1.0 - 2.0 * u2);
                    let sph = vec3(
                        (1.0 - z * z).max(0.0).sqrt() * ph.cos(),
                        (1.0 - z * z).max(0.0).sqrt() * ph.sin(),
                        z,
                    );
                    let mut wi = (p.normal + sph).normalize_or(p.normal);
                    // half of the samples about the mirror direction by cosine^n lobe where glossy
                    let rough = p.brdf.alpha;
                    let n = if p.brdf.has_specular() {
                        (2.0 / (rough * rough) - 2.0).max(1.0) / 2.0
                    } else {
                        0.0
                    };
                    let m = d - 2.0 * d.dot(p.normal) * p.normal;
                    if n > 0.0 && r.f() < 0.5 {
                        let (c, ph) = (r.f().powf(1.0 / (n + 1.0)), std::f32::consts::TAU * r.f());
                        let sn = (1.0 - c * c).sqrt();
                        let (a, bb) = m.any_orthonormal_pair();
                        wi = (m * c + a * sn * ph.cos() + bb * sn * ph.sin()).normalize();
                    }
                    let c = p.normal.dot(wi);
                    if c <= 0.0 || p.geometric_normal.dot(wi) <= 0.0 {
                        break;
                    }
                    let pl = (n + 1.0) / std::f32::consts::TAU * m.dot(wi).max(0.0).powf(n);
                    let pd = c / std::f32::consts::PI;
                    let pdf = if n > 0.0 { 0.5 * pl + 0.5 * pd } else { pd };
                    t *= p.brdf.eval(p.normal, -d, wi) * c / pdf;
                    o = bvh.shifted(p.position, p.geometric_normal);
                    d = wi;
                    if t.max_element() < 1e-5 {
                        break;
                    }
                }
            }
            [sum / spp as f32, dsum / spp as f32]
        })
        .collect();
    let mut lum: Vec<f32> = px.iter().map(|p| p[0].dot(vec3(0.2126, 0.7152, 0.0722))).collect();
    let mean = lum.iter().sum::<f32>() / lum.len() as f32;
    let dmean =
        px.iter().map(|p| p[1].dot(vec3(0.2126, 0.7152, 0.0722))).sum::<f32>() / lum.len() as f32;
    lum.sort_by(f32::total_cmp);
    let black = px.iter().filter(|p| p[0] == Vec3::ZERO).count() as f32 / px.len() as f32;
    println!(
        "mean {mean} direct share {} median {} p95 {} black {black} exposure {}",
        dmean / mean,
        lum[lum.len() / 2],
        lum[lum.len() * 95 / 100],
        s.exposure
    );
    let img = image::RgbImage::from_fn(w, h, |x, y| {
        let c = px[(y * w + x) as usize][0] * s.exposure;
        image::Rgb(c.to_array().map(|v| {
            let v = v.clamp(0.0, 1.0);
            (255.0 * if v <= 0.0031308 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
                + 0.5) as u8
        }))
    });
    img.save(&a[2]).unwrap();
}
