"""Which states lead to which motion: basins of attraction, their borders and their shares."""
