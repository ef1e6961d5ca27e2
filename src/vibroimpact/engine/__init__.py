"""One exact trajectory of one rig, in plain numbers and arrays."""
