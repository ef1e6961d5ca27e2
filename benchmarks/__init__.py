"""Speed, accuracy and memory of the package beside general solvers; `python -m benchmarks`."""

import os

os.environ["VIBROIMPACT_KERNELS"] = "1"  # some call kernels besides the entries
import vibroimpact.engine.compiler  # noqa: F401

del os.environ["VIBROIMPACT_KERNELS"]
