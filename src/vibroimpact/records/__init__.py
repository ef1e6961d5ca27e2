"""Measured records in files."""

from vibroimpact.records.columns import read_columns

__all__ = ["read_columns"]
