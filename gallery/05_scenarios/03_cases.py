"""
Scenarios of forty-eight published tests
========================================

This figure classifies each test of the published study from its computed resonance curves. The
study has four bumpers, four gaps and three levels of shaking.
"""

import vibroimpact as vi
from vibroimpact.figures import scenario_cases

cases = vi.laboratory.campaign()
found = {case.code: vi.classify_scenario(case).attrs["label"] for case in cases}
scenario_cases(found)
