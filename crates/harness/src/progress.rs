//! Progress on standard error: a bar with the time left on a terminal, a plain line every few
//! seconds otherwise.

use std::time::{Duration, Instant};

use indicatif::ProgressStyle;

use crate::output::say;

/// Shorter work stays silent where there is no terminal.
const QUIET: Duration = Duration::from_secs(2);
/// Between two plain lines.
const INTERVAL: Duration = Duration::from_secs(5);

/// The progress of one piece of work.
pub(crate) struct ProgressBar {
    bar: indicatif::ProgressBar,
    label: String,
    started: Instant,
    next_line: Instant,
}

impl ProgressBar {
    /// Work of an amount that [`Self::set`] will tell.
    pub(crate) fn new(label: &str) -> Self {
        let bar = indicatif::ProgressBar::new(0);
        let style = ProgressStyle::with_template("{prefix} {wide_bar} {percent:>3} % {eta} left");
        bar.set_style(style.expect("the template is well formed"));
        bar.set_prefix(label.to_owned());
        let started = Instant::now();
        Self { bar, label: label.to_owned(), started, next_line: started + QUIET }
    }

    /// `done` of `total` is done.
    pub(crate) fn set(&mut self, done: u64, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(done);
        let now = Instant::now();
        if self.bar.is_hidden() && done < total && now >= self.next_line {
            self.next_line = now + INTERVAL;
            say(format_args!("{}: {}", self.label, plain(done, total, now - self.started)));
        }
    }

    /// Prints a line above the bar.
    pub(crate) fn line(&self, text: &str) {
        self.bar.suspend(|| say(text));
    }
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

fn plain(done: u64, total: u64, elapsed: Duration) -> String {
    let share = done as f64 / total as f64;
    let percent = 100.0 * share;
    if done == 0 {
        return format!("{percent:.0} %");
    }
    let left = elapsed.as_secs_f64() * (1.0 - share) / share;
    format!("{percent:.0} %, about {left:.0} s left")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_extrapolated() {
        assert_eq!(plain(1, 4, Duration::from_secs(10)), "25 %, about 30 s left");
        assert_eq!(plain(0, 4, Duration::from_secs(10)), "0 %");
    }
}
