"""What uncertain parameters of a rig make of its response."""
