"""Describe, save, load and tabulate datasets: the vocabulary of all output variables."""
