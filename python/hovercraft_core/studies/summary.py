"""What all runs of a study together say: summary.json."""
import json
import math
import shlex

import numpy as np

from .results import write_whole

MOST_BINS = 20       # of a parameter, for its sensitivity
LEAST_PER_BIN = 8
WORST = 5            # runs that are named for each metric


class Table:
    """The rows of runs.csv as columns. `parameters`: by key numbers (of texts and the like their index among those that occur, sorted);
    `metrics`: by name numbers, nan where there is none."""

    def __init__(self, plan, rows):
        self.plan = plan
        keys = plan.columns()[2:]
        self.status = [row[2] for row in rows]
        self.messages = [row[-1] for row in rows]
        self.parameters = {key: _numbers([row[4 + i] for row in rows]) for i, key in enumerate(keys)}
        self.metrics = {metric.name: np.array([float(row[4 + len(keys) + i] or "nan") for row in rows])
                        for i, metric in enumerate(plan.metrics)}


def _numbers(cells):
    values = [json.loads(cell) for cell in cells]
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return np.array([float(value) for value in values])
    order = {cell: i for i, cell in enumerate(sorted(set(cells)))}
    return np.array([float(order[cell]) for cell in cells])


def first_order(parameter, values):
    """The first-order index: the part of the variance of the values that is that of their mean given the parameter.

    By bins of equally many runs (the correlation ratio), freed of its bias: with nothing to be found it is 0 in the mean. None if there
    are too few runs, or if nothing varies.
    """
    known = np.isfinite(values)
    parameter, values = parameter[known], values[known]
    levels = np.unique(parameter)
    bins = min(len(levels), MOST_BINS, len(values) // LEAST_PER_BIN)
    if bins < 2 or float(np.ptp(values)) == 0.0:
        return None
    if len(levels) <= MOST_BINS and bins == len(levels):
        of = np.searchsorted(levels, parameter)
    else:
        of = np.empty(len(values), dtype=np.int64)
        of[np.argsort(parameter, kind="stable")] = np.arange(len(values)) * bins // len(values)
    scaled = (values - np.mean(values)) / np.std(values)
    between = sum(float(np.count_nonzero(of == i)) * float(np.mean(scaled[of == i]))**2 for i in range(bins))
    total = float(np.sum(scaled * scaled))
    index = 1.0 - (total - between) / total * (len(values) - 1) / (len(values) - bins)
    return max(0.0, index)


def _of_metric(values, worst):
    known = values[np.isfinite(values)]
    if not len(known):
        return {"count": 0}
    order = np.argsort(-values if worst == "max" else values, kind="stable")
    mean = math.fsum(known.tolist()) / len(known)
    return {"count": len(known), "mean": mean,
            "std": math.sqrt(math.fsum(((known - mean)**2).tolist()) / max(1, len(known) - 1)),
            "min": float(np.min(known)), "max": float(np.max(known)),
            "percentiles": {str(q): float(np.percentile(known, q)) for q in (1, 5, 25, 50, 75, 95, 99)},
            "worst": worst, "worst_runs": [int(run) for run in order[:WORST] if np.isfinite(values[run])]}


def summary(table):
    """A dict for JSON: status, metrics, first-order sensitivity of each metric to each parameter."""
    plan = table.plan
    counts = {status: table.status.count(status) for status in sorted(set(table.status), key=lambda one: (one != "ok", one))}
    return {"runs": plan.runs, "seed": plan.seed, "design": plan.design, "status": counts,
            "metrics": {metric.name: _of_metric(table.metrics[metric.name], metric.worst) for metric in plan.metrics},
            "first_order": {metric.name: {key: first_order(column, table.metrics[metric.name]) for key, column in table.parameters.items()}
                            for metric in plan.metrics},
            "failed_runs": [run for run, status in enumerate(table.status) if status != "ok"][:100]}


def command(study, run):
    """What flies a run again."""
    return f"rosrun hovercraft_sim study.py {shlex.quote(study)} --run {run} -o run_{run}.bag"


def write(folder, found):
    """summary.json"""
    write_whole(folder.file("summary.json"), json.dumps(found, indent=2, allow_nan=False) + "\n")
