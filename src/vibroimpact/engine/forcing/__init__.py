"""What drives the mass: a file each."""
