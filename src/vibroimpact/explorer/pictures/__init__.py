"""From a state to what is drawn: plain numbers and words that a page can be sent.

A picture is a function of a state. It computes with the functions that everyone uses, and takes its
words from `vibroimpact.facts`, as the command line does.
"""
