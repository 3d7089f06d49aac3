"""Rasters that the scene `raster` cannot take, and odd ones that it can."""

import os
import random
from pathlib import Path

import netCDF4
import numpy as np
from fuzz_calling import ANY, BAD, GOOD, Input

RUN = "study: s\nfigures: none\ncells: 20\nt_end: 0.01\n"
N = 24
CENTRES = (np.arange(N) + 0.5) / N * 0.2 - 0.1
DEPTH = 0.03 * np.clip(1 - ((CENTRES - 0.02) / 0.05) ** 2 - (CENTRES[:, None] / 0.03) ** 2, 0, None)


def write(path: Path, **other) -> None:
    """Write a raster; `other` says what is not as it should be."""
    values = {"x": CENTRES, "y": CENTRES, "h2": DEPTH, **other.get("values", {})}
    dims = {"x": ("x",), "y": ("y",), "h2": ("y", "x"), **other.get("dims", {})}
    types = other.get("types", {})
    with netCDF4.Dataset(os.fspath(path), "w", format=other.get("format", "NETCDF4")) as data:
        for name, axes in dims.items():
            shape = np.shape(values[name])
            for axis, size in zip(axes, shape, strict=True):
                if axis not in data.dimensions:
                    data.createDimension(axis, size)
            options = {"fill_value": other["fill"]} if name == "h2" and "fill" in other else {}
            target = data.createVariable(name, types.get(name, "f8"), axes, **options)
            attrs = {"units": "m", **other.get("attrs", {}).get(name, {})}
            target.setncatts({key: value for key, value in attrs.items() if value is not None})
            target.set_auto_maskandscale(False)
            target[...] = values[name]


def _renamed(old: str, new: str):
    """Function that writes a raster and gives a variable another name."""

    def fill(folder: Path) -> None:
        write(folder / "r.nc")
        with netCDF4.Dataset(os.fspath(folder / "r.nc"), "a") as data:
            data.renameVariable(old, new)

    return fill


