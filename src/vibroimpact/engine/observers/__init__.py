"""Observers of a motion while it is computed; one file each. None has an influence on it."""
