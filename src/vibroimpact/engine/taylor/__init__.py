"""Motion under curved laws: one Taylor series a step, and the same events as between tables."""
