//! Where and with what a result was made.

use std::sync::OnceLock;

use manylights_gpu::Gpu;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Program and machine of a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Provenance {
    /// Of the package.
    pub(crate) version: String,
    /// Git commit of the build; `-dirty` where tracked files differed. Absent without git.
    pub(crate) commit: Option<String>,
    /// Compiler.
    pub(crate) rustc: String,
    /// SHA-256 of the running program, for information: what decides is [`super::versions`].
    pub(crate) program: String,
    /// Which machine: `MANYLIGHTS_MACHINE`, else made from system, processor and threads. Times of
    /// different machines are never compared.
    pub(crate) machine: String,
    /// Operating system and architecture.
    pub(crate) system: String,
    /// Name of the processor.
    pub(crate) cpu: String,
    /// Threads that it offers.
    pub(crate) threads: usize,
    /// Adapter, driver and limits; absent where no method needed one.
    pub(crate) adapter: Option<serde_json::Value>,
}

impl Provenance {
    /// Of this program on this machine.
    pub(crate) fn here(gpu: Option<&Gpu>) -> Self {
        let system = format!("{} {}", std::env::consts::OS, std::env::consts::ARCH);
        let cpu = cpu();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let named = std::env::var("MANYLIGHTS_MACHINE").ok().filter(|name| !name.is_empty());
        let made = || sha256(format!("{system}\n{cpu}\n{threads}").as_bytes())[..8].to_owned();
        Self {
            machine: named.unwrap_or_else(made),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("MANYLIGHTS_COMMIT").map(str::to_owned),
            rustc: env!("MANYLIGHTS_RUSTC").to_owned(),
            program: program().to_owned(),
            system,
            cpu,
            threads,
            adapter: gpu.map(|gpu| {
                serde_json::to_value(gpu.report()).expect("an adapter report is plain data")
            }),
        }
    }

    /// What of it decides digits and times: machine and driver, not the program.
    pub(crate) fn place(&self) -> serde_json::Value {
        let adapter = self.adapter.as_ref().map(|adapter| {
            let fields = ["backend", "device_type", "driver", "driver_info", "name", "vendor"];
            serde_json::Value::from_iter(fields.map(|field| (field, adapter[field].clone())))
        });
        let Self { machine, system, cpu, threads, .. } = self;
        serde_json::json!([machine, system, cpu, threads, adapter])
    }

    /// Whether both differ in the program alone.
    pub(crate) fn same_machine(&self, other: &Self) -> bool {
        self.place() == other.place()
    }

    /// `manylights 0.1.0 (abc123)`.
    pub(crate) fn program_name(&self) -> String {
        match &self.commit {
            Some(commit) => format!("manylights {} ({commit})", self.version),
            None => format!("manylights {}", self.version),
        }
    }
}

/// Hexadecimal SHA-256.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn program() -> &'static str {
    static HASH: OnceLock<String> = OnceLock::new();
    HASH.get_or_init(|| {
        let bytes = std::env::current_exe().and_then(std::fs::read);
        bytes.map_or_else(|_| "unreadable".to_owned(), |bytes| sha256(&bytes))
    })
}

fn cpu() -> String {
    let from_proc = || {
        let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let from_sysctl = || {
        let arguments = ["-n", "machdep.cpu.brand_string"];
        let output = std::process::Command::new("sysctl").args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    from_proc()
        .or_else(|| std::env::var("PROCESSOR_IDENTIFIER").ok())
        .or_else(from_sysctl)
        .unwrap_or_else(|| "unknown".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sha256_of_the_standard_example() {
        // FIPS 180-2, appendix B.1.
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), expected);
    }

    #[test]
    fn the_program_and_the_machine_are_named() {
        let here = Provenance::here(None);
        assert_eq!(here.program.len(), 64);
        assert!(!here.cpu.is_empty() && here.threads > 0 && here.rustc.starts_with("rustc"));
    }
}
