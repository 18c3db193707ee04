//! Times of passes, added up.

use std::time::Instant;

use manylights_gpu::PassTime;

/// The time of each pass of a run so far, by name.
#[derive(Clone, Debug, Default)]
pub struct PassTimes(Vec<PassTime>);

impl PassTimes {
    /// Adds up the times of passes of one name. What `since` then took beyond them is named as a pass of
    /// the host, so that passes leave nothing out.
    pub fn add(&mut self, times: &[PassTime], host: &'static str, since: Instant) {
        let passes: f64 = times.iter().map(|time| time.seconds).sum();
        let seconds = (since.elapsed().as_secs_f64() - passes).max(0.0);
        let host = PassTime { pass: host, seconds };
        self.sum(times.iter().chain([&host]));
    }

    /// Adds up those of others.
    pub fn merge(&mut self, others: &Self) {
        self.sum(&others.0);
    }

    fn sum<'t>(&mut self, times: impl IntoIterator<Item = &'t PassTime>) {
        for &PassTime { pass, seconds } in times {
            match self.0.iter_mut().find(|time| time.pass == pass) {
                Some(time) => time.seconds += seconds,
                None => self.0.push(PassTime { pass, seconds }),
            }
        }
    }

    /// All of them, in the order in which they were first added.
    pub fn list(&self) -> Vec<PassTime> {
        self.0.clone()
    }
}
