"""Measured data: files of tests as labelled datasets, whatever program wrote them."""
