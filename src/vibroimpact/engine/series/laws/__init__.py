"""Laws as formulae, one a file: what a force is made of, over numbers as over series."""
