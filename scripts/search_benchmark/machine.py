"""Where and when: without it, a time says nothing."""

import os
import platform
from datetime import date
from importlib.metadata import version
from pathlib import Path

PACKAGES = ("rhograsp", "numpy", "scipy", "clarabel", "highspy")
"""Whose versions matter for the times."""


def describe_machine() -> str:
    """Processor, cores, load, date and versions, in one line."""
    load = f", load {os.getloadavg()[0]:.1f} at the start" if hasattr(os, "getloadavg") else ""
    versions = ", ".join(f"{name} {version(name)}" for name in PACKAGES)
    return (
        f"{processor()}, {os.cpu_count()} cores{load}; {date.today().isoformat()}; "
        f"Python {platform.python_version()}, {versions}"
    )


def processor() -> str:
    """Model name of the processor, as far as the system tells."""
    information = Path("/proc/cpuinfo")
    if information.is_file():
        for line in information.read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
