"""Compile the kernels while Carom is installed; without a C compiler it holds Python only."""

import json
import os
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

BUILDING = "carom.native.building"
CONTENTS, PREFIX = "kernels.json", "carom: no compiled library: "  # of carom's own code
LEVELS = "CAROM_LEVELS"  # of the environment: levels of x86-64 for a wheel to publish, e.g. "1 3"


class CompiledKernels(BuildHookInterface):
    """Adds the shared library of kernels to the wheel, or puts it among editable sources."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the library, and name the platform that it is for; keep the reason if it fails."""
        sources = Path(self.root, "src")  # as working folder it comes first, whatever is installed
        if version == "editable":
            self.build(sources / "carom/lib", sources)
            return
        self.folder = tempfile.TemporaryDirectory()
        folder = Path(self.folder.name)
        built = self.build(folder, sources)
        for path in folder.iterdir():
            build_data["force_include"][str(path)] = f"carom/lib/{path.name}"
        if built:
            platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
            build_data["pure_python"] = False
            build_data["tag"] = f"py3-none-{platform}"

    def build(self, folder: Path, sources: Path) -> bool:
        """Build the library in a folder, or leave there why that failed, for users to be told."""
        levels = os.environ.get(LEVELS, "").split()
        command = [sys.executable, "-m", BUILDING, str(folder), *levels]
        run = subprocess.run(command, cwd=sources, stderr=subprocess.PIPE, text=True)
        sys.stderr.write(run.stderr)
        if run.returncode:
            folder.mkdir(parents=True, exist_ok=True)
            for library in folder.glob("libcarom*"):
                library.unlink()
            told = (run.stderr.strip().splitlines() or [f"exit status {run.returncode}"])[-1]
            failure = {"failure": told.removeprefix(PREFIX)}
            (folder / CONTENTS).write_text(json.dumps(failure) + "\n", encoding="utf-8")
        return run.returncode == 0

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove what was built, which is in the wheel now."""
        if folder := getattr(self, "folder", None):
            folder.cleanup()
