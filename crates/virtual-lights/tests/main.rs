//! All tests of the crate in one executable: each of its own links everything anew.

mod lit_texels;
mod placement;
mod radius;
mod rsm;
mod shadows;
