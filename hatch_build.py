"""Compile the kernels while a wheel is built; without a C compiler it holds Python only."""

import os
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

BUILDING = "carom.native.building"
LEVELS = "CAROM_LEVELS"  # of the environment: levels of x86-64 for a wheel to publish, e.g. "1 3"


class CompiledKernels(BuildHookInterface):
    """Adds the shared library of kernels to the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the library, and name the platform that it is for."""
        if version == "editable":
            return
        self.folder = tempfile.TemporaryDirectory()
        folder = Path(self.folder.name)
        sources = Path(self.root, "src")  # as working folder it comes first, whatever is installed
        levels = os.environ.get(LEVELS, "").split()
        command = [sys.executable, "-m", BUILDING, str(folder), *levels]
        if subprocess.run(command, cwd=sources).returncode:
            return
        for path in folder.iterdir():
            build_data["force_include"][str(path)] = f"carom/lib/{path.name}"
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove what was built, which is in the wheel now."""
        if folder := getattr(self, "folder", None):
            folder.cleanup()
