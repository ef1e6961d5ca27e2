"""Curves of solutions followed in n unknowns: pseudo-arclength steps, zeros, closed curves."""
