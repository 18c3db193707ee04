use manylights_reflectance::transformed_cosine::{Layered, Table};
fn main() {
    println!("{:?}", Layered::fit());
    let table = Table::fit();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/transformed_cosine/table.bin");
    std::fs::write(folder, table.to_bytes()).expect("can write");
    for i in 0..=10 {
        println!("{:?}", Layered::fit().values(i as f64 / 10.0));
    }
}
