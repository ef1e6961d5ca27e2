"""A forcing is a module with the kernels that the dispatcher tells of."""

from __future__ import annotations

import inspect
import re

import numpy as np
import pytest

from vibroimpact.engine import parameters as par
from vibroimpact.engine.flow_dispatch import AnyStops, Recorded, Several, carries, flow_of
from vibroimpact.engine.forcing import dispatch
from vibroimpact.engine.parameters import Drive, rig_vector

NAMES = re.findall(r"(\w+)\((plan[^)]*)\)", dispatch.__doc__ or "")
WALL = (2.0, 1.0, 0.1, (0.5, 1.0), None, 3.0)


@pytest.mark.parametrize("forcing", dispatch.FORCINGS)
def test_each_has_what_is_asked_of_it(forcing: float) -> None:
    assert len(NAMES) == 17
    for name, arguments in NAMES:
        asked = getattr(dispatch.FORCINGS[forcing], name)
        parameters = list(inspect.signature(asked).parameters)
        assert len(parameters) == len(arguments.split(",")), name
        assert callable(getattr(dispatch, name))


def test_the_flow_follows_from_the_forcing() -> None:
    plain = rig_vector(*WALL)
    several = rig_vector(*WALL, Drive(-0.5, -1.0, 2.0, ((1.0, 0.0), (0.3, 0.4))))
    record = rig_vector(*WALL, Drive(interval=0.1))
    assert [type(flow_of(rig)) for rig in (plain, several, record)] == [AnyStops, Several, Recorded]
    assert (plain[par.LOAD], plain[par.HARMONICS], plain[par.INTERVAL]) == (1.5, 1.0, np.inf)
    assert (several[par.SCALE], several[par.POWER], several[par.HARMONICS]) == (-1.0, 2.0, 2.0)
    assert several[par.WEIGHTS :].tolist() == [1.0, 0.0, 0.3, 0.4]
    assert record[par.INTERVAL] == 0.1
    assert not carries(plain, several)
    assert not carries(several, record)
