"""Effects of uncertain parameters on the response of a rig."""
