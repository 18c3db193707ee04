//! Counted arithmetic against counts by hand.

use manylights_gpu::{Operations, operations};

const SHADER: &str = "
fn inner(v: vec3f) -> f32 {
    return dot(v, v);            // 5
}

fn outer(v: vec3f, n: u32) -> f32 {
    var sum = inner(v) / 2.0;    // 5, one division
    for (var i = 0u; i < n; i++) {
        sum += sqrt(f32(i + 1u)) * v.x;  // 2, one root; whole numbers do not count
    }
    if (sum > 1.0) {
        sum = min(sum, 3.0);     // 1
    } else {
        sum = normalize(v).x;    // 8, one root
    }
    return sum;
}

@compute @workgroup_size(1)
fn main() {
    _ = outer(vec3f(1.0), 3u);
}
";

#[test]
fn counts_are_those_by_hand() {
    let of = |name, turns| operations(SHADER, name, turns).expect("a function");
    assert_eq!(of("inner", 1), Operations { simple: 5, special: 0 });
    assert_eq!(of("outer", 1), Operations { simple: 16, special: 3 });
    assert_eq!(of("outer", 10), Operations { simple: 34, special: 12 });
}

#[test]
fn what_is_not_there_is_named() {
    let error = operations(SHADER, "nowhere", 1).expect_err("no such function").to_string();
    assert!(error.contains("`nowhere`"), "{error}");
    assert!(operations("fn", "f", 1).is_err());
}
