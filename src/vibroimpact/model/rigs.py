"""What a function takes where it asks for a rig: one idea, used by all public functions.

A rig is an oscillator and the peak acceleration that shakes it. Functions ask for the two one
after the other; whatever carries both may stand in their place: a laboratory case, its code as
text, the path of a study file, a `Rig` or a pair. `takes_rig` teaches that to a function, `as_rig`
reads one item of a list.
"""

from __future__ import annotations

import contextlib
import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Concatenate, NamedTuple, ParamSpec, Protocol, TypeAlias, TypeVar, overload

from vibroimpact.errors import InputError, shown
from vibroimpact.model.excitation import Harmonic, Periodic, Repeated, sized
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.record import Record

_Shaken = TypeVar("_Shaken", contravariant=True)
_Found = TypeVar("_Found", covariant=True)
_Rest = ParamSpec("_Rest")

_ACCEPTED = (
    'a laboratory case or its code, such as "B2-G1-A3", the path of a study file, such as '
    '"rig.toml", a `Rig` or a pair (oscillator, amplitude) is accepted'
)


class _Given(NamedTuple):
    oscillator: Oscillator
    amplitude: AnyShaking | Record | None
    """None of a study that does not say it."""


AnyShaking: TypeAlias = float | str | Harmonic | Periodic | Sequence[float | str]
"""An amplitude, or a `Harmonic` or `Periodic` whose frequency is left open; in sweeps also an
amplitude for each frequency."""


class WithAmplitude(Protocol):
    """Anything with an oscillator and an amplitude: a `Rig`, a laboratory `Case`."""

    @property
    def oscillator(self) -> Oscillator:
        """The oscillator."""

    @property
    def amplitude(self) -> float:
        """Peak base acceleration A in m/s²."""


AnyRig: TypeAlias = WithAmplitude | tuple[Oscillator, AnyShaking] | str | Path
"""A laboratory case, its code, the path of a study file, a `Rig` or a pair (oscillator,
amplitude)."""


def as_rig(value: Any, where: str = "oscillator", otherwise: str = "") -> _Given:
    """Read a rig: a laboratory case, its code, a study file, a `Rig` or a pair with an amplitude.

    The amplitude is as it was given; whoever uses it reads it.

    Raises
    ------
    InputError
        If it is none of these, or there is no such case; the line begins with `where`, and names
        what is accepted `otherwise`. If a study file cannot be used; the line names the file.
    """
    why = ""
    if _is_study(value):
        from vibroimpact.model.study import read_rig  # which itself needs what is here

        return _Given(*read_rig(Path(value))[1:])
    if isinstance(value, str):
        from vibroimpact.model import laboratory  # which itself needs what is here

        try:
            value = laboratory.case(value)
        except InputError as error:
            why = f" ({error})"
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], Oscillator):
        return _Given(*value)
    if isinstance(getattr(value, "oscillator", None), Oscillator) and hasattr(value, "amplitude"):
        return _Given(value.oscillator, value.amplitude)
    raise InputError(f"{where}: {shown(value)} is no rig; {otherwise}{_ACCEPTED}{why}")


def as_shaking(value: Any, where: str) -> tuple[Repeated, tuple[float, ...] | None]:
    """Read an amplitude, or what shakes at whatever frequency.

    Returns
    -------
    shaking, sizes
        Its frequency means nothing. `sizes` are the amplitudes if a list was given; that of the
        shaking is the largest.

    Raises
    ------
    InputError
        If it cannot be used, or is 0.
    """
    if isinstance(value, Record):
        raise _without_period(where)
    if value is None:
        raise InputError(
            f"{where}: missing, and the rig does not say it; an acceleration greater than 0 is "
            'accepted, such as "0.05 g", or a displacement or a force'
        )
    if isinstance(value, Harmonic | Periodic):
        if value.amplitude == 0.0:
            raise InputError(f"{where}: 0; an amplitude greater than 0 is accepted")
        return value, None
    if _is_list(value):
        sizes, of = [], None
        for i, one in enumerate(value):
            size, of = sized(one, of, f"{where}[{i}]", positive=True)
            sizes.append(size)
        if not sizes:
            raise InputError(f"{where}: the list is empty; an amplitude for each is accepted")
        return Harmonic(max(sizes), 1.0, of=of), tuple(sizes)
    size, of = sized(value, None, where, positive=True)
    return Harmonic(size, 1.0, of=of), None


