"""Speed, accuracy and memory of the package beside general solvers; `python -m benchmarks`."""