def spot(value: float, at: tuple[int, int] = (N // 2, N // 2)) -> np.ndarray:
    """Depths of which one is another."""
    depth = DEPTH.copy()
    depth[at] = value
    return depth


def moved(step: int, by: float) -> np.ndarray:
    """Coordinates of which one is off."""
    centres = CENTRES.copy()
    centres[step] += by
    return centres


WRONG = {
    "turned": {"values": {"h2": DEPTH[:, :20].T, "x": CENTRES[:20]}, "dims": {"h2": ("x", "y")}},
    "one dimension": {"values": {"h2": CENTRES * 0}, "dims": {"h2": ("x",)}},
    "three dimensions": {"values": {"h2": DEPTH[None]}, "dims": {"h2": ("t", "y", "x")}},
    "x of two dimensions": {"values": {"x": DEPTH}, "dims": {"x": ("y", "x")}},
    "other dimensions": {"dims": {"h2": ("b", "a")}},
    "km": {"attrs": {"h2": {"units": "km"}}},
    "degrees": {"attrs": {"x": {"units": "degrees_east"}}},
    "units are numbers": {"attrs": {"x": {"units": np.array([1, 2, 3])}}},
    "unit is a number": {"attrs": {"h2": {"units": 3.0}}},
    "unit is long": {"attrs": {"h2": {"units": "m" * 5000}}},
    "unit has an escape": {"attrs": {"h2": {"units": "\x1b[31mkm\n"}}},
    "nan": {"values": {"h2": spot(np.nan)}},
    "inf": {"values": {"h2": spot(np.inf)}},
    "nan in x": {"values": {"x": moved(3, np.nan)}},
    "inf in y": {"values": {"y": moved(3, np.inf)}},
    "negative": {"values": {"h2": spot(-1e-3)}},
    "tall": {"values": {"h2": spot(3.0)}},
    "taller than floats": {"values": {"h2": spot(1e308)}},
    "beyond the box": {"values": {"x": CENTRES * 100}},
    "unequal steps": {"values": {"x": moved(5, 0.004)}},
    "no step": {"values": {"x": CENTRES * 0}},
    "to and fro": {"values": {"x": np.abs(CENTRES)}},
    "one column": {"values": {"x": CENTRES[:1], "h2": DEPTH[:, :1]}},
    "no column": {"values": {"x": CENTRES[:0], "h2": DEPTH[:, :0]}},
    "texts": {"types": {"h2": str}, "values": {"h2": np.full((N, N), "a", dtype=object)}},
    "letters": {"types": {"x": "S1"}, "values": {"x": np.full(N, "a", dtype="S1")}},
    "masked": {"fill": 0.03, "values": {"h2": spot(0.03)}},
    "missing by valid_range": {"attrs": {"h2": {"valid_range": np.array([0.0, 0.01])}}},
    "missing by missing_value": {"attrs": {"h2": {"missing_value": float(DEPTH.max())}}},
    "scaled to nothing": {"attrs": {"x": {"scale_factor": 0.0}}},
    "scale is text": {"attrs": {"h2": {"scale_factor": "two"}}},
    "offset below": {"attrs": {"h2": {"add_offset": -1.0}}},
}  # fmt: skip

RIGHT = {
    "classic": {"format": "NETCDF3_CLASSIC"},
    "64 bit": {"format": "NETCDF3_64BIT_OFFSET"},
    "classic model": {"format": "NETCDF4_CLASSIC"},
    "float32": {"types": {"x": "f4", "y": "f4", "h2": "f4"}},
    "falling": {"values": {"x": CENTRES[::-1]}},
    "packed": {
        "types": {"h2": "i2"},
        "values": {"h2": np.round(DEPTH / 1e-5)},
        "attrs": {"h2": {"scale_factor": 1e-5, "add_offset": 0.0}},
    },
    "no units": {"attrs": {"h2": {"units": None}, "x": {"units": None}}},
    "metres": {"attrs": {"h2": {"units": "metres"}}},
    "valid_range": {"attrs": {"h2": {"valid_range": np.array([0.0, 1.0])}}},
}


def _cut(form: str, share: float):
    """Function that writes a raster and cuts it short."""

    def fill(folder: Path) -> None:
        write(folder / "r.nc", format=form)
        content = (folder / "r.nc").read_bytes()
        (folder / "r.nc").write_bytes(content[: int(share * len(content))])

    return fill


def _changed(seed: int):
    """Function that writes a raster and changes some of its bytes."""

    def fill(folder: Path) -> None:
        rng = random.Random(seed)
        write(folder / "r.nc", format=rng.choice(["NETCDF4", "NETCDF3_CLASSIC"]))
        content = bytearray((folder / "r.nc").read_bytes())
        for _ in range(rng.randrange(1, 6)):
            content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
        (folder / "r.nc").write_bytes(content)

    return fill


def _huge(folder: Path) -> None:
    """A small file that says it holds 80 GB."""
    with netCDF4.Dataset(os.fspath(folder / "r.nc"), "w") as data:
        for axis in "yx":
            data.createDimension(axis, 100_000)
            data.createVariable(axis, "f8", (axis,))[:] = (np.arange(100_000) + 0.5) * 2e-6 - 0.1
        data.createVariable("h2", "f8", ("y", "x"), chunksizes=(1000, 1000), fill_value=0.0)


NO_RASTERS = {
    "empty": lambda folder: (folder / "r.nc").write_bytes(b""),
    "text": lambda folder: (folder / "r.nc").write_text("x,y,h2\n0,0,1\n"),
    "magic alone": lambda folder: (folder / "r.nc").write_bytes(b"\x89HDF\r\n\x1a\n"),
    "classic magic alone": lambda folder: (folder / "r.nc").write_bytes(b"CDF\x01"),
    "classic magic and noise": lambda folder: (folder / "r.nc").write_bytes(
        b"CDF\x01" + bytes(range(256)) * 4
    ),
    "folder": lambda folder: (folder / "r.nc").mkdir(),
    "pipe": lambda folder: os.mkfifo(folder / "r.nc"),
    "nothing": lambda folder: None,
    "dangling": lambda folder: (folder / "r.nc").symlink_to("no.nc"),
    "80 GB": _huge,
    "no variables": lambda folder: netCDF4.Dataset(os.fspath(folder / "r.nc"), "w").close(),
    **{
        f"{name} has another name": _renamed(name, other)
        for name, other in (("x", "lon"), ("y", "lat"), ("h2", "height"))
    },
}


def rasters(rng: random.Random, count: int) -> list[Input]:
    """Rasters by `check` of a study, and by `run`."""
    inputs = []

    def add(name: str, ends: str, fill, file: str = "r.nc", more: str = "") -> None:
        study = RUN + f"scene: raster\nscene_options: {{file: '{file}'{more}}}\n"

        def make(folder: Path) -> None:
            fill(folder)
            (folder / "c.yaml").write_text(study, encoding="utf-8")

        by_run = ends == BAD and rng.random() < 0.4 and "," not in file
        options = [
            "--scene=raster",
            f"--scene-options=file={file}",
            "--cells=20",
            "--t-end=0.01",
            "-o",
            "o.nc",
        ]
        words = ["run", *options] if by_run and not more else ["check", "c.yaml"]
        inputs.append(Input(f"raster: {name}", words, ends, ("r.nc", "file", "scene_options"), make))

    for name, fault in WRONG.items():
        add(name, BAD, lambda folder, fault=fault: write(folder / "r.nc", **fault))
    for name, kind in RIGHT.items():
        add(name, GOOD, lambda folder, kind=kind: write(folder / "r.nc", **kind))
    for name, fill in NO_RASTERS.items():
        add(name, BAD, fill)
    for share in (0.0005, 0.3, 0.6, 0.9, 0.999):
        add(f"classic cut to {share}", BAD, _cut("NETCDF3_CLASSIC", share))
        add(f"cut to {share}", BAD, _cut("NETCDF4", share))
    for file in ("a,b.nc", "größe.nc", "a b.nc", "é'.nc".replace("'", ""), "[1].nc", "x=y.nc"):
        add(f"name {file}", GOOD, lambda folder, file=file: write(folder / file), file)
    add("another content", BAD, lambda folder: write(folder / "r.nc"), more=f", sha256: '{'0' * 64}'")
    add("no content", BAD, lambda folder: write(folder / "r.nc"), more=", sha256: abc")
    rng.shuffle(inputs)
    inputs = inputs[: 3 * count // 4]
    while len(inputs) < count:
        seed = rng.randrange(1 << 30)
        add(f"bytes changed by {seed}", ANY, _changed(seed))
    return inputs
