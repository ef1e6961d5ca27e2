"""Readers of record files, one module per format. They return numbers and the stated units."""
