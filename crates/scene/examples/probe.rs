//! throw-away
fn main() {
    for what in std::env::args().skip(1) {
        match manylights_scene::load(&what, Some(std::path::Path::new("/work/shared/assets"))) {
            Ok(s) => {
                println!("OK  {what}: {} tris {} verts {} mats {} tex {} lights {} cams; bounds {:?}", s.triangles.len(), s.vertices.len(), s.materials.len(), s.textures.len(), s.lights.len(), s.cameras.len(), s.bounds());
                for n in &s.notes { println!("      {n}"); }
                if std::env::var("V").is_ok() { for m in &s.materials { println!("   {:?} {:?} m{} r{} s{} e{:?} t{:?}", m.name, m.base_color, m.metallic, m.roughness, m.specular, m.emission, m.base_color_texture); } for c in &s.cameras { println!("   {c:?}"); } for l in &s.lights { println!("   {l:?}"); } }
            }
            Err(e) => println!("ERR {e}"),
        }
    }
}
