"""One PyClaw run of the grains alone (one layer, no friction), in the virtual environment of the peers.

Called in an empty folder that holds column.txt: python pyclaw_column.py '{"half_width": 0.3, ...}'. Writes pyclaw.json:
for each time the seconds and steps so far, and the depth (m) of each cell.
"""

import json
import logging
import sys
import time

import numpy as np
from clawpack import pyclaw, riemann


def make_solver(case):
    """Return Godunov's method, one direction after the other, with GeoClaw's one-layer Riemann solver.

    That solver is the one of PyClaw's that takes a dry bed; at second order PyClaw does not (depths turn negative).
    """
    solver = pyclaw.ClawSolver2D(riemann.sw_aug_2D)
    solver.fwave = True
    solver.num_waves = 3
    solver.order = 1
    solver.dimensional_split = True
    solver.cfl_desired, solver.cfl_max = case["cfl"], case["cfl_max"]
    solver.dt_initial = case["dt_initial"]
    for name in ("bc_lower", "bc_upper", "aux_bc_lower", "aux_bc_upper"):
        getattr(solver, name)[:] = [pyclaw.BC.extrap] * 2
    return solver


def column(case):
    """Return the column at rest on a flat bottom."""
    with open("column.txt", encoding="utf-8") as file:
        cells, _, depth = file.readline().split()
        fractions = np.loadtxt(file)
    half = case["half_width"]
    domain = pyclaw.Domain([pyclaw.Dimension(-half, half, int(cells), name=name) for name in "xy"])
    state = pyclaw.State(domain, 3, 1)
    state.problem_data.update(grav=case["g"], dry_tolerance=case["dry_tolerance"], sea_level=0.0)
    state.aux[:] = 0.0
    state.q[:] = 0.0
    state.q[0] = float(depth) * fractions
    return pyclaw.Solution(state, domain)


def run(case):
    """Return the frames: dicts of time (s), seconds, steps and depth (cells, cells)."""
    solver, solution = make_solver(case), column(case)
    solver.setup(solution)
    frames, seconds, steps = [], 0.0, 0
    for stop in case["times"]:
        started = time.perf_counter()
        status = solver.evolve_to_time(solution, stop)
        seconds += time.perf_counter() - started
        steps += status["numsteps"]
        depth = solution.state.q[0].tolist()
        frames.append({"time": stop, "seconds": seconds, "steps": steps, "depth": depth})
    return frames


if __name__ == "__main__":
    logging.disable()
    found = run(json.loads(sys.argv[1]))
    with open("pyclaw.json", "w", encoding="utf-8") as output:
        json.dump(found, output)
