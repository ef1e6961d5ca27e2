"""Earthquakes: what records ask of rigs, one at a time and many at once."""
