"""Scenarios S0 to S6: features of resonance curves -> scenario, and maps over parameters."""
