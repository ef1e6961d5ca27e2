"""What a motion shows, in labelled arrays."""
