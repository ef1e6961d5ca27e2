"""What is behind a response: growth of disturbances, kinds of motion, coexisting motions."""
