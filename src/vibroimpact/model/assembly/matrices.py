"""Mass, damping and stiffness matrices from elsewhere, such as a finite element model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sized
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_list, check_path, is_list
from vibroimpact.errors import InputError, shown
from vibroimpact.model.assembly.names import check_part_name
from vibroimpact.model.validation import Model

_SYMMETRY = 1e-8
"""Largest asymmetry of a symmetric matrix, relative to its largest entry: digits that a file of
seven or eight digits does not have."""
_DEFINITE = 1e-9
"""Largest negative eigenvalue of a matrix that counts as positive semi-definite, relative to its
largest one after scaling to a unit diagonal."""

_MOST = 10_000
"""Largest number of degrees of freedom."""

Rows = tuple[tuple[float, ...], ...]


class Matrices(Model):
    """The linear part of an `Assembly` in matrices, with one row per degree of freedom.

    The equation of motion is M ü + C u̇ + K u = −M ι A(t) + forces, where u is relative to the
    base. The influence vector ι has the displacement of each degree of freedom if the base moves
    by 1.

    Parameters
    ----------
    names
        Names of the degrees of freedom.
    mass
        Mass matrix M in kg, symmetric and positive definite.
    damping
        Damping matrix C in N s/m, symmetric and positive semi-definite.
    stiffness
        Stiffness matrix K in N/m, symmetric and positive semi-definite.
    influence
        Influence vector ι.

    Raises
    ------
    InputError
        If a matrix is not of the right shape, not finite, not symmetric or not definite, or if a
        name is used twice.
    """

    names: tuple[str, ...]
    mass: Rows
    damping: Rows
    stiffness: Rows
    influence: tuple[float, ...]

    @classmethod
    def read(
        cls,
        mass: Any,
        damping: Any,
        stiffness: Any,
        names: Iterable[str] | None,
        influence: Any,
        folder: Path = Path(),
    ) -> Matrices:
        """Return the matrices from arrays, nested lists or files, checked.

        Parameters
        ----------
        mass, damping, stiffness
            Arrays, nested lists, sparse matrices of scipy, or paths of files (npz, npy or CSV). An
            npz file may contain several of them under these names. None for no damping, and for a
            stiffness that the npz file of the mass contains.
        names
            Names of the degrees of freedom, or None for "dof_1", "dof_2" and so on.
        influence
            Vector or path of a file, or None: that of the npz file of the mass, or ones.
        folder
            Folder to which paths are relative.
        """
        beside = mass if _is_npz(mass) else None
        m = _matrix(mass, "mass", None, folder)
        count = len(m)
        _check_definite(m, "mass", strict=True)
        if stiffness is None and not _holds(beside, "stiffness", folder):
            raise InputError("stiffness: missing; pass the stiffness matrix in N/m")
        k = _matrix(beside if stiffness is None else stiffness, "stiffness", count, folder)
        _check_definite(k, "stiffness")
        if damping is None and _holds(beside, "damping", folder):
            damping = beside
        c = np.zeros_like(m) if damping is None else _matrix(damping, "damping", count, folder)
        _check_definite(c, "damping")
        if influence is None and _holds(beside, "influence", folder):
            influence = beside
        iota = np.ones(count) if influence is None else _vector(influence, count, folder)
        if names is None and _holds(beside, "names", folder):
            names = [str(one) for one in _load(folder / Path(str(beside)), "names")]
        made = _names(names, count)
        # A matrix that is symmetric to rounding is made so exactly.
        m, c, k = (0.5 * (one + one.T) for one in (m, c, k))
        return cls(
            names=made, mass=_rows(m), damping=_rows(c), stiffness=_rows(k), influence=_row(iota)
        )


def _names(names: Iterable[str] | None, count: int) -> tuple[str, ...]:
    if names is None:
        return tuple(f"dof_{i + 1}" for i in range(count))
    labels = [
        check_part_name(one, f"names[{i}]") for i, one in enumerate(check_list(names, "names"))
    ]
    for i, one in enumerate(labels):
        if one in labels[:i]:
            raise InputError(f"names[{i}]: {one!r} is used twice; use each name once")
    if len(labels) != count:
        raise InputError(f"names: {len(labels)} names for {count} degrees of freedom; pass {count}")
    return tuple(labels)


def _rows(matrix: NDArray[np.float64]) -> Rows:
    return tuple(_row(row) for row in matrix)


def _row(row: NDArray[np.float64]) -> tuple[float, ...]:
    return tuple(float(one) + 0.0 for one in row)


def _matrix(value: Any, field: str, count: int | None, folder: Path) -> NDArray[np.float64]:
    """Return a symmetric matrix of finite numbers."""
    matrix = _array(value, field, folder)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not matrix.size:
        raise InputError(
            f"{field}: an array of the shape {matrix.shape}; pass a square matrix with one row per "
            "degree of freedom"
        )
    if count is not None and len(matrix) != count:
        raise InputError(
            f"{field}: {len(matrix)} rows, but the mass matrix has {count}; pass matrices of one "
            "size"
        )
    difference = np.abs(matrix - matrix.T)
    if difference.max() > _SYMMETRY * np.abs(matrix).max():
        i, j = (int(one) for one in np.unravel_index(difference.argmax(), matrix.shape))
        i, j = min(i, j), max(i, j)
        raise InputError(
            f"{field}: not symmetric; row {i + 1}, column {j + 1} is {matrix[i, j]:.9g}, but row "
            f"{j + 1}, column {i + 1} is {matrix[j, i]:.9g}; pass a symmetric matrix"
        )
    return matrix


def _check_definite(matrix: NDArray[np.float64], field: str, strict: bool = False) -> None:
    """Raise an error for a matrix that is not positive (semi-)definite."""
    diagonal = np.diag(matrix)
    if (diagonal < 0.0).any():
        row = int(diagonal.argmin()) + 1
        raise InputError(
            f"{field}: not positive {'' if strict else 'semi-'}definite; row {row}, column {row} "
            f"is {diagonal[row - 1]:.3g}; pass the matrix of a stable structure"
        )
    # A matrix of translations and rotations has units that differ from row to row.
    scale = np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    values, vectors = np.linalg.eigh(0.5 * (matrix + matrix.T) / np.outer(scale, scale))
    limit = _DEFINITE * max(float(np.abs(values).max()), 1e-300)
    least = float(values[0])
    if strict and least <= limit:
        row = int(np.abs(vectors[:, 0]).argmax()) + 1
        raise InputError(
            f"{field}: not positive definite; its least eigenvalue, scaled to a unit diagonal, is "
            f"{least:.3g}, in which row {row} has the largest part; eliminate degrees of freedom "
            "without a mass by static condensation"
        )
    if least < -limit:
        row = int(np.abs(vectors[:, 0]).argmax()) + 1
        raise InputError(
            f"{field}: not positive semi-definite; an eigenvalue, scaled to a unit diagonal, is "
            f"{least:.3g}, in which row {row} has the largest part; pass the matrix of a stable "
            "structure"
        )


def _vector(value: Any, count: int, folder: Path) -> NDArray[np.float64]:
    array = np.squeeze(_array(value, "influence", folder))
    array = array.reshape(-1) if array.ndim == 0 else array
    if array.shape != (count,):
        raise InputError(
            f"influence: an array of the shape {array.shape}; pass {count} numbers, one per degree "
            "of freedom"
        )
    return array


def _array(value: Any, field: str, folder: Path) -> NDArray[np.float64]:
    if isinstance(value, str | Path):
        value = _load(folder / check_path(value, field), field)
    elif hasattr(value, "toarray"):  # sparse, of scipy
        value = value.toarray()
    parts = [value, *value[:1]] if isinstance(value, list | tuple) else [value]
    for part in parts:
        if is_list(part) and isinstance(part, Sized) and len(part) > _MOST:
            raise InputError(f"{field}: {len(part)} numbers in a row; use at most {_MOST}")
    try:
        raw = np.asarray(value)
        if raw.dtype.kind not in "iuf":
            raise ValueError
        array = np.array(raw, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        raise InputError(
            f"{field}: {shown(value)} is not an array of real numbers; pass numbers in SI units in "
            "rows of equal length, or the path of an npz, npy or CSV file"
        ) from None
    if not np.isfinite(array).all():
        raise InputError(f"{field}: an entry is not finite; pass finite numbers")
    if array.size and np.abs(array).max() > 1e100:
        raise InputError(f"{field}: {np.abs(array).max():g} is too large; pass at most 1e+100")
    return array


def _is_npz(value: Any) -> TypeGuard[str | Path]:
    return isinstance(value, str | Path) and str(value).lower().endswith(".npz")


def _holds(file: Any, name: str, folder: Path) -> bool:
    """Return whether an npz file contains an array of this name."""
    if file is None:
        return False
    path = folder / check_path(file, name)
    archive: Mapping[str, Any] = _open(path, name)
    return name in archive


def _open(path: Path, field: str) -> Any:
    try:
        return np.load(path, allow_pickle=False)
    except OSError as error:
        raise InputError(
            f"{field}: {str(path)!r} cannot be read ({error.strerror or error}); pass the path of "
            "an npz, npy or CSV file"
        ) from None
    except (ValueError, EOFError):
        raise InputError(
            f"{field}: {str(path)!r} is not a file of numpy arrays; pass an npz, npy or CSV file"
        ) from None


def _load(path: Path, field: str) -> Any:
    kind = path.suffix.lower()
    if kind == ".npz":
        with _open(path, field) as held:
            names = list(held.files)
            if field not in names and len(names) != 1:
                raise InputError(
                    f"{field}: {str(path)!r} contains {', '.join(names) or 'nothing'}; name the "
                    f"array {field!r}"
                )
            return held[field if field in names else names[0]]
    if kind == ".npy":
        return _open(path, field)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(
            f"{field}: {str(path)!r} cannot be read ({error.strerror or error}); pass the path of "
            "an npz, npy or CSV file"
        ) from None
    except UnicodeDecodeError:
        raise InputError(
            f"{field}: {str(path)!r} is not UTF-8 text; pass an npz, npy or CSV file"
        ) from None
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        if ";" in line and "," in line:
            raise InputError(
                f"{field}: {str(path)!r}, line {number}: it has commas and semicolons; use a "
                "decimal point, and separate numbers by commas or blanks"
            )
        try:
            rows.append([float(one) for one in line.replace(";", " ").replace(",", " ").split()])
        except ValueError:
            raise InputError(
                f"{field}: {str(path)!r}, line {number}: {shown(line)} is not a row of numbers; "
                "use a decimal point, and separate numbers by commas or blanks"
            ) from None
        if len(rows[-1]) != len(rows[0]):
            raise InputError(
                f"{field}: {str(path)!r}, line {number}: {len(rows[-1])} numbers, but the first "
                f"row has {len(rows[0])}; write rows of equal length"
            )
    return rows
