//! throw-away: fuzz ITERATIONS FILES...
use std::io::Write;
fn rnd(s: &mut u64) -> u64 { *s ^= *s << 13; *s ^= *s >> 7; *s ^= *s << 17; *s }
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: u64 = a[1].parse().unwrap();
    let mut s = a[2].parse::<u64>().unwrap() | 1;
    let (mut ok, mut err) = (0, 0);
    let mut slow = 0.0f64;
    for i in 0..n {
        let f = &a[3 + (rnd(&mut s) as usize) % (a.len() - 3)];
        let mut b = std::fs::read(f).unwrap();
        let glb = b.starts_with(b"glTF");
        let jl = if glb { u32::from_le_bytes(b[12..16].try_into().unwrap()) as usize + 20 } else { b.len() };
        for _ in 0..1 + rnd(&mut s) % 3 {
            let lim = if rnd(&mut s) % 8 == 0 { b.len() } else { jl.min(b.len()) };
            let p = rnd(&mut s) as usize % lim;
            match 1 + 2 * (rnd(&mut s) % 2) {
                0 => b[p] = rnd(&mut s) as u8,
                1 => { // digits: change numbers
                    if let Some(q) = (p..lim).find(|&q| b[q].is_ascii_digit()) { b[q] = b'0' + (rnd(&mut s) % 10) as u8; }
                }
                2 => { if let Some(q) = (p..lim).find(|&q| b[q].is_ascii_digit()) { b[q] = b'-'; } }
                _ => { // swap two bytes / duplicate digits
                    if let Some(q) = (p..lim.saturating_sub(1)).find(|&q| b[q].is_ascii_digit()) { if !glb { let c = b[q]; for _ in 0..rnd(&mut s) % 12 { b.insert(q, c); } } else { b[q + 1] = b[q]; } }
                }
            }
        }
        let path = std::path::Path::new(f).with_file_name(format!("fuzz{}.{}", std::process::id(), if glb { "glb" } else { "gltf" }));
        let path = std::path::Path::new("/tmp/fuzz").join(path.file_name().unwrap());
        std::fs::File::create(&path).unwrap().write_all(&b).unwrap();
        let t = std::time::Instant::now();
        let r = std::panic::catch_unwind(|| manylights_scene::load(path.to_str().unwrap(), None));
        slow = slow.max(t.elapsed().as_secs_f64());
        match r { Ok(Ok(_)) => ok += 1, Ok(Err(e)) => { assert!(!e.to_string().contains('\n')); err += 1 } Err(_) => { std::fs::copy(&path, format!("/tmp/fuzz/panic_{i}_{}", path.file_name().unwrap().to_str().unwrap())).unwrap(); println!("PANIC {f} {i}"); } }
    }
    println!("ok {ok} err {err} slowest {slow:.3} s");
}
