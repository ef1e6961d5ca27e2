"""General-purpose integrators solving the same impact problem as the package's engine."""
