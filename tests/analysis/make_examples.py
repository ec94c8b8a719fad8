# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small inputs for the plotting scripts: DIR/table.csv with every awkward row there is, its input.toml, and point files.

The images of DIR/point_001.h5 are offset by 6.5, those of point_zero.h5 and point_whole.h5 by rounding only.
"""

import pathlib
import sys

import h5py
import numpy as np

directory = pathlib.Path(sys.argv[1])

COLUMNS = ("particles,energy_per_particle,strain_rate,viscosity,viscosity_error,normal_stress,normal_stress_error,"
           "largest_kinetic_share,status")
ROWS = (
    "1024,1,0.1,2.63,0.01,56.3,0.2,0.009,ok",
    "1024,1,0.5,0.422,0.001,3.41,0.01,0.009,ok",
    "4096,1,0.5,0.421,0.001,3.42,0.01,0.003,ok",
    "1024,1,0.009,9.3,2.0,8600,4000,0.8,ok",
    "1024,1,0.02,8.9,12.0,660,nan,0.012,short",  # an error larger than the value, and none
    "1024,0.5,0.001,-0.1,0.3,-100,nan,0.008,ok",  # below zero with and without an upper bound
    "1024,0.5,0.002,-2,0.3,100,50,0.008,ok",  # two sigma below zero
    "1024,0.5,0,nan,nan,nan,nan,0.008,ok",
    "1024,0.5,0.3,nan,nan,nan,nan,nan,failed",
    "64,3,0.1,20,1,200,10,0.08,ok",  # an energy that nobody published
)
(directory / "table.csv").write_text("\n".join((COLUMNS,) + ROWS) + "\n", encoding="utf-8")

(directory / "input.toml").write_text("""[system]
density = 1.0
[kernel]
name = "lucy"
range = 3.0
[shear]
thermostat = "isoenergetic"
""", encoding="utf-8")

generator = np.random.default_rng(5)
count, length = 400, 20.0
for name, last_offset in (("001", 6.5), ("zero", 1.42e-14), ("whole", length - 1e-14)):
    with h5py.File(directory / f"point_{name}.h5", "w") as file:
        file.create_group("parameters").attrs.update({"energy_per_particle": 1.0, "strain_rate": 0.5})
        group = file.create_group("particles/replica_01")
        offsets = np.array([0.0, last_offset])
        lattice = np.stack(np.meshgrid(np.arange(20.0), np.arange(20.0)), axis=-1).reshape(-1, 2) + 0.5
        position = np.mod(lattice + 0.15 * generator.standard_normal((2, count, 2)), length)
        momentum = 0.7 * generator.standard_normal((2, count, 2))
        velocity = momentum.copy()
        velocity[:, :, 0] += 0.5 * position[:, :, 1]
        edges = np.array([[[length, 0.0], [offset, length]] for offset in offsets])
        for quantity, value in (("position", position), ("momentum", momentum), ("velocity", velocity), ("box/edges", edges),
                            ("lees_edwards/offset", offsets[:, None])):
            group[f"{quantity}/value"] = value
            group[f"{quantity}/time"] = np.array([10.0, 20.0])
            group[f"{quantity}/step"] = np.array([200, 400])
