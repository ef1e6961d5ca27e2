"""Isolators: laws of the restoring force and the damping between base and mass, one law per file.

A new law is a class derived from `IsolatorLaw` and an entry of `ISOLATORS`.
"""

from typing import TypeAlias

from vibroimpact.model.isolators.bilinear import BilinearIsolator
from vibroimpact.model.isolators.boucwen import BoucWenIsolator
from vibroimpact.model.isolators.exponential import ExponentialIsolator
from vibroimpact.model.isolators.friction import FrictionIsolator
from vibroimpact.model.isolators.law import IsolatorLaw
from vibroimpact.model.isolators.linear import Isolator
from vibroimpact.model.isolators.polynomial import PolynomialIsolator
from vibroimpact.model.law_registry import Kinds
from vibroimpact.model.own_law import Law

AnyIsolator: TypeAlias = IsolatorLaw | Law
"""All types of isolators."""

ISOLATORS = Kinds(
    Isolator,
    FrictionIsolator,
    BilinearIsolator,
    PolynomialIsolator,
    BoucWenIsolator,
    ExponentialIsolator,
    Law,
)

__all__ = [
    "ISOLATORS",
    "AnyIsolator",
    "BilinearIsolator",
    "BoucWenIsolator",
    "ExponentialIsolator",
    "FrictionIsolator",
    "Isolator",
    "IsolatorLaw",
    "Law",
    "PolynomialIsolator",
]
