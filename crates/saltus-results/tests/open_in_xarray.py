#!/usr/bin/env python3
"""Opens NetCDF-4 files of saltus in xarray, by the engines h5netcdf and netcdf4.

    open_in_xarray.py FILE.nc [FILE.nc ...]         both engines see the same, to the bit, with units
    open_in_xarray.py --expect BITS.json FILE.nc    and it is what was written

BITS.json, which the test `opens_in_xarray` writes, has for each variable its dimensions, type and content
(bytes, little-endian, as hexadecimal digits; or a list of texts), and the attributes. Needs xarray, h5netcdf, h5py and netCDF4:

    python3 -m venv venv && venv/bin/pip install xarray h5netcdf h5py netCDF4
    SALTUS_PYTHON=venv/bin/python cargo test -p saltus-results --test main -- dataset:: --ignored
"""

import argparse
import json
import sys

import numpy as np
import xarray as xr

ENGINES = ("h5netcdf", "netcdf4")


def is_text(array):
    """Whether an array holds texts, which are objects to NumPy."""
    return array.dtype.kind in "OUT"


def content(array):
    """The bytes of an array, whatever the byte order of this machine; or the list of its texts."""
    values = np.asarray(array)
    if is_text(values):
        assert all(isinstance(text, str) for text in values.flat), "not all texts are texts"
        return list(values.flat)
    return values.astype(values.dtype.newbyteorder("<")).tobytes().hex()


def plain(value):
    """An attribute as JSON would have it."""
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else value


def attributes(thing):
    """The attributes of a dataset or a variable as JSON would have them."""
    return {key: plain(value) for key, value in thing.attrs.items()}


def check_file(path):
    """Opens `path` by both engines, compares what they see, and returns the dataset."""
    one, two = (xr.open_dataset(path, engine=engine).load() for engine in ENGINES)
    assert dict(one.sizes) == dict(two.sizes), f"{path}: sizes differ between the engines"
    assert set(one.variables) == set(two.variables), f"{path}: variables differ between the engines"
    for name in one.variables:
        a, b = one[name], two[name]
        assert a.dims == b.dims and is_text(a) == is_text(b), f"{path}: {name} differs between the engines"
        assert is_text(a) or a.dtype == b.dtype, f"{path}: {name} differs between the engines"
        assert content(a) == content(b), f"{path}: values of {name} differ between the engines"
        assert attributes(a) == attributes(b), f"{path}: attributes of {name} differ"
        if name in one.dims and not is_text(a):
            told = a.attrs.get("units") or a.attrs.get("flag_meanings")
            assert told, f"{path}: the coordinate {name} has neither units nor meanings"
        flags = a.attrs.get("flag_meanings")
        if flags is not None:
            values = np.atleast_1d(a.attrs["flag_values"])
            assert values.dtype == a.dtype or a.dtype == bool, f"{path}: the flags of {name} have another type"
            assert len(flags.split()) == len(values), f"{path}: flags of {name} without a meaning"
            assert np.isin(a, values).all(), f"{path}: {name} has values without a meaning"
    assert attributes(one) == attributes(two), f"{path}: global attributes differ between the engines"
    assert one.attrs["Conventions"].startswith("CF-"), f"{path}: no CF conventions"
    return one


def check_expected(dataset, expected):
    """Compares `dataset` with what was written."""
    assert set(dataset.variables) == set(expected["variables"])
    for name, wanted in expected["variables"].items():
        variable = dataset[name]
        assert list(variable.dims) == wanted["dimensions"], f"{name}: {variable.dims}"
        kind = "text" if is_text(variable) else variable.dtype
        assert kind == wanted["type"], f"{name}: {variable.dtype}"
        assert content(variable) == wanted["content"], f"values of {name} have changed"
        for key, value in wanted["attributes"].items():
            found = attributes(variable).get(key)
            assert found == value, f"{name}.{key}: {found!r}"
    for key, value in expected["attributes"].items():
        found = attributes(dataset).get(key)
        assert found == value, f"{key}: {found!r:.80}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--expect", metavar="BITS.json", help="what the file must hold")
    parser.add_argument("files", metavar="FILE.nc", nargs="+")
    arguments = parser.parse_args()
    for path in arguments.files:
        dataset = check_file(path)
        if arguments.expect:
            with open(arguments.expect, encoding="utf-8") as file:
                check_expected(dataset, json.load(file))
        sizes = ", ".join(f"{name} {length}" for name, length in dataset.sizes.items())
        print(f"{path}: {len(dataset.variables)} variables over {sizes}; both engines agree")


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"error: {error}")
