"""Results in words and in plain values: for the command line, the explorer and reports.

Each file has `facts`, nested plain values for programs, and `text`, tables for people.
"""
