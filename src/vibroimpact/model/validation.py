"""Base of all parts of the model: immutable, validated and printable objects.

An invalid value raises `InputError`. The message is one line with the path of the field, the value
and what is accepted. It is the same for a constructor call, for a nested table of a study file and
for a change of an existing object.
"""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import wraps
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar, cast, get_args

from pydantic import (
    BaseModel,
    ConfigDict,
    GetCoreSchemaHandler,
    ValidationError,
    ValidationInfo,
)
from pydantic_core import CoreSchema, ErrorDetails, core_schema

from vibroimpact.errors import DependentError, InputError, errors_at, shown, similar
from vibroimpact.model.html_table import table
from vibroimpact.model.quantities import Quantity
from vibroimpact.model.size_checks import SMALLEST, check_size
from vibroimpact.model.units import accepted, pretty, read
from vibroimpact.model.unknown_keys import LIKENESS, MOST, SHOWN, listed, unknown_key
from vibroimpact.model.wrong_kinds import path_of, wrong_kind

_FIELD = re.compile(r"[a-z_]+(\.[\w-]+)*: ")
"""Path of a field at the start of a message; names in it may be those of the user."""
_Init = TypeVar("_Init", bound=Callable[..., None])
_ModelType = TypeVar("_ModelType", bound="Model")


