//! All tests of the crate in one executable: each of its own links everything anew.

mod common;
mod exact;
mod gather;
