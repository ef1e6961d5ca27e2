"""Reports of results as files: figures, tables and text."""
