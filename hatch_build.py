"""A wheel for one platform, with the engine as machine code: ``VIBROIMPACT_PLATFORM=linux-x86_64``.

Without the variable, the wheel is for any platform, and numba compiles the engine at first use.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

TAGS = {
    "linux-x86_64": "manylinux_2_17_x86_64.manylinux2014_x86_64",
    "linux-aarch64": "manylinux_2_17_aarch64.manylinux2014_aarch64",
    "darwin-x86_64": "macosx_11_0_x86_64",
    "darwin-aarch64": "macosx_11_0_arm64",
    "win32-x86_64": "win_amd64",
    "win32-aarch64": "win_arm64",
}


class Libraries(BuildHookInterface):
    """Adds the libraries of one platform, which `make kernels` made."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Choose the files and the tag of the wheel."""
        platform = os.environ.get("VIBROIMPACT_PLATFORM")
        folder = Path(self.root, "src/vibroimpact/engine/libraries")
        # The engine of the explorer's page is the same on all platforms.
        always = (folder / "page.wasm", folder / "digest")
        for path in always:
            build_data["force_include"][str(path)] = f"vibroimpact/engine/libraries/{path.name}"
        if not platform:
            return
        found = sorted(folder.glob(f"{platform}-*"))
        if platform not in TAGS or not found:
            raise ValueError(
                f"VIBROIMPACT_PLATFORM: no libraries for {platform!r} in {folder.name}; one of "
                f"{', '.join(TAGS)}, made by make kernels"
            )
        for path in found:
            build_data["force_include"][str(path)] = f"vibroimpact/engine/libraries/{path.name}"
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{TAGS[platform]}"
