"""Measured data: read the files of common measurement programs as labelled datasets."""
