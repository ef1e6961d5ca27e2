"""From measurements to parameters: fits, their uncertainty, and what to test next."""
