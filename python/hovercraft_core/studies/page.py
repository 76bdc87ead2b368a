"""study.html: what came of a study, as one file that needs no network."""
import html

import numpy as np

from .flight import Flyer
from .flown import Failure
from .results import write_whole
from .summary import command

MOST_POINTS = 1500    # of a scatter plot
MOST_PATHS = 12       # runs that are flown again to draw their paths
BINS = 30
WIDTH, HEIGHT, MARGIN = 220, 150, 34
STYLE = """body{font:14px/1.45 sans-serif;max-width:1200px;margin:2em auto;padding:0 1em;color:#222}h1{font-size:1.5em}h2{font-size:1.15em;
margin-top:2em}svg{background:#fafafa;border:1px solid #ddd}table{border-collapse:collapse}td,th{padding:.25em .7em;text-align:right;
border-bottom:1px solid #ddd}th:first-child,td:first-child{text-align:left}code{background:#f3f3f3;padding:.1em .3em}text{font-size:10px;
fill:#444}.bar{fill:#0072b2}.point{fill:#0072b2;fill-opacity:.35}.path{fill:none;stroke:#d55e00;stroke-width:1.5}.scroll{overflow-x:auto}"""


def _number(value):
    return f"{value:.4g}"


class _Axis:
    """From values to a length of the drawing."""

    def __init__(self, low, high, length, flipped=False):
        self.low, self.high = low, high if high > low else low + (abs(low) or 1.0) * 1e-9
        self.length, self.flipped = length, flipped

    def at(self, values):
        share = (np.asarray(values, dtype=float) - self.low) / (self.high - self.low)
        return (1.0 - share if self.flipped else share) * self.length


def _frame(inside, x, y, title, x_title=""):
    """A drawing with the ends of its axes. :param x, y: (low, high)."""
    left, bottom = MARGIN + 8, HEIGHT + 12
    return (f'<svg width="{WIDTH + left + 8}" height="{HEIGHT + 44}" role="img"><title>{html.escape(title)}</title>'
            f'<g transform="translate({left},8)">{inside}</g>'
            f'<text x="{left}" y="{bottom + 8}">{_number(x[0])}</text>'
            f'<text x="{left + WIDTH}" y="{bottom + 8}" text-anchor="end">{_number(x[1])}</text>'
            f'<text x="{left - 3}" y="{HEIGHT + 8}" text-anchor="end">{_number(y[0])}</text>'
            f'<text x="{left - 3}" y="16" text-anchor="end">{_number(y[1])}</text>'
            f'<text x="{left + WIDTH // 2}" y="{bottom + 22}" text-anchor="middle">{html.escape(x_title or title)}</text></svg>')


def histogram(values, title):
    """How often which values occur."""
    values = values[np.isfinite(values)]
    if not len(values):
        return f"<p>{html.escape(title)}: no number</p>"
    counts, edges = np.histogram(values, bins=BINS)
    y = _Axis(0, max(counts), HEIGHT)
    width = WIDTH / BINS
    bars = "".join(f'<rect class="bar" x="{i * width:.1f}" y="{HEIGHT - h:.1f}" width="{width - 1:.1f}" height="{h:.1f}"/>'
                   for i, h in enumerate(y.at(counts)))
    return _frame(bars, (edges[0], edges[-1]), (0, max(counts)), title)


