//! All tests of the crate in one executable: each of its own links everything anew.

mod g_buffer;
mod operations;
mod point_pass;