class OfAmplitude(Protocol[_Rest, _Found]):
    """A function of an oscillator and an amplitude, or of what carries both."""

    @overload
    def __call__(
        self,
        oscillator: Oscillator | AnyRig,
        amplitude: AnyShaking,
        *args: _Rest.args,
        **kwargs: _Rest.kwargs,
    ) -> _Found: ...
    @overload
    def __call__(self, oscillator: AnyRig, *args: _Rest.args, **kwargs: _Rest.kwargs) -> _Found: ...


class OfExcitation(Protocol[_Shaken, _Rest, _Found]):
    """A function of an oscillator and what shakes it, or of a case and a frequency."""

    @overload
    def __call__(
        self,
        oscillator: Oscillator,
        excitation: _Shaken,
        *args: _Rest.args,
        **kwargs: _Rest.kwargs,
    ) -> _Found: ...
    @overload
    def __call__(
        self,
        oscillator: AnyRig,
        excitation: _Shaken | float | str,
        *args: _Rest.args,
        **kwargs: _Rest.kwargs,
    ) -> _Found: ...


@overload
def takes_rig(
    function: Callable[Concatenate[Oscillator, AnyShaking, _Rest], _Found],
) -> OfAmplitude[_Rest, _Found]: ...
@overload
def takes_rig(
    function: Callable[Concatenate[Oscillator, float | str, _Rest], _Found],
) -> OfAmplitude[_Rest, _Found]: ...
@overload
def takes_rig(
    function: Callable[Concatenate[Oscillator, _Shaken, _Rest], _Found],
) -> OfExcitation[_Shaken, _Rest, _Found]: ...
def takes_rig(function: Callable[..., Any]) -> Any:
    """Let a function of an oscillator and an amplitude, or an excitation, take a case as well.

    Where its first argument carries the amplitude, the amplitude may be left out, and an
    excitation may be a frequency alone::

        sweep("B2-G1-A3", frequencies)    simulate(case, "2 Hz", 100)

    What is neither a rig nor an excitation is refused before the function sees it, and a record.
    """
    return _with_rig(function, records=False)


def takes_rig_or_record(
    function: Callable[Concatenate[Oscillator, _Shaken, _Rest], _Found],
) -> OfExcitation[_Shaken, _Rest, _Found]:
    """Let a function of an oscillator and a record, or an excitation, take a case as well."""
    found: OfExcitation[_Shaken, _Rest, _Found] = _with_rig(function, records=True)
    return found


def _with_rig(function: Callable[..., Any], records: bool) -> Any:
    signature = inspect.signature(function)
    first, second = list(signature.parameters)[:2]
    example = f"{function.__name__}({', '.join(list(signature.parameters)[:3])}, ...)"

    @functools.wraps(function)
    def with_rig(*args: Any, **kwargs: Any) -> Any:
        if not args and first in kwargs:
            args = (kwargs.pop(first),)
        if not args:
            return function(**kwargs)  # Python says what is missing
        rig, *rest = args
        amplitude: AnyShaking | Record | None = None
        if not isinstance(rig, Oscillator):
            try:
                rig, amplitude = as_rig(rig, first, "an oscillator, ")
            except InputError as error:
                if any(
                    not isinstance(other, str | Path) and is_rig(other)
                    for other in (*rest, *kwargs.values())
                ):
                    raise InputError(
                        f"{first}: {shown(rig)} stands where the rig is expected, and a rig "
                        f"behind it: the two are swapped; {example} is accepted"
                    ) from error
                raise
            if records and isinstance(amplitude, Record) and not rest and second not in kwargs:
                rest = [amplitude]
            if second == "amplitude" and not _told(signature, rig, rest, kwargs):
                rest = [amplitude, *rest]
        if second in kwargs:
            kwargs[second] = _second(second, kwargs[second], amplitude, records)
        elif rest:
            rest[0] = _second(second, rest[0], amplitude, records)
        if left_out := _left_out(signature, (rig, *rest), kwargs):
            raise InputError(f"{left_out[0]}: missing; {example} is accepted")
        return function(rig, *rest, **kwargs)

    return with_rig


