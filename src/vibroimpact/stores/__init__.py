"""Store arrays block by block in files that survive interruptions."""
