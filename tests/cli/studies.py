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

ISOLA = """
[oscillator]
mass = 1.0
isolator = { stiffness = 1.0, damping = 0.059 }
right = { stiffness = 40.0, damping = 0.4, gap = 1.0 }

[excitation]
amplitude = 2.0
"""
"""A bumper at which a motion of period 5 is reached from 1 state in 100, near 0.955 Hz."""
