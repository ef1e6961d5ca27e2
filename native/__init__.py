"""The engine as libraries of machine code: ``python -m native``."""
