"""Several masses on a line, with links and stops between them and the base.

``M ü + C u̇ + K u + (curved links) + (contact forces) = -M ι A_t(t) + f``, where ``u`` are the
displacements relative to the base, and ``ι`` is 1 for each mass.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import ConfigDict, SerializerFunctionWrapHandler, model_serializer, model_validator

from vibroimpact.arguments import check_path
from vibroimpact.errors import InputError, errors_at, shown
from vibroimpact.model.assembly.carried_mass import CarriedMasses
from vibroimpact.model.assembly.damping import DAMPINGS, AnyDamping, Modes
from vibroimpact.model.assembly.link import Link, read_link
from vibroimpact.model.assembly.matrices import Matrices
from vibroimpact.model.assembly.names import GROUND, check_body, check_known, check_part_name
from vibroimpact.model.assembly.numbers import AssemblyNumbers, made_of
from vibroimpact.model.frozen_mapping import FrozenMapping
from vibroimpact.model.quantities import FORCE, MASS
from vibroimpact.model.stated_units import check_no_units
from vibroimpact.model.stops import Stop
from vibroimpact.model.system import PartNames, System, Units
from vibroimpact.model.units import pretty
from vibroimpact.model.unknown_keys import listed, unknown_key
from vibroimpact.model.validation import Accepts, takes_fields
from vibroimpact.model.written_units import NONE, SI, written_for

if TYPE_CHECKING:
    from vibroimpact.model.excitation import Repeated

_MASS = Accepts(MASS, above=0.0, meaning="mass")
_FORCE = Accepts(FORCE, meaning="constant force")
_ZERO = 1e-14
"""Squared natural frequency, relative to the largest one and per mode, that counts as 0."""
_MATRIX_KEYS = ("names", "mass", "damping", "stiffness", "influence")


class Assembly(System):
    """Several masses on a line, with links and stops between them and the base.

    The masses have names. The positive direction is to the right. The displacement of a mass is
    relative to the base, and the name ``"ground"`` in a link or a stop is the base. Names consist
    of letters, digits, ``_`` and ``-``. Masses and links appear in results in the order in which
    they are passed.

    Parameters
    ----------
    masses
        Mapping from the names of the masses to the masses in kg, greater than 0, or strings such as
        ``"300 t"``.
    links
        Mapping from names to objects `Link` with the law of an isolator. A mapping with the keys
        ``left``, ``right`` and those of the law is also accepted. It may have a period and a
        damping ratio, or other design values of the law, which use the mass that the link carries:
        ``carries``. Default of ``carries``, only for a link between ``"ground"`` and a mass: the
        sum of this mass and of those that links join to it, if none of them has another link to the
        ground. Such a sum is stated in a warning. Default: no links.
    stops
        Mapping from names to objects `Link` with the law of a stop, or such mappings. A
        `JankowskiBumper` without a mass has m₁ m₂/(m₁ + m₂) of the two bodies. A mapping of a
        `Bumper` may have the coefficient of restitution of this mass, ``restitution``, instead of
        the damping. Default: no stops.
    forces
        Mapping from names of masses to constant forces in N, positive to the right, or strings such
        as ``"5 kN"``. Default: none.
    damping
        Damping besides that of the links: a `ModalDamping` or a `RayleighDamping`. Default: none.
    units
        ``"SI"`` (the default), or ``"none"`` if the numbers are dimensionless.
    matrices
        Matrices with one row per degree of freedom, instead of ``masses``; see `from_matrices`.

    Raises
    ------
    InputError
        If a value is invalid. The message contains the path of the value, such as
        ``stops.moat.gap``. Also if a link or a stop ends at a body that does not exist, if neither
        a link nor a stop holds a mass, or if there is no equilibrium under the constant forces and
        the preloads.

    Examples
    --------
    >>> building = Assembly(
    ...     {"base": "300 t", "roof": "250 t"},
    ...     links={
    ...         "isolator": Link("ground", "base", Isolator("5 MN/m", "0.2 MN s/m")),
    ...         "storey": Link("base", "roof", Isolator("200 MN/m", "1 MN s/m")),
    ...     },
    ...     stops={"moat": Link("base", "ground", Bumper("60 MN/m", "0.9 MN s/m", "10 cm"))},
    ... )
    >>> print(building.natural_frequencies.round(3))
    [0.477 6.129]
    """

    model_config = ConfigDict(ignored_types=(cached_property,))
    table_name = "assembly"
    by_mass = True
    _quiet: ClassVar[Mapping[str, Any]] = {
        "masses": {},
        "links": {},
        "stops": {},
        "forces": {},
        "damping": None,
        "units": SI,
        "matrices": None,
    }

    masses: FrozenMapping[Annotated[float, _MASS]] = FrozenMapping()
    links: FrozenMapping[Link] = FrozenMapping()
    stops: FrozenMapping[Link] = FrozenMapping()
    forces: FrozenMapping[Annotated[float, _FORCE]] = FrozenMapping()
    damping: Annotated[AnyDamping | None, DAMPINGS] = None
    units: Units = "SI"
    matrices: Matrices | None = None

    @takes_fields
    def __init__(
        self,
        masses: Mapping[str, float | str] | None = None,
        links: Mapping[str, Link | Mapping[str, Any]] | None = None,
        stops: Mapping[str, Link | Mapping[str, Any]] | None = None,
        forces: Mapping[str, float | str] | None = None,
        damping: AnyDamping | Mapping[str, Any] | None = None,
        units: Units = "SI",
        matrices: Matrices | None = None,
    ) -> None: ...

    @classmethod
    def from_matrices(
        cls,
        mass: ArrayLike | str | Path,
        damping: ArrayLike | str | Path | AnyDamping | None = None,
        stiffness: ArrayLike | str | Path | None = None,
        names: Iterable[str] | None = None,
        influence: ArrayLike | str | Path | None = None,
        stops: Mapping[str, Link | Mapping[str, Any]] | None = None,
        links: Mapping[str, Link | Mapping[str, Any]] | None = None,
        forces: Mapping[str, float | str] | None = None,
        units: Units = "SI",
        *,
        folder: str | Path = ".",
    ) -> Self:
        """Return an assembly whose linear part is a set of matrices, such as of finite elements.

        Each row is a degree of freedom. A stop or a link between two of them acts on the difference
        of their displacements, so both must be translations along the same line.

        Parameters
        ----------
        mass, stiffness
            Mass matrix M (kg) and stiffness matrix K (N/m): symmetric; M positive definite, K
            positive semi-definite. Each is an array, a nested list, a sparse matrix of scipy, or
            the path of an npz, npy or CSV file. If the mass is the path of an npz file, it may also
            contain the others, under the names of these parameters.
        damping
            Damping matrix C (N s/m), symmetric and positive semi-definite; or a `ModalDamping` or a
            `RayleighDamping`. Default: none.
        names
            Names of the degrees of freedom. Default: "dof_1", "dof_2" and so on.
        influence
            Influence vector ι: the displacement of each degree of freedom if the base moves by 1,
            as a rigid body. Default: 1 for each.
        stops, links, forces, units
            As in `Assembly`, with the names of degrees of freedom. Links are added to the matrices.
        folder
            Folder to which paths are relative. Default: the working directory.

        Raises
        ------
        InputError
            If a matrix is not square, not finite, not symmetric or not positive (semi-)definite,
            or if a file cannot be read. Also as in `Assembly`.

        Examples
        --------
        >>> frame = Assembly.from_matrices(
        ...     [[2, 0], [0, 1]], [[0, 0], [0, 0]], [[3, -1], [-1, 1]], names=["lower", "upper"]
        ... )
        >>> frame.names
        ('lower', 'upper')
        """
        rule = damping if isinstance(damping, AnyDamping) else None
        read = Matrices.read(
            mass,
            damping if rule is None else None,
            stiffness,
            names,
            influence,
            check_path(folder, "folder"),
        )
        return cls(
            links=links, stops=stops, forces=forces, damping=rule, units=units, matrices=read
        )

    @model_validator(mode="before")
    @classmethod
    def _read_parts(cls, data: Any) -> Any:
        """Read the parts by hand, because the names in their paths are those of the user."""
        if not isinstance(data, Mapping):
            return data
        if data.get("units") == NONE:
            check_no_units(data)
        read = dict(data)
        tables = {
            part: _table(data.get(part), part) for part in ("masses", "links", "stops", "forces")
        }
        matrices = data.get("matrices")
        if isinstance(matrices, Mapping):
            matrices = _matrices_of(matrices)
        elif matrices is not None and not isinstance(matrices, Matrices):
            raise InputError(
                f"matrices: {shown(matrices)} is not a table; use Assembly.from_matrices"
            )
        read["matrices"] = matrices
        for key in ("mass", "stiffness"):
            if matrices is None and not tables["masses"] and key in data:
                raise InputError(
                    f"{key}: unknown key; write masses by name as masses, or matrices as "
                    "matrices.mass, matrices.stiffness and matrices.damping"
                )
        if (matrices is None) == (not tables["masses"]):
            raise InputError(
                "masses: missing; pass a mapping from names to masses, such as "
                '{"base": "300 t", "roof": "250 t"}'
                if matrices is None
                else "masses: given together with matrices; remove one of the two"
            )
        masses = {
            check_part_name(name, "masses"): _MASS.at(value, f"masses.{name}")
            for name, value in tables["masses"].items()
        }
        names = masses if matrices is None else matrices.names
        read["masses"] = FrozenMapping(masses)
        read["forces"] = FrozenMapping(
            {
                check_known(name, list(names), "mass", "forces"): _FORCE.at(value, f"forces.{name}")
                for name, value in tables["forces"].items()
            }
        )

        def meeting(left: str, right: str, keys: Sequence[str]) -> float:
            where = [one for one in (left, right) if one != GROUND]
            for one in where:
                check_body(one, names, keys[0])
            if matrices is None:
                return 1.0 / sum(1.0 / masses[one] for one in where)
            return _meeting(np.array(matrices.mass), _closing(left, right, list(names)))

        carried = CarriedMasses(masses, names, tables["links"], data.get("units"))
        for part, is_stop in (("links", False), ("stops", True)):
            links = {}
            for name, value in tables[part].items():
                where = f"{part}.{check_part_name(name, part)}"
                mass = meeting if is_stop else partial(carried.of, name)
                links[name] = read_link(value, where, is_stop=is_stop, mass=mass)
                for end in ("left", "right"):
                    check_body(getattr(links[name], end), names, f"{where}.{end}")
            read[part] = FrozenMapping(links)
        carried.warn(read["links"])
        return read

    @model_validator(mode="after")
    def _can_be_simulated(self) -> Self:
        from vibroimpact.model.assembly.checks import check

        if self.damping is not None:
            self.damping.check_modes(len(self.names))
        with written_for(self):
            check(self)
        return self

    @model_serializer(mode="wrap")
    def _dumped(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        table: dict[str, Any] = handler(self)
        return {
            name: value
            for name, value in table.items()
            if not self._unsaid(name, getattr(self, name))
        }

    def _unsaid(self, name: str | None, value: Any) -> bool:
        if isinstance(value, FrozenMapping):
            return not value
        return super()._unsaid(name, value)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the masses, or of the degrees of freedom, in the order of results."""
        return tuple(self.masses) if self.matrices is None else self.matrices.names

    @property
    def stop_laws(self) -> dict[str, Stop]:
        """The laws of the stops, by the names of the stops."""
        return {name: one.stop for name, one in self.stops.items()}

    @property
    def counted_stops(self) -> tuple[str, ...]:
        """Names of the stops."""
        return tuple(self.stops)

    @property
    def part_names(self) -> PartNames:
        """Names of the masses, links and stops, by the dims of datasets."""
        parts = {"mass": self.names, "link": self.links, "stop": self.stops}
        return {dim: np.array(list(names), dtype=np.str_) for dim, names in parts.items()}

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What was assumed to read the links, one line each, which is in the notes of results."""
        return tuple(link.assumption for link in self.links.values() if link.assumption)

    @property
    def mass_matrix(self) -> NDArray[np.float64]:
        """Mass matrix M (kg), with one row per mass."""
        if self.matrices is not None:
            return np.array(self.matrices.mass)
        return np.diag(list(self.masses.values()))

    @property
    def stiffness_matrix(self) -> NDArray[np.float64]:
        """Stiffness matrix K without stops (N/m). A curved link has its initial stiffness."""
        return self.matrix_of_links("stiffness", self.links.values())

    @property
    def damping_matrix(self) -> NDArray[np.float64]:
        """Damping matrix C without stops (N s/m), including modal or Rayleigh damping.

        A dashpot whose exponent is not 1 is left out, because its damping depends on the velocity.
        """
        return self.matrix_of_links("damping", self.links.values()) + self.rule_damping

    @property
    def rule_damping(self) -> NDArray[np.float64]:
        """The part of the damping matrix that modal or Rayleigh damping contributes (N s/m)."""
        if self.damping is None:
            return np.zeros((len(self.names), len(self.names)))
        return self.damping.matrix(self.mass_matrix, self.stiffness_matrix, self._modes)

    @property
    def influence(self) -> NDArray[np.float64]:
        """Influence vector ι: the displacement of each mass if the base moves by 1."""
        if self.matrices is not None:
            return np.array(self.matrices.influence)
        return np.ones(len(self.names))

    @property
    def constant_force(self) -> NDArray[np.float64]:
        """Constant force on each mass (N)."""
        return np.array([self.forces.get(name, 0.0) for name in self.names])

    @property
    def angular_frequency(self) -> float:
        """Lowest undamped natural angular frequency above 0 (rad/s), or 0 if there is none."""
        return float(next((one for one in self._modes.omega if one > 0.0), 0.0))

    @property
    def natural_frequencies(self) -> NDArray[np.float64]:
        """Undamped natural frequencies without stops (Hz), ascending.

        Curved links have their initial stiffness. The frequency of a free motion is 0.
        """
        return np.asarray(self._modes.omega / math.tau)

    @property
    def mode_shapes(self) -> NDArray[np.float64]:
        """Undamped modes without stops: one row per mode, one column per mass.

        The largest entry of each row is 1.
        """
        shapes = self._modes.shapes.T
        largest = np.take_along_axis(shapes, np.abs(shapes).argmax(1)[:, np.newaxis], 1)
        return np.asarray(shapes / largest)

    @property
    def damping_ratios(self) -> NDArray[np.float64]:
        """Damping ratio of each mode, φᵀ C φ/(2 ω φᵀ M φ). It is NaN for a frequency of 0.

        If the damping is not classical (see `is_classically_damped`), damping couples the modes,
        and these ratios are approximations.
        """
        omega, shapes = self._modes.omega, self._modes.shapes
        with np.errstate(divide="ignore", invalid="ignore"):
            ratios = np.diag(shapes.T @ self.damping_matrix @ shapes) / (2.0 * omega)
        return np.where(omega > 0.0, ratios, np.nan)

    @property
    def is_classically_damped(self) -> bool:
        """Whether the undamped modes also decouple the damping, C M⁻¹ K = K M⁻¹ C.

        The source is Caughey and O'Kelly, J. Appl. Mech. 32 (1965) 583.
        """
        c, k = self.damping_matrix, self.stiffness_matrix
        product = c @ np.linalg.solve(self.mass_matrix, k)
        size = float(np.abs(product).max())
        return bool(np.abs(product - product.T).max() <= 1e-9 * size)

    @property
    def participation_factors(self) -> NDArray[np.float64]:
        """Modal participation factors, φᵀ M ι/φᵀ M φ, for the modes of `mode_shapes`."""
        shapes, m = self.mode_shapes, self.mass_matrix
        return np.asarray(
            (shapes @ m @ self.influence) / np.einsum("ij,jk,ik->i", shapes, m, shapes)
        )

    @property
    def effective_masses(self) -> NDArray[np.float64]:
        """Effective modal masses, (φᵀ M ι)²/φᵀ M φ (kg). Their sum is ιᵀ M ι."""
        return np.asarray((self._modes.shapes.T @ self.mass_matrix @ self.influence) ** 2)

    @property
    def linear(self) -> bool:
        """Whether all forces are linear in flight and during contact."""
        return all(one.law.linear for one in (*self.links.values(), *self.stops.values()))

    @property
    def may_have_units(self) -> bool:
        """Whether a unit that is stated elsewhere makes a rig without units one in SI units.

        This is never so, because an assembly has no units only if ``units="none"`` was passed.
        """
        return False

    @cached_property
    def _numbers(self) -> AssemblyNumbers:
        return made_of(self)

    @cached_property
    def _modes(self) -> Modes:
        from scipy.linalg import eigh

        values, shapes = eigh(self.stiffness_matrix, self.mass_matrix)
        values[values <= _ZERO * len(values) * np.abs(values).max()] = 0.0
        largest = np.take_along_axis(shapes, np.abs(shapes).argmax(0)[np.newaxis], 0)
        return Modes(np.sqrt(values), np.asarray(shapes * np.sign(largest)))

    def closing(self, link: Link) -> NDArray[np.float64]:
        """Return the row w for which u_left − u_right = w u."""
        return _closing(link.left, link.right, list(self.names))

    def ends(self, link: Link) -> tuple[int, int]:
        """Return the indices of the masses of a link, left and right; -1 for the ground."""
        left, right = (
            -1 if end == GROUND else self.names.index(end) for end in (link.left, link.right)
        )
        return left, right

    def meeting_mass(self, link: Link) -> float:
        """Return the mass (kg) that meets at a stop: m₁ m₂/(m₁ + m₂), or m at the ground.

        With matrices, it is 1/(w M⁻¹ wᵀ), where w u is the closing displacement.
        """
        return _meeting(self.mass_matrix, self.closing(link))

    def matrix_of_links(self, what: str, links: Iterable[Link]) -> NDArray[np.float64]:
        """Return the sum of the stiffness (or the damping) of links and of the matrices.

        Parameters
        ----------
        what
            ``"stiffness"`` or ``"damping"``.
        links
            The links that contribute.
        """
        count = len(self.names)
        matrix = (
            np.zeros((count, count))
            if self.matrices is None
            else np.array(getattr(self.matrices, what))
        )
        for link in links:
            w = self.closing(link)
            if what == "stiffness":
                value = link.isolator.initial_stiffness
            else:
                law = link.isolator
                value = law.damping if law.damping_exponent == 1.0 else 0.0
            matrix += value * np.outer(w, w)
        return matrix

    def _acted_on_by(self, shaking: Repeated) -> Repeated:
        """Return an excitation with the mass on which a force acts.

        A force on one of several masses must state which.
        """
        if shaking.moves_base:
            return shaking
        if shaking.on is not None:
            check_known(shaking.on, self.names, "mass", "shaking.on")
            return shaking
        if len(self.names) > 1:
            size = pretty(shaking.amplitude, shaking.quantity)
            raise InputError(
                f"shaking: {size} acts on one of {len(self.names)} masses; state which, such as "
                f'on = "{self.names[-1]}"'
            )
        return shaking.replace(on=self.names[0])

    def without_stops(self) -> Self:
        """Return a copy without stops."""
        return self.replace(stops={})

    def rows(self) -> list[tuple[str, str]]:
        """Return the paths of the parts and their values, with units unless there are none."""
        with written_for(self):
            pairs = [(f"masses.{name}", pretty(one, MASS)) for name, one in self.masses.items()]
            if self.matrices is not None:
                pairs.append(("degrees of freedom", listed(list(self.names))))
            for part in ("links", "stops"):
                for name, link in getattr(self, part).items():
                    pairs += [(f"{part}.{name}.{key}", text) for key, text in link.rows()]
            pairs += [(f"forces.{name}", pretty(one, FORCE)) for name, one in self.forces.items()]
            if self.damping is not None:
                pairs += [(f"damping.{key}", text) for key, text in self.damping.rows()]
            return pairs

    def __str__(self) -> str:
        with written_for(self):
            parts = [f"{name}={pretty(one, MASS)}" for name, one in self.masses.items()]
            parts += list(self.names) if self.matrices is not None else []
            links = (*self.links.items(), *self.stops.items())
            parts += [f"{name}={link}" for name, link in links]
            parts += [f"{name}: {pretty(one, FORCE)}" for name, one in self.forces.items()]
            parts += [] if self.damping is None else [str(self.damping)]
        return f"Assembly({', '.join(parts)})"

    def picture(self) -> str:
        """Return a picture of the masses, the links and the gaps to scale, as SVG."""
        from vibroimpact.model.assembly.drawing import as_svg, drawing

        return as_svg(drawing(self))

    def _picture(self) -> str:
        return self.picture()

    def _repr_html_(self) -> str:
        with written_for(self):
            return f"{self.picture()}{super()._repr_html_()}"


def _meeting(mass: NDArray[np.float64], w: NDArray[np.float64]) -> float:
    return float(1.0 / (w @ np.linalg.solve(mass, w)))


def _closing(left: str, right: str, names: list[str]) -> NDArray[np.float64]:
    signs = np.zeros(len(names))
    for end, sign in ((left, 1.0), (right, -1.0)):
        if end != GROUND:
            signs[names.index(end)] += sign
    return signs


def _table(value: Any, part: str) -> Mapping[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        what = {"masses": "masses", "forces": "forces"}.get(part, "objects Link")
        raise InputError(f"{part}: {shown(value)} is not a mapping from names to {what}")
    return value


def _matrices_of(table: Mapping[str, Any]) -> Matrices:
    for key in table:
        if key not in (*_MATRIX_KEYS, "folder"):
            raise InputError(f"matrices.{key}: {unknown_key(_MATRIX_KEYS, key)}")
    if "mass" not in table:
        raise InputError("matrices.mass: missing; add the mass matrix, or the path of its file")
    with errors_at("matrices."):
        return Matrices.read(
            table["mass"],
            table.get("damping"),
            table.get("stiffness"),
            table.get("names"),
            table.get("influence"),
            check_path(table.get("folder", "."), "folder"),
        )
