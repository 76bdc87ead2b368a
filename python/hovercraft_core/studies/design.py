"""The design of a study: the values of each run, drawn once from the project's own noise."""
import itertools
import json
import warnings

import numpy as np

from .. import _core
from .distributions import BITS

DESIGNS = ("random", "latin", "sobol", "grid")
SOBOL_BITS = 30  # of scipy's points
MOST_RUNS = 10**7


def _words_random(plan, streams, count):
    return [_core.noise_bits(plan.seed, stream, count, 0) >> np.uint64(64 - BITS) for stream in streams]


def _words_latin(plan, streams, count):
    """One in each of `count` equal strata, in the order of another draw."""
    columns = []
    for stream in streams:
        strata = np.argsort(_core.noise_bits(plan.seed, stream, count, 1), kind="stable").tolist()
        within = (_core.noise_bits(plan.seed, stream, count, 0) >> np.uint64(64 - BITS)).tolist()
        columns.append(np.array([((stratum << BITS) + word) // count for stratum, word in zip(strata, within)], dtype=np.uint64))
    return columns


def _words_sobol(plan, streams, count):
    """Sobol's sequence with a random digital shift: scipy's own scrambling draws by numpy."""
    try:
        from scipy.stats.qmc import Sobol
    except ImportError:
        raise ValueError("design = sobol: needs scipy 1.7 or later (python3-scipy), which is not here; "
                         "random and latin need none") from None
    if not streams:
        return []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that the count is no power of two
        points = Sobol(d=len(streams), scramble=False).random(count)
    columns = []
    for i, stream in enumerate(streams):
        shift = _core.noise_bits(plan.seed, stream, 1, 2)[0] >> np.uint64(64 - BITS)
        columns.append(((points[:, i] * 2.0**SOBOL_BITS).astype(np.uint64) << np.uint64(BITS - SOBOL_BITS)) ^ shift)
    return columns


def draw(plan):
    """The rows of the design, each a list of the JSON texts of run, seed and the values of plan.keys.

    Keys of a grid are crossed with the points of the others: all combinations at the first point, then at the next.
    """
    drawn = [key for key in plan.vary if plan.vary[key][0] != "grid"]
    grids = [plan.vary[key][1] for key in plan.vary if plan.vary[key][0] == "grid"]
    streams = _core.noise_streams([f"study/{key}" for key in drawn])
    words = {"random": _words_random, "latin": _words_latin, "sobol": _words_sobol, "grid": _words_random}[plan.design]
    columns = {key: [json.dumps(value) for value in plan.vary[key][1].values(column)]
               for key, column in zip(drawn, words(plan, streams, plan.points))}
    cells = [[json.dumps(value) for value in combination] for combination in itertools.product(*grids)]
    grid_keys = [key for key in plan.vary if plan.vary[key][0] == "grid"]
    rows = []
    for point in range(plan.points):
        for combination in cells:
            run = len(rows)
            by_grid = dict(zip(grid_keys, combination))
            values = [columns[key][point] if key in columns else by_grid[key] for key in plan.vary]
            seed = values[plan.keys.index("seed")] if "seed" in plan.keys else str(plan.seed + run)
            rows.append([str(run), seed, *(value for key, value in zip(plan.vary, values) if key != "seed")])
    return rows