@dataclass(frozen=True, slots=True)
class Accepts:
    """Annotation of a field: its quantity and its bounds (SI units).

    ``Annotated[float, Accepts(LENGTH, minimum=0.0)]`` is a float in metres, which may be passed as
    a number or as a string with a unit. With ``optional=True`` the field may also be None, which
    means that the value is unknown.

    If the unit depends on an exponent, `by` is the name of the field with the exponent. The class
    must declare that field before. `family` returns the quantity for an exponent. `quantity` is the
    usual quantity.

    `meaning` describes the field in words if its name does not, such as "cubic stiffness".
    """

    quantity: Quantity
    above: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    optional: bool = False
    by: str | None = None
    family: Callable[[float], Quantity] | None = None
    meaning: str = ""

    def of(self, values: Mapping[str, Any]) -> Accepts:
        """Return what is accepted, given the values of the other fields."""
        exponent = None if self.by is None else values.get(self.by)
        if exponent is None or self.family is None:
            return self
        return replace(self, quantity=self.family(exponent), by=None, family=None)

    def __call__(self, value: object) -> float | None:
        """Return the value in SI units, or raise `InputError` without the name of the field."""
        if value is None and self.optional:
            return None
        number = read(
            value, self.quantity, above=self.above, minimum=self.minimum, maximum=self.maximum
        )
        return check_size(value, number, SMALLEST if self.above == 0.0 else 0.0)

    def at(self, value: object, field: str) -> float:
        """Return the value in SI units; an error begins with the name of the field."""
        with errors_at(f"{field}: "):
            number = self(value)
        assert number is not None  # of no optional field
        return number

    def words(self) -> str:
        """Describe what is accepted."""
        return accepted(self.quantity, above=self.above, minimum=self.minimum, maximum=self.maximum)

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Make pydantic call this object before its own check."""
        if self.by is None:
            return core_schema.no_info_before_validator_function(self, handler(source))

        def beside(value: Any, info: ValidationInfo) -> float | None:
            return self.of(info.data)(value)

        return core_schema.with_info_before_validator_function(beside, handler(source))


class Choice:
    """Annotation of a field that accepts one of several classes, which differ by their kind."""

    classes: Mapping[str, type[BaseModel]]

    def unknown(self, value: object) -> str:
        """Describe the error of a table with an unknown kind."""
        raise NotImplementedError


def constructor(init: _Init) -> _Init:
    """Mark an ``__init__`` that only passes the fields on.

    With this mark, pydantic builds a nested table field by field instead of calling ``__init__``.
    Therefore it knows the full path of an invalid field. pydantic puts the same mark on its own
    ``__init__``, whose docstring is not true of ours.
    """
    init.__doc__ = "Take the fields that the docstring of the class describes."
    init.__pydantic_base_init__ = True  # type: ignore[attr-defined]
    return init


def takes_fields(init: _Init) -> _Init:
    """Let an ``__init__``, which has no body, pass its arguments on as the fields of these names.

    An argument that is None by default is left out if it is None. The signature is written out for
    calls by position, for ``help``, and because strings with units are accepted, too.
    """
    _, *parameters = inspect.signature(init).parameters.values()
    names = [one.name for one in parameters]
    optional = {one.name for one in parameters if one.default is None}

    @wraps(init)
    def passed(self: Model, /, *args: Any, **values: Any) -> None:
        init(self, *args, **values)  # refuses arguments that do not fit the signature
        fields = dict(zip(names, args, strict=False)) | values
        for name in optional & fields.keys():
            if fields[name] is None:
                del fields[name]
        Model.__init__(self, **fields)

    return constructor(cast("_Init", passed))


if TYPE_CHECKING:
    from pydantic._internal._model_construction import ModelMetaclass
else:
    ModelMetaclass = type(BaseModel)  # pydantic has no public name for it


class _Listed(ModelMetaclass):
    """Metaclass that lists only the names of the model: ``help`` leaves out those of pydantic.

    A misspelt keyword is reported in the same way as a misspelt key of a table.
    """

    def __call__(cls, /, *args: Any, **values: Any) -> Any:  # noqa: N805
        try:
            return super().__call__(*args, **values)
        except TypeError:
            model = cast("type[BaseModel]", cls)
            by_place = list(inspect.signature(model).parameters)[: len(args)]
            if twice := [name for name in by_place if name in values]:
                raise InputError(
                    f"{twice[0]}: passed twice, by position and by name; pass it once"
                ) from None
            unknown = [name for name in values if name not in model.model_fields]
            if not unknown:
                raise
            keys = in_order(model)
            messages = [f"{name[:SHOWN]}: {_unknown(model, keys, name)}" for name in unknown[:MOST]]
            rest = len(unknown) - len(messages)
            more = f" ({rest} more to correct)" if rest else ""
            raise InputError("; ".join(messages) + more) from None

    def __dir__(cls) -> list[str]:  # noqa: N805
        own = {
            name
            for base in cls.__mro__
            if isinstance(base, _Listed)
            for name in vars(base)
            if not name.startswith(("_", "model_"))
        }
        return sorted(own)


class Model(BaseModel, metaclass=_Listed):
    """Base class of the immutable model objects.

    Objects are compared and hashed by value. ``repr`` is the exact constructor call in SI units.
    ``str`` is a readable text with units of fitting size.

    Raises
    ------
    InputError
        If a value is invalid, or if an attribute is set after the construction.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    _quiet: ClassVar[Mapping[str, Any]] = {}
    """Fields that are not shown if they have this value."""

    @constructor
    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise InputError(_explain(error, type(self), "")) from None

    if not TYPE_CHECKING:  # mypy refuses assignment to a frozen model by itself

        def __setattr__(self, name: str, value: object) -> None:
            """Refuse: the object is immutable."""
            kind = type(self).__name__
            raise InputError(
                f"{name}: {kind} is immutable; use .replace({name}=...) to make a changed copy"
            )

        def __delattr__(self, name: str) -> None:
            """Refuse: the object is immutable."""
            kind = type(self).__name__
            raise InputError(f"{name}: {kind} is immutable; its fields cannot be deleted")

    @classmethod
    def model_validate(cls, obj: Any, *, where: str = "", **options: Any) -> Self:
        """Make an object from a table (a mapping), which may have nested tables.

        Parameters
        ----------
        obj
            The table, or an object of this class, which is returned unchanged.
        where
            Path of the table in its file, such as ``"oscillator"``. Error messages begin with it.
        **options
            Options that are passed to pydantic.

        Raises
        ------
        InputError
            If a key is unknown or missing, or if a value is invalid.
        """
        try:
            return super().model_validate(obj, **options)
        except ValidationError as error:
            raise InputError(_explain(error, cls, where)) from None

    @classmethod
    def model_validate_json(cls, json_data: str | bytes | bytearray, **options: Any) -> Self:
        """Make an object from JSON text, with the errors of `model_validate`."""
        try:
            return super().model_validate_json(json_data, **options)
        except ValidationError as error:
            raise InputError(_explain(error, cls, "")) from None

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed. It is validated like a new object.

        Raises
        ------
        InputError
            If a field is unknown, or if its new value is invalid.
        """
        return type(self).model_validate({**dict(self), **changes})

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy as `replace` does; the method of pydantic would not validate changes."""
        return self.replace(**(update or {}))

    def __repr_args__(self) -> Iterator[tuple[str | None, Any]]:
        said = ((name, getattr(self, name)) for name in in_order(type(self)))
        return ((name, value) for name, value in said if not self._unsaid(name, value))

    def _unsaid(self, name: str | None, value: Any) -> bool:
        return name is not None and name in self._quiet and bool(self._quiet[name] == value)

    def __str__(self) -> str:
        parts = [f"{name}={text}" for name, _, text in self._read()]
        return f"{type(self).__name__}({', '.join(parts)})"

    def _repr_html_(self) -> str:
        return table(type(self).__name__, self.rows())

    @classmethod
    def _table_keys(cls) -> list[str]:
        """Return the keys that a table of this class may have."""
        return list(in_order(cls))

    @classmethod
    def _laws_with(cls, key: str) -> list[str]:
        """Return the other laws of the same part that have a key, in words."""
        return []

    def _accepts(self, name: str) -> Accepts | None:
        """Return what a field accepts, given the other values, if it is a quantity."""
        accepts = _quantities(type(self)).get(name)
        return None if accepts is None else accepts.of(vars(self))

    def knobs(self) -> dict[str, tuple[float, Accepts]]:
        """Return the numbers that can be varied, by name: their values and what they accept."""
        by_name = {}
        for name, accepts in _quantities(type(self)).items():
            if isinstance(value := getattr(self, name), float):
                by_name[name] = value, accepts.of(vars(self))
        return by_name

    def rows(self) -> list[tuple[str, str]]:
        """Return the paths of the fields, such as ``right.gap``, and their values with units."""
        pairs = []
        for name, value, text in self._read():
            if isinstance(value, Model):
                pairs += [(f"{name}.{path}", part) for path, part in value.rows()]
            else:
                pairs.append((name, text))
        return pairs

    def _read(self) -> Iterator[tuple[str, Any, str]]:
        """Yield name, value and readable text of each field."""
        for name in in_order(type(self)):
            value = getattr(self, name)
            if self._unsaid(name, value):
                continue
            accepts = self._accepts(name)
            text = (
                str(value) if value is None or accepts is None else pretty(value, accepts.quantity)
            )
            yield name, value, text


