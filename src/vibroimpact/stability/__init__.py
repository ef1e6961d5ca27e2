"""Analysis of motions: growth of disturbances, kinds of motion, coexisting motions."""
