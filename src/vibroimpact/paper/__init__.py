"""The published study, computed again: its figures, and its statements with verdicts."""
