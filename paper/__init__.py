"""Recompute the published study: its figures, and its statements with verdicts."""
