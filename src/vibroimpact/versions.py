"""Versions of what a result depends on."""

from __future__ import annotations

import platform
import sys
from importlib.metadata import PackageNotFoundError, version

from vibroimpact.model.public import public

_PACKAGES = ("numpy", "scipy", "numba", "llvmlite", "xarray", "matplotlib", "h5netcdf", "zarr")


@public
def show_versions() -> None:
    """Print the versions of the package and of those that it uses, the system and the engine.

    Add the output to a report of an error.
    """
    from vibroimpact._version import __version__
    from vibroimpact.engine import native

    lines = {"vibroimpact": __version__, "python": sys.version.split()[0]}
    for name in _PACKAGES:
        try:
            lines[name] = version(name)
        except PackageNotFoundError:
            lines[name] = "not installed"
    lines["system"] = platform.platform()
    lines["processor"] = f"{native.machine()}, levels {', '.join(native.levels()) or 'none'}"
    lines["engine"] = native.described()
    width = max(map(len, lines))
    print("\n".join(f"{name:<{width}}  {value}" for name, value in lines.items()))
