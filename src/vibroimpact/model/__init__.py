"""The mechanical model: oscillator or assembly, excitation and state, physical or dimensionless."""

from vibroimpact.model import laboratory
from vibroimpact.model.assembly import (
    Assembly,
    AssemblyState,
    Link,
    ModalDamping,
    RayleighDamping,
    chain,
)
from vibroimpact.model.dimensionless import (
    Dimensionless,
    DimensionlessBumper,
    DimensionlessRigidStop,
    DimensionlessStop,
    from_dimensionless,
    to_dimensionless,
)
from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.excitation import Harmonic, Periodic, Repeated
from vibroimpact.model.isolators import (
    AnyIsolator,
    BilinearIsolator,
    BoucWenIsolator,
    ExponentialIsolator,
    FrictionIsolator,
    Isolator,
    PolynomialIsolator,
)
from vibroimpact.model.largest_free_response import peak_displacement
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.own_law import Law
from vibroimpact.model.quantities import GRAVITY
from vibroimpact.model.record import Record
from vibroimpact.model.rig import Rig
from vibroimpact.model.state import State
from vibroimpact.model.stops import (
    Bumper,
    JankowskiBumper,
    PowerBumper,
    RigidStop,
    Stop,
    ZenerBumper,
)
from vibroimpact.model.units import to_si
from vibroimpact.model.validation import Model, validate

__all__ = [
    "GRAVITY",
    "AnyIsolator",
    "Assembly",
    "AssemblyState",
    "BilinearIsolator",
    "BoucWenIsolator",
    "Bumper",
    "Dimensionless",
    "DimensionlessBumper",
    "DimensionlessRigidStop",
    "DimensionlessStop",
    "ExponentialIsolator",
    "FrictionIsolator",
    "Harmonic",
    "Isolator",
    "JankowskiBumper",
    "Law",
    "Link",
    "ModalDamping",
    "Model",
    "Oscillator",
    "Periodic",
    "PolynomialIsolator",
    "PowerBumper",
    "RayleighDamping",
    "Record",
    "Repeated",
    "Rig",
    "RigidStop",
    "State",
    "Stop",
    "ZenerBumper",
    "chain",
    "equilibrium",
    "from_dimensionless",
    "laboratory",
    "peak_displacement",
    "to_dimensionless",
    "to_si",
    "validate",
]
