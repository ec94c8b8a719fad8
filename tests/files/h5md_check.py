# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the file that h5md_test.cpp wrote, as a stranger would, and checks it against the H5MD 1.1 specification."""

import sys

import h5py
import numpy as np

OBSERVABLES = ("potential_energy", "kinetic_temperature", "pxy_kinetic", "pxy_potential", "pxx_kinetic",
               "pxx_potential", "pyy_kinetic", "pyy_potential", "largest_kinetic_share")

with h5py.File(sys.argv[1], "r") as file:
    assert list(file["h5md"].attrs["version"]) == [1, 1]
    assert file["h5md/author"].attrs["name"] == b"somebody"
    assert file["h5md/creator"].attrs["name"] == b"lucy"
    assert file["h5md/creator"].attrs["version"] == b"1.2.3"
    assert file["parameters"].attrs["strain_rate"] == 0.5
    assert file["parameters"].attrs["thermostat"] == b"isoenergetic"

    series = file["observables/replica_01"]
    assert sorted(series) == sorted(OBSERVABLES)
    for number, name in enumerate(OBSERVABLES):
        element = series[name]
        assert set(element) == {"step", "time", "value"}
        np.testing.assert_array_equal(element["value"], np.arange(80) + 0.01 * number)
        assert element["step"] == series["potential_energy/step"], "not hard-linked"
        assert element["time"] == series["potential_energy/time"], "not hard-linked"
    assert series["potential_energy/step"].dtype.kind == "i"

    group = file["particles/replica_01"]
    assert group["position/value"].shape == (3, 4, 2)
    position, momentum = group["position/value"][...], group["momentum/value"][...]
    laboratory = momentum.copy()
    laboratory[:, :, 0] += 0.5 * position[:, :, 1]
    np.testing.assert_array_equal(group["velocity/value"], laboratory)
    np.testing.assert_allclose(position[2].ravel(), 0.125 * np.arange(8) + 0.02, rtol=1e-15)
    np.testing.assert_array_equal(group["position/step"], [0, 20, 40])
    np.testing.assert_array_equal(group["position/time"], [0, 1, 2])

    box = group["box"]
    assert box.attrs["dimension"] == 2
    assert list(box.attrs["boundary"]) == [b"periodic", b"periodic"]
    np.testing.assert_array_equal(box["edges/value"][1], [[2, 0], [0.25, 2]])
    np.testing.assert_array_equal(group["lees_edwards/offset/value"][:, 0], [0, 0.25, 0.5])
    np.testing.assert_array_equal(group["lees_edwards/direction/value"][:, 0], [0, 0, 0])
    np.testing.assert_array_equal(group["lees_edwards/normal/value"][:, 0], [1, 1, 1])
    for element in ("velocity", "momentum", "box/edges", "lees_edwards/offset", "lees_edwards/direction",
                    "lees_edwards/normal"):
        assert group[element]["step"] == group["position/step"], element
        assert group[element]["time"] == group["position/time"], element
