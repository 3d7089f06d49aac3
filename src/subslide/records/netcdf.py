"""Records: NetCDF files of solved runs, written whole or not at all, with a checksum that readers verify."""

import hashlib
import json
import os
from pathlib import Path

import netCDF4
import numpy as np

from subslide.files import RecordError, replacing
from subslide.records import variables as layout
from subslide.records.variables import Variable

CHECKSUM = "checksum"
COMPRESSED_FROM = 1 << 16
"""Bytes from which a variable is compressed: below it, the gain is less than what chunks cost."""


def write(path: Path | str, runs: list) -> None:
    """Nothing; `path` holds the record of the runs (results of `solver.solve`), read back and verified."""
    found = layout.variables(runs)
    attrs = layout.attributes(runs, found)
    attrs[CHECKSUM] = digest(found, attrs)
    with replacing(path) as temporary:
        _store(temporary, found, attrs)
        read(temporary)


def read(path: Path | str) -> tuple[dict[str, Variable], dict]:
    """Variables by name, and global attributes, of a record; RecordError if its checksum does not match.

    This is the plain reader; `subslide.results` gives xarray datasets.
    """
    path = Path(path)
    if not path.is_file():
        raise RecordError(f"{path}: there is no such record")
    try:
        with netCDF4.Dataset(os.fspath(path)) as data:
            data.set_auto_maskandscale(False)
            found = {
                name: Variable(v.dimensions, _values(v), {key: v.getncattr(key) for key in v.ncattrs()})
                for name, v in data.variables.items()
            }
            attrs = {key: data.getncattr(key) for key in data.ncattrs()}
    except (OSError, RuntimeError, UnicodeDecodeError, IndexError, ValueError) as error:
        raise RecordError(f"{path}: the file is damaged or not a NetCDF file ({error})") from None
    if CHECKSUM not in attrs:
        raise RecordError(f"{path}: not a record of subslide: it has no checksum")
    if attrs[CHECKSUM] != digest(found, attrs):
        raise RecordError(f"{path}: the record is damaged: its content does not match its checksum")
    return found, attrs


def digest(found: dict[str, Variable], attrs: dict) -> str:
    """SHA-256 (hex) over every variable and attribute in a fixed order, but for the checksum itself."""
    total = hashlib.sha256(_attrs_text({k: v for k, v in attrs.items() if k != CHECKSUM}))
    for name in sorted(found):
        dims, values, own = found[name]
        total.update(json.dumps([name, list(dims), list(values.shape)]).encode() + _attrs_text(own))
        if values.dtype.kind == "O":
            total.update(json.dumps([str(value) for value in values.ravel()]).encode())
        else:
            total.update(values.dtype.str.encode())
            total.update(np.ascontiguousarray(values).data)
    return total.hexdigest()


def _values(variable) -> np.ndarray:
    values = variable[...]
    return np.asarray(values, dtype=object if variable.dtype is str else None)


def _attrs_text(attrs: dict) -> bytes:
    """Bytes of attributes, the same before and after they have been in a file."""
    plain = {key: np.asarray(value).tolist() for key, value in attrs.items()}
    return json.dumps(plain, sort_keys=True).encode()


def _store(path: Path, found: dict[str, Variable], attrs: dict) -> None:
    with netCDF4.Dataset(os.fspath(path), "w", format="NETCDF4") as data:
        for name, variable in found.items():
            for dim, size in zip(variable.dims, variable.values.shape, strict=True):
                if dim not in data.dimensions:
                    data.createDimension(dim, size)
            text = variable.values.dtype.kind == "O"
            own = dict(variable.attrs)
            target = data.createVariable(
                name,
                str if text else variable.values.dtype,
                variable.dims,
                fill_value=own.pop("_FillValue", None),
                compression="zlib" if not text and variable.values.nbytes >= COMPRESSED_FROM else None,
                complevel=1,
            )
            target.setncatts(own)
            target[...] = variable.values
        data.setncatts(attrs)
