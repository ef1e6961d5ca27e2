"""AUTO-07p on the oscillator between stops, whose contact it needs smoothed by a tanh."""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

_EQUATIONS = """
SUBROUTINE FUNC(NDIM,U,ICP,PAR,IJAC,F,DFDU,DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, IJAC, ICP(*)
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM,NDIM), DFDP(NDIM,*)
  DOUBLE PRECISION x, v, s, c, r, w, force
  x=U(1); v=U(2); s=U(3); c=U(4); w=PAR(1)
  force = 5D0*((x-1D0)*(1D0+tanh((x-1D0)/PAR(2))) + (x+1D0)*(1D0-tanh((x+1D0)/PAR(2))))
  r = 1D0 - s*s - c*c
  F(1) = v
  F(2) = -0.1D0*v - x - force + 0.2D0*c
  F(3) = w*c + s*r
  F(4) = -w*s + c*r
END SUBROUTINE FUNC
SUBROUTINE STPNT(NDIM,U,PAR,T)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: T
  DOUBLE PRECISION w, th, d, p, q
  w=2D0; PAR(1)=w; PAR(2)={smoothing}; PAR(11)=8D0*atan(1D0)/w
  th=8D0*atan(1D0)*T
  d=(1D0-w*w)**2+(0.1D0*w)**2
  p=0.2D0*(1D0-w*w)/d; q=0.2D0*0.1D0*w/d
  U(1)=p*cos(th)+q*sin(th); U(2)=w*(-p*sin(th)+q*cos(th))
  U(3)=sin(th); U(4)=cos(th)
END SUBROUTINE STPNT
SUBROUTINE BCND
END SUBROUTINE BCND
SUBROUTINE ICND
END SUBROUTINE ICND
SUBROUTINE FOPT
END SUBROUTINE FOPT
SUBROUTINE PVLS
END SUBROUTINE PVLS
"""

_CONSTANTS = """
NDIM=4, IPS=2, IRS=0, ILP=1
ICP=[1,11]
NTST={intervals}, NCOL=4, IAD=3, ISP=2, ISW=1, IPLT=0, NBC=0, NINT=0
NMX=5000, NPR=5000, MXBF=0, IID=2, ITMX=9, ITNW=7, NWTN=3, JAC=0
EPSL=1e-7, EPSU=1e-7, EPSS=1e-5
DS=-0.01, DSMIN=1e-8, DSMAX={longest}, IADS=1
NPAR=11, THL={{11:0.0}}, THU={{}}
UZSTOP={{1:[1.0,2.5]}}
"""

_SCRIPT = """
import time
run('stops', NMX=2)
for _ in range({rounds}):
    begin = time.time()
    run('stops')
    print('SECONDS', time.time() - begin)
"""


class Run(NamedTuple):
    """What AUTO found, and how long each of its runs took."""

    seconds: list[float]
    folds: list[float]
    """Ω of the limit points."""


def program() -> str | None:
    """AUTO-07p's command where it and a Fortran compiler are installed."""
    if shutil.which("gfortran") is None:
        return None
    return shutil.which("auto-07p") or shutil.which("auto")


def continued(smoothing: float, intervals: int, longest: float, rounds: int) -> Run | None:
    """Continue the branch from Ω = 2 to Ω = 1; compiling is not timed, AUTO's files are.

    The contact is smoothed over a tanh's width `smoothing`; the mesh has `intervals`, the largest
    step is `longest`.

    Returns None where AUTO is not installed or does not finish.
    """
    command = program()
    if command is None:
        return None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        fortran = f"{smoothing:.1e}".replace("e", "D")
        (folder / "stops.f90").write_text(_EQUATIONS.replace("{smoothing}", fortran))
        (folder / "c.stops").write_text(_CONSTANTS.format(intervals=intervals, longest=longest))
        (folder / "run.auto").write_text(_SCRIPT.format(rounds=rounds))
        try:
            done = subprocess.run(
                [command, "run.auto"],
                cwd=folder,
                env={**os.environ, "OMP_NUM_THREADS": "1"},  # its threads wait for each other
                capture_output=True,
                text=True,
                timeout=120,
            )
        except subprocess.TimeoutExpired:
            return None
    seconds = [float(text) for text in re.findall(r"^SECONDS (\S+)", done.stdout, re.MULTILINE)]
    last = done.stdout.rsplit("Starting stops", 1)[-1]
    folds = [float(t) for t in re.findall(r"^ +\d+ +-?\d+ +LP +\d+ +(\S+)", last, re.MULTILINE)]
    return Run(seconds, folds) if seconds and folds else None
