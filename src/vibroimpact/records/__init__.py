"""Measured records in files, a format a file; plain numbers and the units that files state."""
