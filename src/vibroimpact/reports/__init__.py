"""Reports of what was found: figures, tables and words, in files."""
