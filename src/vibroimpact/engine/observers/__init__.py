"""What is looked at while a motion goes by; one file each. None has an influence on it."""
