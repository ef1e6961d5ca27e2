"""Study files that several commands are tried with."""

QUAY = """
name = "quay"

[oscillator]
mass = "550 kg"
isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }
right = { kind = "rigid", restitution = 0.6, gap = "5 mm" }
left = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "-1 mm" }

[excitation]
amplitude = "0.05 g"
"""
"""A rigid stop and a preloaded bumper."""
