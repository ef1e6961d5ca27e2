"""Text of record and measurement files: lines, tables, units, times, and what headers state."""