def _left_out(
    signature: inspect.Signature, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> list[str]:
    """Arguments that a call needs and does not give; a keyword too many Python itself tells."""
    try:
        given = signature.bind_partial(*args, **kwargs).arguments
    except TypeError:
        return []
    needed = [p for p in signature.parameters.values() if p.default is p.empty]
    return [p.name for p in needed if p.name not in given and p.kind is not p.VAR_KEYWORD]


def _told(
    signature: inspect.Signature, rig: Oscillator, rest: list[Any], kwargs: Mapping[str, Any]
) -> bool:
    """Whether the amplitude is among the arguments behind a case.

    It is if it is named, or if a single value stands in its place and nothing that the function
    needs is missing then.
    """
    if "amplitude" in kwargs:
        return True
    if not rest or _is_list(rest[0]):
        return False
    try:
        signature.bind(rig, *rest, **kwargs)
    except TypeError:
        return False
    return True


def _second(name: str, value: Any, amplitude: AnyShaking | Record | None, records: bool) -> Any:
    """The amplitude or the excitation, refused where it is something else."""
    if isinstance(value, Record):
        if records:
            return value
        raise _without_period(name)
    if name == "amplitude" or isinstance(value, Harmonic | Periodic):
        return value
    if isinstance(amplitude, Record) and _is_number(value):
        raise InputError(
            f"{name}: {shown(value)} beside a study whose shaking is a record, which has no "
            "frequency; the study alone, or with a Harmonic, is accepted"
        )
    if amplitude is not None and _is_number(value):
        return as_shaking(amplitude, "amplitude")[0].replace(frequency=value)
    alone = "" if amplitude is not None else " (beside a laboratory case a frequency is enough)"
    raise InputError(
        f"{name}: {shown(value)} is no excitation; Harmonic(amplitude, frequency) is accepted, "
        f'such as Harmonic("0.05 g", "2 Hz"){alone}'
    )


def _without_period(where: str) -> InputError:
    return InputError(
        f"{where}: a Record has no period, and what is asked for is a motion that repeats "
        "itself; a Harmonic or a Periodic is accepted, and simulate takes records"
    )


def is_rig(value: object) -> bool:
    """Whether something is one rig, or a text that should name one, rather than several."""
    pair = isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], Oscillator)
    carries = isinstance(getattr(value, "oscillator", None), Oscillator)
    return pair or carries or isinstance(value, Oscillator | str | Path)


def rig_name(value: Any, otherwise: str) -> str:
    """The code of a laboratory case, the name of a study; `otherwise` of a rig without one."""
    if _is_study(value):
        from vibroimpact.model.study import read_rig

        return read_rig(Path(value)).name
    if isinstance(value, str):
        from vibroimpact.model import laboratory

        with contextlib.suppress(InputError):
            return laboratory.case(value).code
        return value
    return str(getattr(value, "code", otherwise))


def _is_study(value: object) -> bool:
    """Whether it is the path of a study file; of text, only what ends as one does."""
    return isinstance(value, Path) or (isinstance(value, str) and value.lower().endswith(".toml"))


def _is_number(value: object) -> bool:
    """Whether it may be one number: also a text or a quantity with a unit."""
    return not (value is None or _is_list(value) or callable(value))


def _is_list(value: object) -> bool:
    """Whether it holds several values; a numpy scalar and a quantity do not."""
    if getattr(value, "ndim", None) == 0 or isinstance(value, str):
        return False
    if hasattr(value, "magnitude"):
        return _is_list(value.magnitude)
    return hasattr(value, "__len__") or hasattr(value, "__next__")
