"""The parameters of a rig and its shaking, named by path.

A path walks the fields of the oscillator: ``mass``, ``isolator.stiffness``, ``stops.right.gap``.
Units, bounds and words are those of the annotations of the laws. A path without the name of a stop,
``stops.stiffness``, means all stops that have this number. ``stops.`` may be left out before a side
(``right.gap``), and the name of the part where only one part can have the number (``gap``,
``friction``). ``frequency`` and ``amplitude`` are those of the shaking. A few parameters set
several numbers at once; they are listed in `derived_parameters`.

The paths of an assembly have the names of its parts: ``masses.roof``, ``links.storey.stiffness``,
``stops.moat.gap``, ``forces.roof``. ``gap`` and ``stops.stiffness`` are those of all stops.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from vibroimpact.errors import (
    InputError,
    advised,
    alternatives,
    errors_at,
    meant,
    shown,
    suggested,
)
from vibroimpact.model.assembly import Assembly
from vibroimpact.model.assembly.names import check_known
from vibroimpact.model.derived_parameters import DERIVED
from vibroimpact.model.excitation import FREQUENCY_WORDS, Of, amplitude_of
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.law_registry import Kinds
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.paths import Place, Steps, put, walk, whole_numbers
from vibroimpact.model.quantities import (
    ACCELERATION,
    DAMPING,
    DIMENSIONLESS,
    ENERGY,
    FORCE,
    FREQUENCY,
    IMPULSE,
    LENGTH,
    MASS,
    PERIOD,
    STIFFNESS,
    UNBALANCE,
    VELOCITY,
    Quantity,
    of_power,
)
from vibroimpact.model.rig import Rig
from vibroimpact.model.stops import STOPS, StopWithMemory
from vibroimpact.model.system import System
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.validation import Accepts, Model
from vibroimpact.model.written_units import has_no_units

_QUANTITIES = (
    FREQUENCY,
    ACCELERATION,
    LENGTH,
    STIFFNESS,
    DAMPING,
    DIMENSIONLESS,
    FORCE,
    UNBALANCE,
    MASS,
    VELOCITY,
    IMPULSE,
    ENERGY,
    PERIOD,
)
"""Quantities of results."""

_MASSES, _LINKS, _STOPS, _FORCES = "masses", "links", "stops", "forces"
_LAW = "law"
"""Fields of an assembly, and the field of a link or a stop that its paths leave out."""

_BOTH_STOPS = re.compile(r"\b(?:both|each|the) (bumpers|stops|side)\b")
"""Words in names of parameters that refer to the stops on both sides."""


def in_units(units: str) -> Quantity:
    """Return the quantity that has these units in a dataset."""
    of_fields = (one.quantity for one in PARAMETERS.values())
    powers = filter(None, (of_power(units),))
    known = itertools.chain(_QUANTITIES, of_fields, powers)
    return next(quantity for quantity in known if quantity.units == units)


class Parameter(NamedTuple):
    """A parameter of a rig that can be varied."""

    name: str
    """Its path."""
    quantity: Quantity
    long_name: str
    zero: bool = True
    """Whether the value 0 is accepted."""
    comment: str = ""
    """Definition of the parameter."""
    least: float | None = 0.0
    most: float | None = None
    """Lowest and highest accepted value. None if there is no bound."""

    @property
    def units(self) -> str:
        """The SI unit, as it is written in datasets."""
        return self.quantity.units

    def read(self, rig: Rig) -> float:
        """Return the value in a rig.

        Raises
        ------
        InputError
            If the rig has no such parameter, or if it is that of several stops, which differ.
        """
        if self.name in DERIVED:
            return DERIVED[self.name].read(rig)
        if self.name in ("frequency", "amplitude"):
            return float(getattr(rig.periodic, self.name))
        places = _places(rig.system).get(self.name, [])
        if not places:
            raise _unknown(self.name, rig, "parameter")
        first = places[0]
        if any((one.value, one.accepts.quantity) != (first.value, first.accepts.quantity)
               for one in places):  # fmt: skip
            raise _uneven(self.name, places)
        return first.value

    def numbers(self, rig: Rig) -> list[float]:
        """Return the value of each part that has it, of a parameter that is not derived."""
        return [one.value for one in _places(rig.system).get(self.name, [])]

    def vary(self, rig: Rig, value: float) -> Rig:
        """Return the rig with another value.

        Raises
        ------
        InputError
            If the value is invalid.
        """
        if self.name in DERIVED:
            return DERIVED[self.name].vary(rig, value)
        if self.name in ("frequency", "amplitude"):
            changed = rig.periodic.replace(**{self.name: value})
            keep_open = self.name != "frequency"
            return rig.with_parts(rig.system, changed, keep_open=keep_open)
        steps = _of_one_unit(self.name, rig.system)
        with errors_at(f"{self.name} at {pretty(value, self.quantity)}: "):
            return rig.with_parts(put(rig.system, dict.fromkeys(steps, value)))

    def beside(self, value: float, factor: float = 2.0) -> float:
        """Return another accepted value: `factor` times as large or as small, or for 0 near 1."""
        larger = factor * value if value else factor - 1.0
        if self.most is None or larger <= self.most:
            return larger
        return value / factor if value else self.most

    @property
    def physical(self) -> bool:
        """Whether the parameter has a unit."""
        return self.quantity is not DIMENSIONLESS

    @property
    def sides(self) -> tuple[str, ...]:
        """Side of the stop whose number it is, if it is that of one stop."""
        owner, _, side = self.name.rpartition(".")[0].partition(".")
        return (side,) if owner == "stops" and side else ()


def parameter(path: str, rig: Rig | System, field: str = "parameter") -> Parameter:
    """Return the parameter of a rig with a path, with its unit and its words in this rig.

    Raises
    ------
    InputError
        If the rig has no such parameter. The message names the nearest one, and all of them.
    """
    rig = Rig(rig) if isinstance(rig, System) else rig
    known = parameters(rig)
    name = canonical(path, known)
    if name not in known:
        raise _unknown(path, rig, field)
    return known[name]


def usual(name: str, of: Of = "acceleration") -> Parameter:
    """Return a parameter with its usual unit, and an amplitude with that of its quantity.

    A number of a formula has no usual unit.
    """
    if name == "amplitude":
        return _of(name, amplitude_of(of))
    return PARAMETERS.get(name) or _of(name, Accepts(DIMENSIONLESS))


def parameters(rig: Rig) -> dict[str, Parameter]:
    """Return the parameters of a rig by their paths."""
    of: Of = getattr(rig.shaking, "of", "acceleration")
    if isinstance(rig.system, Assembly):
        of_parts = {
            name: _of_part(name, first) for name, (first, *_) in _places(rig.system).items()
        }
        return {**{name: usual(name, of) for name in ("frequency", "amplitude")}, **of_parts}
    sides = [side for side in ("right", "left") if getattr(rig.oscillator, side, None) is not None]
    by_path = {name: one for name, one in PARAMETERS.items() if name == "frequency"}
    by_path["amplitude"] = _of("amplitude", amplitude_of(of))
    for name, (first, *_) in _places(rig.oscillator).items():
        by_path[name] = _of(name, first.accepts, rigid=getattr(first.owner, "rigid", False))
    by_path |= {name: PARAMETERS[name] for name in DERIVED}
    if len(sides) != 1:
        return by_path
    return {
        name: one._replace(
            long_name=_BOTH_STOPS.sub(
                lambda both: f"the {sides[0]} {both[1].removesuffix('s')}", one.long_name
            )
        )
        for name, one in by_path.items()
    }


def whole_number_paths(system: System) -> dict[str, int]:
    """Return the values of the fields that take whole numbers only, by path; they can be set."""
    return {_path(steps): value for steps, value in whole_numbers(system)}


def canonical(path: object, known: Iterable[str]) -> str:
    """Return the path under which a parameter is known, such as ``stops.right.gap``.

    A path that is not known is returned as it is written.
    """
    known = list(known)
    text = path.strip() if isinstance(path, str) else ""
    for name in (text, text.replace("-", "_")):
        for whole in ("oscillator.", "assembly.", "shaking."):
            name = name.removeprefix(whole)
        whole = "gap" if name == "stops.gap" else name
        stop = [f"stops.{whole}"] if "." in whole else []
        for one in (whole, *stop, *_only(whole)):
            if one in known:
                return one
    return text


def _only(name: str) -> list[str]:
    """Return the path of a number that only the isolator, or only a stop, can have."""
    owners = [owner for owner, fields in _FIELDS.items() if name in fields]
    return [f"{owners[0]}.{name}"] if len(owners) == 1 else []


def set_values(rig: Rig, values: Mapping[str, Any]) -> Rig:
    """Return a rig with other values at some paths, in any order.

    The values are numbers in SI units, strings with units, or whole parts; None removes a part. A
    path may name any field, and the fields of an absent stop, which is then made. All fields are
    set at once, that of one stop after that of all stops. Derived parameters follow. They keep what
    their definitions keep, except a damping that is stated; a period keeps the damping ratio also
    if the mass is changed.

    Raises
    ------
    InputError
        If a path does not exist, if a value is invalid, or if two paths set the same quantity.
    """
    known = PARAMETERS if isinstance(rig.system, Oscillator) else _places(rig.system)
    named: dict[str, Any] = {}
    typed: dict[str, str] = {}
    for path, value in values.items():
        name = canonical(path, [*known, "frequency", "amplitude"])
        if name in named:
            raise InputError(f"parameter: {path!r} is given twice; remove one of the two")
        named[name], typed[name] = value, path
    bare = [name.removeprefix("stops.") for name in named]
    for whole, name in itertools.permutations(bare, 2):
        if name.startswith(f"{whole}."):
            raise InputError(f"parameter: {name}: {whole} is set, too; remove one of the two")
    for pair in _SAME:
        if all(name in named for name in pair):
            raise InputError(
                f"parameter: {' and '.join(pair)} set the same quantity; remove one of the two"
            )
    heavier = "mass" in named or "weight" in named
    if heavier and "isolator_period" in named and "isolator.damping" not in named:
        named.setdefault("damping_ratio", rig.oscillator.damping_ratio)
    for name in ("frequency", "amplitude"):
        if name in named:
            rig = PARAMETERS[name].vary(rig, named.pop(name))
    fields = {
        name: named[name] for name in sorted(named, key=_depth_of_path) if name not in DERIVED
    }
    rig = _with_fields(rig, fields, typed)
    for name in _ORDER:
        if name == "damping" and len(fields) < len(named):  # which derived parameters have scaled
            dampings = {path: one for path, one in fields.items() if path.endswith(".damping")}
            rig = _with_fields(rig, dampings, typed)
        elif name in named:
            rig = _with_derived(rig, name, named[name])
    return rig


def check_units_kept(before: System, after: System, paths: Iterable[str]) -> None:
    """Refuse a change after which a number, which no path sets, has another unit.

    The unit of a stiffness may depend on an exponent: 2 MN/m^1.5 would become 2 MN/m^2.5.

    Raises
    ------
    InputError
        If there is such a number, unless it is 0 or the system has no units.
    """
    if has_no_units(after):
        return
    places = _places(after)
    names = {canonical(path, places) for path in paths}
    stated = {place.steps for name in names for place in places.get(name, ())}
    old = {one.steps: one for one in walk(before)}
    for place in walk(after):
        one = old.get(place.steps)
        if one is None or place.steps in stated:
            continue
        quantity, other = one.accepts.quantity, place.accepts.quantity
        if quantity.symbol != other.symbol and one.value == place.value != 0.0:
            raise InputError(
                f"{_path(place.steps)}: the other exponent would turn "
                f"{pretty(one.value, quantity)} into {pretty(one.value, other)}; set it, too"
            )


_SAME = (
    ("isolator_period", "isolator.stiffness"),
    ("damping_ratio", "isolator.damping"),
    ("weight", "mass"),
)
"""Pairs of paths that set the same quantity."""

_ORDER = (
    "proportional_stiffness",
    "stiffness_at_restitution",
    "isolator_period",
    "stiffness_ratio",
    "damping",
    "damping_ratio",
    "gap_ratio",
    "relaxation_time",
)
"""Derived parameters in the order in which they depend on each other, and on stated dampings."""


def _depth_of_path(name: str) -> int:
    """Rank a path: that of all stops comes before that of one."""
    return name.count(".")


def _with_fields(rig: Rig, values: Mapping[str, Any], typed: Mapping[str, str]) -> Rig:
    """Return the rig with other values of fields. `typed` are their paths as they were written."""
    steps = {one: value for path, value in values.items() for one in _steps(rig, path, typed[path])}
    return rig.with_parts(put(rig.system, steps)) if steps else rig


def _with_derived(rig: Rig, name: str, value: Any) -> Rig:
    one = DERIVED[name]
    limits: dict[str, Any] = {"minimum": one.least} if one.zero else {"above": 0.0}
    number = to_si(value, one.quantity, name, **limits)
    one.read(rig)  # refuses a rig that has no such parameter
    return one.vary(rig, number)


def _steps(rig: Rig, name: str, typed: str) -> list[Steps]:
    """Return where a field stands. A path of all stops stands for those that have the field.

    `typed` is the path as it was typed, for errors.
    """
    system = rig.system
    if name in _places(system):
        return _of_one_unit(name, system)
    if isinstance(system, Assembly):
        part, *rest = name.split(".")
        if part in (_LINKS, _STOPS) and len(rest) == 1:
            check_known(rest[0], list(getattr(system, part)), part.removesuffix("s"), name)
        if part in (_LINKS, _STOPS) and len(rest) > 1 and rest[1] not in ("left", "right"):
            # A law has fields that are not numbers, such as its kind.
            paths: list[Steps] = [(part, rest[0], _LAW, *rest[1:])]
        else:
            paths = [(part, *rest)]
    else:
        first, *rest = name.removeprefix("stops.").split(".")
        paths = [(first, *rest)]
        if first not in ("right", "left") and (name == "gap" or name.startswith("stops.")):
            present = [side for side in ("right", "left") if getattr(system, side) is not None]
            each: list[Steps] = [(side, first) for side in present or ("right", "left")]
            paths = [one for one in each if _exists(system, one)]
    if not paths or not all(_exists(system, one) for one in paths):
        for *steps, last in paths:
            if last == "kind" and (law := _part(system, steps)) is not None:
                raise InputError(
                    f"parameter: {name}: the law is {type(law).__name__}; to change it, edit "
                    "the study file, or write a rig with all numbers of another law"
                )
        raise _unknown(typed, rig, "parameter")
    return paths


def _part(system: System, steps: Sequence[str]) -> Model | None:
    """Return the model object at a place, if there is one."""
    part: Any = system
    for step in steps:
        part = part.get(step) if isinstance(part, Mapping) else getattr(part, step, None)
    return part if isinstance(part, Model) else None


def _of_one_unit(name: str, system: System) -> list[Steps]:
    """Return where the numbers of a path stand: one value cannot set those of different units."""
    places = _places(system).get(name, [])
    if len({one.accepts.quantity.symbol for one in places}) > 1:
        raise _uneven(name, places)
    return [one.steps for one in places]


def _exists(part: Any, steps: Steps) -> bool:
    """Return whether an object has a field. An absent part is made by its fields."""
    if not steps or part is None:
        return True
    first, *rest = steps
    if isinstance(part, Mapping):
        return first in part and _exists(part[first], tuple(rest))
    if not isinstance(part, Model) or first not in (*part._table_keys(), *part.knobs()):
        return False
    return _exists(getattr(part, first, None), tuple(rest))


def _places(system: System) -> dict[str, list[Place]]:
    """Return where the numbers of a system stand, by path; several for the path of all stops.

    A path without the name of a stop comes before those of each stop.
    """
    each = {_path(one.steps): one for one in walk(system)}
    if isinstance(system, Assembly):
        for name in system.names:
            steps = (_FORCES, name)
            still = Place(steps, 0.0, Accepts(FORCE, meaning="constant force"), system.forces)
            each.setdefault(".".join(steps), still)
    places: dict[str, list[Place]] = {}
    shared: dict[str, list[Place]] = {}
    for name, one in each.items():
        owner, _, field = name.rpartition(".")
        if owner.startswith("stops."):
            shared.setdefault("gap" if field == "gap" else f"stops.{field}", []).append(one)
        else:
            places[name] = [one]
    return {**places, **shared, **{n: [one] for n, one in each.items() if n not in places}}


def _path(steps: Steps) -> str:
    """Return the path of a number: the two sides of an oscillator are its stops.

    The law of a link or a stop of an assembly is not part of it.
    """
    if len(steps) > 3 and steps[0] in (_LINKS, _STOPS):
        return ".".join((*steps[:2], *steps[3:]))
    return ".".join(("stops", *steps) if steps[0] in ("right", "left") else steps)


def _fields_named(name: str, known: Iterable[str]) -> str:
    """Return the paths of a field, as words, or ""."""
    paths = [one for one in known if one.endswith(f".{name}") and one.count(".") == 1]
    return " or ".join(map(repr, paths))


def suggestion(path: object, known: Iterable[str]) -> str:
    """Return the paths that a wrong name may mean, such as ``did you mean right.gap?``, or ""."""
    known = list(known)
    if isinstance(path, str) and (meanings := _fields_named(path.strip().lower(), known)):
        return suggested(meanings)
    return meant(path, [*known, *(one.removeprefix("stops.") for one in known)])


def _unknown(path: object, rig: Rig, field: str) -> InputError:
    name = path.strip().lower() if isinstance(path, str) else ""
    if (symbol := name.replace("_", "")) in _SYMBOLS:
        return InputError(f"{field}: {path!r} is not a name of a parameter; use {_SYMBOLS[symbol]}")
    known, whole = list(parameters(rig)), list(whole_number_paths(rig.system))
    if (one := canonical(path, whole)) in whole:
        how = (
            f"run the command once per value, with --set {one}=VALUE"
            if field.startswith("--")
            else "compute a rig for each value"
        )
        return InputError(f"{field}: {path!r} takes whole numbers, so it cannot be varied; {how}")
    if meanings := _fields_named(name, [*known, *whole]):
        return InputError(f"{field}: {path!r} is not a path; use {meanings}")
    use = advised(suggestion(path, known), alternatives(known))
    elsewhere = canonical(path, PARAMETERS) in PARAMETERS
    why = " is not a parameter of this rig" if elsewhere else " is unknown"
    return InputError(f"{field}: {shown(path)}{why}; {use}")


def _uneven(name: str, places: list[Place]) -> InputError:
    field, quantity = places[0].steps[-1], places[0].accepts.quantity
    symbols = sorted({one.accepts.quantity.symbol for one in places})
    values = [pretty(one, quantity) for one in sorted({one.value for one in places})]
    words = (
        f"values of {field}, {' and '.join(values)}"
        if len(symbols) == 1
        else f"units of {field}, {' and '.join(symbols)}"
    )
    paths = (_path(one.steps) if len(one.steps) > 2 else ".".join(one.steps) for one in places)
    own = " or ".join(map(repr, paths))
    return InputError(
        f"{name}: the stops have different {words}; use {own}, or a rig with equal stops"
    )


def _of(name: str, accepts: Accepts, rigid: bool = False) -> Parameter:
    """Return the parameter of a number."""
    owner, _, field = name.rpartition(".")
    words = accepts.meaning or field.replace("_", " ")
    kind = "stop" if rigid or field == "restitution" else "bumper"
    _, _, side = owner.partition(".")
    if field == "gap":
        words = f"gap of the {side} side" if side else "gap of each side"
    elif owner == "stops":
        words = f"{words} of both {kind}s"
    elif side and owner.startswith("stops."):
        words = f"{words} of the {side} {kind}"
    elif owner:
        words = f"{words} of the {owner.replace('.', ' ')}"
    return Parameter(
        name,
        accepts.quantity,
        words,
        accepts.above is None,
        "in SI units" if "in the formula" in accepts.meaning else "",
        accepts.minimum if accepts.above is None else accepts.above,
        accepts.maximum,
    )


def _of_part(name: str, first: Place) -> Parameter:
    """Return the parameter of a number of an assembly."""
    owner, _, field = name.rpartition(".")
    part, _, own = owner.partition(".")
    words = first.accepts.meaning or field.replace("_", " ")
    if part in (_LINKS, _STOPS) and own:
        words = f"{words} of the {part.removesuffix('s')} {own}"
    elif part in (_MASSES, _FORCES):
        words = f"{words} {'of' if part == _MASSES else 'on'} {field}"
    elif not owner or part == _STOPS:
        words = f"{words} of each stop"
    else:
        words = f"{words} of the {owner}"
    base = _of(name, first.accepts)
    return base._replace(long_name=words)


def _fields(kinds: Kinds) -> dict[str, Accepts]:
    """Return the numbers that laws of an oscillator can have, with their usual quantity."""
    fields: dict[str, Accepts] = {}
    for law in kinds.classes.values():
        if issubclass(law, StopWithMemory):
            continue
        for name, field in law.model_fields.items():
            accepts = next((one for one in field.metadata if isinstance(one, Accepts)), None)
            if accepts is not None:
                fields.setdefault(name, accepts)
    return fields


_FIELDS = {"isolator": _fields(ISOLATORS), "stops": _fields(STOPS)}
del _FIELDS["isolator"]["gap"]  # a formula has a gap if it is a stop


def _every() -> Iterator[Parameter]:
    yield _of("frequency", Accepts(FREQUENCY, above=0.0, meaning=FREQUENCY_WORDS))
    yield _of("amplitude", amplitude_of("acceleration"))
    for name, field in Oscillator.model_fields.items():
        for accepts in field.metadata:
            if isinstance(accepts, Accepts):
                yield _of(name, accepts)
    for name, accepts in _FIELDS["isolator"].items():
        yield _of(f"isolator.{name}", accepts)
    for name, accepts in _FIELDS["stops"].items():
        yield _of("gap" if name == "gap" else f"stops.{name}", accepts)
    for side in ("right", "left"):
        for name, accepts in _FIELDS["stops"].items():
            yield _of(f"stops.{side}.{name}", accepts)
    for name, one in DERIVED.items():
        yield Parameter(name, one.quantity, one.long_name, one.zero, one.comment, one.least)


PARAMETERS: dict[str, Parameter] = {one.name: one for one in _every()}
"""All parameters that an `Oscillator` can have, with their usual units."""


_SYMBOLS = {
    **dict.fromkeys(
        ("omega", "ω", "w", "angular frequency", "angularfrequency"),
        "'frequency', in Hz or with a unit, such as '6.3 rad/s'",
    ),
    **dict.fromkeys(("f", "ν", "nu"), "'frequency'"),
    **dict.fromkeys(
        ("a", "a0", "f0", "p", "p0", "pga", "forceamplitude", "forcingamplitude", "acceleration"),
        "'amplitude', the amplitude of the shaking: of an acceleration, a displacement or a force",
    ),
    "k": "'isolator.stiffness' or 'stops.stiffness'",
    "c": "'isolator.damping' or 'stops.damping'",
    **dict.fromkeys(("xi", "ξ", "zeta", "ζ"), "'damping_ratio'"),
    **dict.fromkeys(("lambda", "λ"), "'stiffness_ratio'"),
    **dict.fromkeys(("delta", "δ", "delta0", "δ0"), "'gap_ratio'"),
    **dict.fromkeys(("tau", "τ"), "'relaxation_time'"),
    **dict.fromkeys(("e", "cor", "coefficientofrestitution"), "'stops.restitution'"),
    **dict.fromkeys(("g", "g0", "clearance"), "'gap'"),
    **dict.fromkeys(("t", "period", "naturalperiod"), "'isolator_period'"),
}
"""The usual symbol of a parameter, and what to write instead."""
