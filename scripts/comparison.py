"""What the comparisons with other renderers share: tools of their own, and where a result comes from."""

import json
import os
import platform
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOOLS = ROOT / "venv"
RESULTS = ROOT / "results"


def output(*command):
    """Standard output of a command run in the root of the repository."""
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def install(*packages):
    """Installs Python packages into a folder of the repository that git ignores."""
    if not TOOLS.exists():
        venv.create(TOOLS, with_pip=True)
    output(TOOLS / "bin" / "python", "-m", "pip", "install", "--quiet", *packages)


def build(example):
    """Builds an example of the workspace and returns its program."""
    output("cargo", "build", "--release", "--locked", "--workspace", "--example", example)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return target / "release" / "examples" / example


def provenance():
    """Machine, compiler, commit, and how busy the machine was."""
    model = platform.processor() or platform.machine()
    if Path("/proc/cpuinfo").exists():
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), model)
    return {
        "processor": model,
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "system": platform.platform(terse=True),
        "load": round(os.getloadavg()[0], 1),
        "rustc": output("rustc", "--version").strip(),
        "commit": output("git", "describe", "--always", "--dirty", "--abbrev=12").strip(),
    }


def record(name, result, lines, folder="path-tracer"):
    """Writes a result as JSON and as a Markdown table, and shows the table."""
    results = RESULTS / folder
    results.mkdir(parents=True, exist_ok=True)
    (results / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")
    origin = ", ".join(f"{key} {value}" for key, value in result["provenance"].items())
    text = "\n".join([*lines, "", f"Made by `scripts/{result['command']}`: {origin}.", ""])
    (results / f"{name}.md").write_text(text)
    sys.stdout.write(text)
