"""Sizing: which gap and which stops keep displacement and acceleration acceptable."""
