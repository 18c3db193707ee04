//! All tests of the crate in one executable: each of its own links everything anew.

mod basis;
mod batch;
mod common;
mod dering;
mod evaluation;
mod hemisphere;
mod hemispherical;
mod light;
mod mirror;
mod polygon;
mod product;
mod projection;
mod rotation;
mod straight_line;
mod thesis;
mod tilt;
mod triangle;
mod unit;
mod wgsl;
mod window;
mod zonal;
mod zonal_single;
