//! The time of processors, which what others run besides hardly moves.

/// Seconds that the threads of this program have run so far, or those but the first, where a software adapter works;
/// not a number where Linux does not tell.
pub fn seconds(with_first: bool) -> f64 {
    let first = std::process::id().to_string();
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else { return f64::NAN };
    let of_task = |task: std::io::Result<std::fs::DirEntry>| {
        let task = task.ok()?;
        if !with_first && *task.file_name() == *first {
            return Some(0.0);
        }
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    };
    1e-9 * tasks.filter_map(of_task).sum::<f64>()
}
