"""Observers: what is measured along a motion, one file each. None of them influences it."""
