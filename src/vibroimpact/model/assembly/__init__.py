"""Several masses on a line, with links and stops between them and the base."""

from vibroimpact.model.assembly.assembly import Assembly
from vibroimpact.model.assembly.chain import chain
from vibroimpact.model.assembly.damping import ModalDamping, RayleighDamping
from vibroimpact.model.assembly.link import Link
from vibroimpact.model.assembly.numbers import AssemblyNumbers, PartNumbers, numbers
from vibroimpact.model.assembly.state import AssemblyState

__all__ = [
    "Assembly",
    "AssemblyNumbers",
    "AssemblyState",
    "Link",
    "ModalDamping",
    "PartNumbers",
    "RayleighDamping",
    "chain",
    "numbers",
]
