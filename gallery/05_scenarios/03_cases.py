"""
Scenarios of forty-eight published tests
========================================

A scenario is a class of resonance curves, such as curves with a jump. This figure shows the
scenario of each test of the published study, which is determined from the computed resonance curves
of the test. The study has four bumpers, four gaps and three levels of shaking.
"""

import vibroimpact as vi
from vibroimpact.figures import scenario_cases

cases = vi.laboratory.campaign()
found = {case.code: vi.classify_scenario(case).attrs["label"] for case in cases}
scenario_cases(found)
