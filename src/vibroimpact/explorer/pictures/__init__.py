"""The pictures of a state, as numbers and texts that are sent to a page.

Each picture is a function of a state. It calls the public functions of the package. Its texts come
from `vibroimpact.facts`, like those of the command line.
"""
