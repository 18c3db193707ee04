//! All tests of the crate in one executable: each of its own links everything anew.

mod answers;
mod bench;
mod cli;
mod closed_pipes;
mod common;
mod outputs;
mod real_scenes;
mod references;
mod report;
mod run;
