//! throw-away
use glam::Vec3;
fn main() {
    for what in std::env::args().skip(1) {
        let s = manylights_scene::load(&what, Some(std::path::Path::new("/work/shared/assets")))
            .unwrap();
        for (i, m) in s.materials.iter().enumerate() {
            let (mut lo, mut hi, mut n) = (Vec3::INFINITY, Vec3::NEG_INFINITY, 0);
            for t in &s.triangles {
                if t.material as usize == i {
                    n += 1;
                    for v in t.vertices {
                        lo = lo.min(s.vertices[v as usize].position);
                        hi = hi.max(s.vertices[v as usize].position);
                    }
                }
            }
            println!("{:20} {n:7} {lo:.2} {hi:.2}", m.name);
        }
    }
}