@functools.cache
def in_order(model: type[BaseModel]) -> tuple[str, ...]:
    """Return the names of the fields, in the order of the arguments of the constructor."""
    said = [n for n in inspect.signature(model.__init__).parameters if n in model.model_fields]
    return (*said, *(name for name in model.model_fields if name not in said))


@functools.cache
def _quantities(model: type[BaseModel]) -> dict[str, Accepts]:
    """Return what the fields of a class accept that are quantities, in the same order."""
    fields = {name: model.model_fields[name].metadata for name in in_order(model)}
    return {
        name: next(one for one in metadata if isinstance(one, Accepts))
        for name, metadata in fields.items()
        if any(isinstance(one, Accepts) for one in metadata)
    }


def validate(model: type[_ModelType], data: object, where: str = "") -> _ModelType:
    """Make a model object from a table of a study file.

    Parameters
    ----------
    model
        The class, such as `Oscillator`.
    data
        The table: a mapping from field names to numbers, strings with units or tables.
    where
        Path of the table in its file, such as ``"oscillator"``.

    Returns
    -------
    Model
        The object.

    Raises
    ------
    InputError
        If the table is invalid. The message is one line with the full path, such as
        ``oscillator.right.gap: '15 kg' is a mass; ...``.
    """
    return model.model_validate(data, where=where)


