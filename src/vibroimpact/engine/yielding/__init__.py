"""The flow of laws that are linear between events: isolators that yield or slide."""