def scatter(xs, ys, x_title, y_title):
    """A point for each run; of very many every n-th."""
    known = np.isfinite(xs) & np.isfinite(ys)
    xs, ys = xs[known], ys[known]
    if not len(xs):
        return ""
    stride = -(-len(xs) // MOST_POINTS)
    x_ends, y_ends = (float(xs.min()), float(xs.max())), (float(ys.min()), float(ys.max()))
    places = zip(_Axis(*x_ends, WIDTH).at(xs[::stride]), _Axis(*y_ends, HEIGHT, True).at(ys[::stride]))
    dots = "".join(f'<circle class="point" cx="{x:.1f}" cy="{y:.1f}" r="2"/>' for x, y in places)
    return _frame(dots, x_ends, y_ends, f"{y_title} over {x_title}", x_title)


def path(states, title):
    """The way of a craft in the plane, x to the right, with one scale for both axes."""
    xy = states["position"][:, :2]
    low, high = xy.min(axis=0), xy.max(axis=0)
    scale = max((high[0] - low[0]) / WIDTH, (high[1] - low[1]) / HEIGHT, 1e-9)
    x, y = (xy[:, 0] - low[0]) / scale, HEIGHT - (xy[:, 1] - low[1]) / scale
    line = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
    inside = f'<polyline class="path" points="{line}"/><circle cx="{x[0]:.1f}" cy="{y[0]:.1f}" r="3"/>'
    ends = (low[0], low[0] + scale * WIDTH), (low[1], low[1] + scale * HEIGHT)
    return _frame(inside, *ends, title, "path: x, y (m)")


def _sensitivity(found):
    keys = list(next(iter(found["first_order"].values())))
    if not keys:
        return ""
    head = "".join(f"<th>{html.escape(key)}</th>" for key in keys)
    lines = []
    for name, row in found["first_order"].items():
        cells = "".join(f'<td>{"–" if row[key] is None else _bar(row[key])}</td>' for key in keys)
        lines.append(f"<tr><td>{html.escape(name)}</td>{cells}</tr>")
    return (f'<h2>First-order sensitivity</h2><p>The part of the variance of a metric that goes with one parameter alone.</p>'
            f'<div class="scroll"><table><tr><th>metric</th>{head}</tr>{"".join(lines)}</table></div>')


def _bar(index):
    return (f'{index:.2f} <svg width="60" height="9" style="border:0"><rect class="bar" width="{60 * min(1.0, index):.0f}" '
            f'height="9"/></svg>')


def _worst(table, found, study, rows):
    """The worst runs of each metric, and those that failed, with the command that flies them again."""
    flyer, drawn, parts = Flyer(table.plan), {}, []
    wanted = [(name, run) for rank in range(3) for name, one in found["metrics"].items() for run in one.get("worst_runs", [])[rank:rank + 1]]
    for name, run in wanted[:MOST_PATHS]:
        if run not in drawn:
            craft = next(metric.craft for metric in table.plan.metrics if metric.name == name)
            try:
                drawn[run] = path(flyer.fly(rows[run]).states(craft), f"run {run}")
            except Failure:
                drawn[run] = ""
    for name, one in found["metrics"].items():
        if one["count"]:
            lines = "".join(f"<tr><td>{run}</td><td>{_number(table.metrics[name][run])}</td>"
                            f"<td><code>{html.escape(command(study, run))}</code></td><td>{drawn.get(run, '')}</td></tr>"
                            for run in one["worst_runs"])
            parts.append(f"<h3>{html.escape(name)}: worst is {'greatest' if one['worst'] == 'max' else 'least'}</h3>"
                         f"<table><tr><th>run</th><th>value</th><th>again</th><th></th></tr>{lines}</table>")
    failed = "".join(f"<tr><td>{run}</td><td>{html.escape(table.status[run])}</td><td>{html.escape(table.messages[run])}</td>"
                     f"<td><code>{html.escape(command(study, run))}</code></td></tr>" for run in found["failed_runs"][:20])
    if failed:
        parts.append(f"<h3>Runs that failed</h3><table><tr><th>run</th><th>status</th><th>what</th><th>again</th></tr>{failed}</table>")
    return "<h2>Worst runs</h2>" + "".join(parts)


def _metrics(found):
    lines = "".join(f"<tr><td>{html.escape(name)}</td>" + (
        "".join(f"<td>{_number(value)}</td>" for value in (one["count"], one["mean"], one["std"], one["min"], one["percentiles"]["5"],
                                                         one["percentiles"]["50"], one["percentiles"]["95"], one["max"]))
        if one["count"] else "<td>0</td>" + "<td>–</td>" * 7) + "</tr>" for name, one in found["metrics"].items())
    return ("<table><tr><th>metric</th><th>runs</th><th>mean</th><th>std</th><th>min</th><th>5 %</th><th>50 %</th><th>95 %</th><th>max</th>"
            f"</tr>{lines}</table>")


def page(table, found, study, rows):
    """The text of the page. :param study: name of its file, for commands. :param rows: of the design."""
    title = html.escape(f"Study {table.plan.path.rsplit('/', 1)[-1]}")
    status = ", ".join(f"{count} {html.escape(name)}" for name, count in found["status"].items())
    grid = "".join("<tr>" + "".join(f"<td>{scatter(column, values, key, name)}</td>" for key, column in table.parameters.items()) + "</tr>"
                   for name, values in table.metrics.items())
    rows_of_scatter = f'<h2>Metrics over parameters</h2><div class="scroll"><table>{_head(table)}{grid}</table></div>' if table.parameters else ""
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style></head><body>'
            f'<h1>{title}</h1><p>{found["runs"]} runs: {status}. Design {found["design"]}, seed {found["seed"]}.</p>{_metrics(found)}'
            f'<h2>Distributions</h2>{"".join(histogram(values, name) for name, values in table.metrics.items())}'
            f'{rows_of_scatter}{_sensitivity(found)}{_worst(table, found, study, rows)}</body></html>\n')


def _head(table):
    return "<tr>" + "".join(f"<th>{html.escape(key)}</th>" for key in table.parameters) + "</tr>"


def write(folder, table, found, study):
    """study.html"""
    write_whole(folder.file("study.html"), page(table, found, study, folder.design()))