def _explain(error: ValidationError, model: type[BaseModel], where: str) -> str:
    """Put what pydantic found into one line: all unknown keys, or else the first mistake."""
    mistakes = error.errors(include_url=False)
    # A misspelt key is also a missing one; the misspelling is what the user must see.
    unknown = [mistake for mistake in mistakes if mistake["type"] == "extra_forbidden"]
    own = [one for one in mistakes if not _depends(one)] or mistakes
    selection = unknown[:MOST] or own[:1]
    meant = {_meant(one, model) for one in selection if one in unknown}
    rest = sum(one["type"] != "missing" or one["loc"] not in meant for one in own) - len(selection)
    more = f" ({rest} more to correct)" if rest else ""
    lines = "; ".join(_mistake(mistake, model, where) for mistake in selection)
    return " ".join(f"{lines}{more}".split())


def _depends(mistake: ErrorDetails) -> bool:
    """Return whether correcting another mistake corrects this one."""
    return isinstance(mistake.get("ctx", {}).get("error"), DependentError)


def _meant(mistake: ErrorDetails, model: type[BaseModel]) -> tuple[int | str, ...]:
    """Return the location of the key that an unknown key probably means."""
    *table, name = mistake["loc"]
    keys = cast("type[Model]", _along(model, tuple(table))[1])._table_keys()
    return (*table, similar(str(name), keys, LIKENESS))


def _mistake(mistake: ErrorDetails, model: type[BaseModel], where: str) -> str:
    location = mistake["loc"]
    value = shown(mistake["input"])
    kind = mistake["type"]
    steps, wanted = _along(model, location)
    holder = _along(model, location[:-1])[1]
    path = path_of(where, steps)
    if kind == "value_error":
        problem = str(mistake["ctx"]["error"])
        if path and _FIELD.match(problem):
            return f"{path}.{problem}"
        if ";" not in problem:  # it does not state what to do
            problem += _example(model, location)
    elif kind == "missing":
        problem = _missing(holder, str(location[-1]))
    elif kind == "extra_forbidden":
        holder = cast("type[Model]", holder)
        problem = _unknown(holder, holder._table_keys(), str(location[-1]))
    elif kind == "union_tag_invalid":
        choice = _choice(holder, str(location[-1]))
        assert choice is not None
        path, problem = f"{path}.kind", choice.unknown(mistake["input"])
    elif kind in ("model_type", "model_attributes_type"):
        problem = f"{value} is not a table; pass a table of {listed(in_order(wanted))}"
    else:
        problem = f"{value} {wrong_kind(mistake)}{_example(model, location)}"
    return f"{path}: {problem}" if path else problem


def _unknown(model: type[BaseModel], keys: Sequence[str], name: str) -> str:
    return unknown_key(keys, name, cast("type[Model]", model)._laws_with(name))


def _example(model: type[BaseModel], location: tuple[int | str, ...]) -> str:
    """Return the example of the field at a path, if it has one."""
    for end in range(len(location), 0, -1):
        field = _along(model, location[: end - 1])[1].model_fields.get(str(location[end - 1]))
        if field is not None:
            return f"; write it as in {field.examples[0]}" if field.examples else ""
    return ""


def _choice(model: type[BaseModel], name: str) -> Choice | None:
    """What distinguishes the classes that a field takes, if there are several."""
    field = model.model_fields.get(name)
    return next((m for m in field.metadata if isinstance(m, Choice)), None) if field else None


def _along(
    model: type[BaseModel], location: tuple[int | str, ...]
) -> tuple[list[int | str], type[BaseModel]]:
    """Follow a path of pydantic's: its steps as the user knows them, and the class at its end."""
    steps = []
    choice = None
    for step in location:
        if choice is not None:  # pydantic puts the kind between the field and what is in it
            model, choice = choice.classes[str(step)], None
            continue
        steps.append(step)
        choice = _choice(model, str(step))
        field = model.model_fields.get(str(step))
        if field is not None and choice is None:
            model = next(
                (
                    kind
                    for kind in (field.annotation, *get_args(field.annotation))
                    if isinstance(kind, type) and issubclass(kind, BaseModel)
                ),
                model,
            )
    return steps, model


def _missing(model: type[BaseModel], name: str) -> str:
    metadata = model.model_fields[name].metadata if name in model.model_fields else []
    for accepts in metadata:
        if isinstance(accepts, Accepts):
            return f"missing; add {accepts.words()}"
    return f"missing; add this key (keys of this table: {listed(in_order(model))})"
