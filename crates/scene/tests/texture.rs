//! Texture sampling against values worked out by hand.

use glam::{Vec2, Vec3, vec2};
use manylights_scene::Texture;
use manylights_scene::material::srgb_to_linear;

/// Black, red / green, blue; full channels, so that linear and encoded values are 0 and 1.
fn checker() -> Texture {
    let texels = vec![[0, 0, 0, 255], [255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]];
    Texture { width: 2, height: 2, texels }
}

/// Two products and sums in f32 on values up to 1.
const ROUNDING: f32 = 1e-6;

fn check(uv: Vec2, expected: Vec3) {
    let color = checker().sample(uv);
    assert!(color.abs_diff_eq(expected, ROUNDING), "{uv}: {color}, not {expected}");
}

#[test]
fn texel_centres_are_exact() {
    check(vec2(0.25, 0.25), Vec3::ZERO);
    check(vec2(0.75, 0.25), Vec3::X);
    check(vec2(0.25, 0.75), Vec3::Y);
    check(vec2(0.75, 0.75), Vec3::Z);
}

#[test]
fn between_centres_it_is_bilinear() {
    check(vec2(0.5, 0.25), 0.5 * Vec3::X);
    check(vec2(0.5, 0.5), Vec3::splat(0.25));
    check(vec2(0.375, 0.75), 0.75 * Vec3::Y + 0.25 * Vec3::Z);
}

#[test]
fn it_repeats_in_both_directions() {
    check(vec2(0.0, 0.25), 0.5 * Vec3::X);
    check(vec2(0.0, 0.0), Vec3::splat(0.25));
    check(vec2(-0.25, 3.25), Vec3::X);
    check(vec2(-2.5, -1.75), 0.5 * Vec3::X);
    check(vec2(1000.75, 0.75), Vec3::Z);
}

#[test]
fn filtering_is_in_linear_light() {
    let texture = Texture { width: 2, height: 1, texels: vec![[0; 4], [188, 188, 188, 255]] };
    let middle = texture.sample(vec2(0.5, 0.5)).x;
    assert!((middle - 0.5 * srgb_to_linear(188)).abs() < ROUNDING);
}

/// IEC 61966-2-1; the value of 188 by `python3 -c 'print(((188/255+.055)/1.055)**2.4)'`.
#[test]
fn srgb_curve() {
    assert_eq!(srgb_to_linear(0), 0.0);
    assert_eq!(srgb_to_linear(255), 1.0);
    assert!((srgb_to_linear(188) - 0.502_886_5).abs() < ROUNDING);
    assert!((srgb_to_linear(10) - 10.0 / 255.0 / 12.92).abs() < ROUNDING);
}
