"""Refine grids of nodes on a plane."""
