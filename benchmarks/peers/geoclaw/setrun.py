"""Data files of one GeoClaw run of the paper's column, written into the working directory.

Called with the virtual environment of the peers: python setrun.py '{"cells": 200, ...}' (run.py holds the values).
"""

import json
import sys

from clawpack.clawutil.data import ClawRunData
from clawpack.geoclaw.topotools import Topography


def setrun(case):
    """Return the data of a case: a box of cells x cells on one level, two layers, no friction, open boundaries."""
    data = ClawRunData("geoclaw", 2)
    claw = data.clawdata
    claw.lower[:] = [-case["half_width"]] * 2
    claw.upper[:] = [case["half_width"]] * 2
    claw.num_cells[:] = [case["cells"]] * 2
    claw.num_eqn = 6
    claw.num_aux = 3  # bottom, and the initial depth of each layer
    claw.num_waves = 6
    claw.limiter = ["mc"] * 6
    claw.use_fwaves = True
    claw.num_ghost = 2
    claw.order = case["order"]
    claw.transverse_waves = case["transverse_waves"]
    claw.source_split = "none"
    claw.bc_lower[:] = claw.bc_upper[:] = ["extrap"] * 2
    claw.dt_variable = True
    claw.dt_initial = case["dt_initial"]
    claw.cfl_desired = case["cfl"]
    claw.cfl_max = case["cfl_max"]
    claw.steps_max = 100_000
    claw.output_style = 2
    claw.output_times = [0.0, *case["times"]]
    claw.tfinal = case["times"][-1]
    claw.output_format = "binary64"
    claw.output_aux_components = "none"
    claw.verbosity = 0
    amr = data.amrdata
    amr.amr_levels_max = 1
    amr.aux_type = ["center"] * 3
    set_physics(data, case)
    return data


def set_physics(data, case):
    """Nothing; the geoclaw and multilayer parts of the data are set."""
    geo = data.geo_data
    geo.gravity = case["g"]
    geo.coordinate_system = 1
    geo.coriolis_forcing = False
    geo.friction_forcing = False
    geo.rho = case["densities"]
    geo.dry_tolerance = case["dry_tolerance"]
    data.topo_data.topofiles.append([2, "bottom.tt2"])
    layers = data.multilayer_data
    layers.num_layers = 2
    layers.eta = [case["level"], 0.0]
    layers.layer_index = 1  # of aux, from 0
    layers.eigen_method = case["eigen_method"]
    layers.inundation_method = case["inundation_method"]
    layers.check_richardson = False
    layers.wave_tolerance = [1.0, 1.0]  # for refinement, which is off


def flat_bottom(half_width):
    """Return the topography z = 0 over more than the box."""
    bottom = Topography(topo_func=lambda x, y: 0.0 * x)
    side = [-2.0 * half_width, 0.0, 2.0 * half_width]
    bottom.x = bottom.y = side
    return bottom


if __name__ == "__main__":
    case = json.loads(sys.argv[1])
    flat_bottom(case["half_width"]).write("bottom.tt2", topo_type=2)
    setrun(case).write()
