"""A headless Chromium, where there is one: what it shows of a page and what it complains about."""

import html
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",  # the graphics card of a machine without one
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--host-resolver-rules=MAP * ~NOTFOUND",  # nothing can be fetched, should anything try
    "--hide-scrollbars",
    "--enable-logging=stderr",
    "--window-size=1280,900",
    "--virtual-time-budget=2000",
)
REPORT = "report-of-the-test"


@dataclass(frozen=True, kw_only=True)
class Visit:
    """What one visit to a page has shown."""

    dom: str
    """The document when everything has run."""

    console: tuple[str, ...]
    """Lines of the console: errors, warnings and messages."""

    @property
    def told(self) -> str:
        """What the test's script has written by `tell`."""
        match = re.search(rf'<pre id="{REPORT}">(.*?)</pre>', self.dom, flags=re.DOTALL)
        return html.unescape(match[1]) if match else ""


def visit(page: Path, *, profile: Path, screenshot: Path | None = None) -> Visit:
    """Open a page; skips the test where there is no browser."""
    browser = next((path for name in NAMES if (path := shutil.which(name))), None)
    if browser is None:
        pytest.skip(f"no browser: none of {', '.join(NAMES)} is installed")
    shot = [f"--screenshot={screenshot}"] if screenshot else ["--dump-dom"]
    command = [browser, *FLAGS, f"--user-data-dir={profile}", *shot, page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=90)
    lines = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    return Visit(dom=done.stdout, console=tuple(lines))


def with_script(page: Path, script: str) -> Path:
    """A copy of a page with one more script, which may call `tell(text)`; the page's policy would not let it run."""
    text = re.sub(r"<meta http-equiv=.*?>", "", page.read_text())
    tell = f"const tell = (text) => document.body.append(el('pre', {{ id: '{REPORT}' }}, text));"
    copy = page.with_name(f"scripted-{page.name}")
    copy.write_text(text.replace("</body>", f"<script>{tell}{script}</script></body>"))
    return copy
