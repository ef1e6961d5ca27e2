"""The general flow: Taylor series of any law, emitted as straight code."""
