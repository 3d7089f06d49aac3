"""Records: NetCDF files of solved runs, written whole or not at all, with a checksum that readers verify."""

import hashlib
import json
import os
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

import netCDF4
import numpy as np

from subslide.files import RecordError, replacing
from subslide.records import provenance
from subslide.records import variables as layout
from subslide.records.variables import Variable

if TYPE_CHECKING:
    from subslide.solver.run import Run

CHECKSUM = "checksum"
ENCODING = "_Encoding"
"""Attribute of a table of characters, by which readers know that its rows are texts."""

COMPRESSED_FROM = {False: 1 << 16, True: 1 << 12}
"""Bytes from which a variable is compressed: below it, the gain is less than what chunks cost. Of summaries, whose
numbers are rounded and whose texts are mostly alike, much less is left."""


def write(path: Path | str, runs: list["Run"], keep: str = "all", first: int = 0) -> None:
    """Write the record of runs, read back and verified.

    Parameters
    ----------
    path
        File, which is written whole or not at all.
    runs
        Results of `solver.solve`, as `records.thinning.kept` gives them.
    keep
        What is kept of each, one of `subslide.keys.kept.WORDS`, which the record states.
    first
        Number of the first run within its study; the others follow.

    Raises
    ------
    RecordError
        If what was read back is not what was written.
    """
    variables, attrs = contents(runs, keep, first)
    with replacing(path) as temporary:
        _store(temporary, variables, attrs, small=keep == "summary")
        read(temporary, names=())


def contents(runs: list["Run"], keep: str = "all", first: int = 0) -> tuple[dict[str, Variable], dict]:
    """Return what `write` writes: variables by name and global attributes, the checksum among them.

    Parameters
    ----------
    runs, keep, first
        As for `write`.

    Returns
    -------
    tuple of dict
        Variables and attributes, as `read` gives them.
    """
    variables = layout.variables(runs, first)
    attrs = provenance.attributes(runs, variables, keep)
    attrs[CHECKSUM] = digest(variables, attrs)
    return variables, attrs


def read(
    path: Path | str, names: Collection[str] | None = None, vouched: bool = False
) -> tuple[dict[str, Variable], dict]:
    """Return the variables by name, and the global attributes, of a record.

    This is the plain reader; `subslide.results` gives xarray datasets.

    Parameters
    ----------
    path
        The file.
    names
        Names of the variables that are wanted, all without it; what the record lacks is left out. The others are
        verified too, one after the other, and do not stay in memory.
    vouched
        Whether the checksum beside the file vouches for it: then no others are read.

    Returns
    -------
    tuple of dict
        Variables and attributes.

    Raises
    ------
    RecordError
        If the file is not a whole record, as its checksum tells.
    """
    path = Path(path)
    if not path.is_file():
        raise RecordError(f"{path}: there is no such record")
    wanted: dict[str, Variable] = {}
    try:
        # by its bytes: the library takes a backslash in a path for a slash
        with netCDF4.Dataset("record", memory=path.read_bytes()) as data:
            data.set_auto_maskandscale(False)
            data.set_auto_chartostring(False)
            attrs = {key: data.getncattr(key) for key in data.ncattrs()}
            total = _digest_of(attrs)
            for name in sorted(data.variables):
                if vouched and names is not None and name not in names:
                    continue
                variable = _read(data.variables[name])
                if not vouched:
                    _add(total, name, variable)
                if names is None or name in names:
                    wanted[name] = variable
            variables = {name: wanted[name] for name in data.variables if name in wanted}
    except (OSError, RuntimeError, AttributeError, IndexError, ValueError, TypeError) as error:
        raise RecordError(f"{path}: the file is damaged or not a NetCDF file ({error})") from None
    if CHECKSUM not in attrs:
        raise RecordError(f"{path}: not a record of subslide: it has no checksum")
    if not vouched and attrs[CHECKSUM] != total.hexdigest():
        raise RecordError(f"{path}: the record is damaged: its content does not match its checksum")
    return variables, attrs


def digest(variables: dict[str, Variable], attrs: dict) -> str:
    """Return the checksum of a record, over every variable and attribute in a fixed order but the checksum itself.

    Parameters
    ----------
    variables
        Variables by name.
    attrs
        Global attributes by name.

    Returns
    -------
    str
        SHA-256 (hex).
    """
    total = _digest_of(attrs)
    for name in sorted(variables):
        _add(total, name, variables[name])
    return total.hexdigest()


def _digest_of(attrs: dict) -> "hashlib._Hash":
    """Return the hash of the attributes of a record but the checksum itself, to which variables are added."""
    return hashlib.sha256(_attrs_text({key: value for key, value in attrs.items() if key != CHECKSUM}))


def _add(total: "hashlib._Hash", name: str, variable: Variable) -> None:
    """Put a variable into a hash."""
    dims, values, about = variable
    total.update(json.dumps([name, list(dims), list(values.shape)]).encode() + _attrs_text(about))
    if values.dtype.kind == "O":
        total.update(json.dumps(list(map(str, values.ravel().tolist()))).encode())
    else:
        total.update(values.dtype.str.encode())
        total.update(np.ascontiguousarray(values).data)


def _read(variable: netCDF4.Variable) -> Variable:
    """Return a variable of a file; texts as objects, also where they are a table of characters."""
    dims, values = variable.dimensions, variable[...]
    about = {key: variable.getncattr(key) for key in variable.ncattrs()}
    if about.pop(ENCODING, None):
        rows = np.ascontiguousarray(values).view(f"S{values.shape[-1]}")[..., 0].ravel().tolist()
        texts = {row: row.decode() for row in set(rows)}  # mostly of few kinds
        decoded = np.fromiter(map(texts.__getitem__, rows), object, len(rows))
        return Variable(dims[:-1], decoded.reshape(values.shape[:-1]), about)
    return Variable(dims, np.asarray(values, dtype=object if variable.dtype is str else None), about)


def _attrs_text(attrs: dict) -> bytes:
    """Return bytes of attributes, the same before and after they have been in a file."""
    plain = {key: np.asarray(value).tolist() for key, value in attrs.items()}
    return json.dumps(plain, sort_keys=True).encode()


def _store(path: Path, variables: dict[str, Variable], attrs: dict, small: bool) -> None:
    """Write variables and attributes to a NetCDF file; texts as tables of characters, as the classic model has them.

    small: whether little is left of what is compressed.
    """
    with netCDF4.Dataset(os.fspath(path), "w", format="NETCDF4") as data:
        data.set_auto_chartostring(False)
        for name, variable in variables.items():
            dims, values, about = variable.dims, variable.values, dict(variable.attrs)
            if values.dtype.kind == "O":
                texts = np.strings.encode(values.astype(str), "utf-8")
                dims = (*dims, f"{name}_length")  # one of its own: libraries that join files let it grow
                values = texts.view("S1").reshape(*texts.shape, texts.itemsize)
                about[ENCODING] = "utf-8"
            for dim, size in zip(dims, values.shape, strict=True):
                if dim not in data.dimensions:
                    data.createDimension(dim, size)
            target = data.createVariable(
                name,
                values.dtype,
                dims,
                fill_value=about.pop("_FillValue", None),
                compression="zlib" if values.nbytes >= COMPRESSED_FROM[small] else None,
                complevel=1,
            )
            target.setncatts(about)
            target.set_auto_chartostring(False)
            target[...] = values
        data.setncatts(attrs)
