"""The files of a study: design.csv, rows as they come, runs.csv."""
import csv
import hashlib
import io
import json
import os
import re

from .. import version
from .design import draw
from .reading import open_regular

UNFINISHED = "runs.part.csv"


def line(cells):
    """A row of CSV as text."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()


def write_whole(path, text):
    """A file that is there as a whole or not at all."""
    partial = f"{path}.{os.getpid()}.part"
    with open(partial, "w", encoding="utf-8", newline="") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(partial, path)


class Folder:
    """OUT: what a study leaves. :param shard: (i, n), from 1."""

    def __init__(self, path, plan, shard=(1, 1)):
        self.path, self.plan, self.shard = path, plan, shard
        self.columns = [*plan.columns()[:2], "status", "hash", *plan.columns()[2:], *(metric.name for metric in plan.metrics), "message"]

    def file(self, name):
        """The path of a file in it."""
        return os.path.join(self.path, name)

    def rows_name(self):
        """Name of the file of finished rows."""
        return "runs.csv" if self.shard[1] == 1 else f"shard-{self.shard[0]}-of-{self.shard[1]}.csv"

    def part_name(self):
        """Name of the file of rows in the order in which they came."""
        return UNFINISHED if self.shard[1] == 1 else f"shard-{self.shard[0]}-of-{self.shard[1]}.part.csv"

    def begin(self, may_be_there):
        """The rows of the design: drawn and written, or read if this study has begun here.

        :raises ValueError: if another study lies here, or this one and it may not.
        """
        os.makedirs(self.path, exist_ok=True)
        about = {"version": version, "study": self.plan.fingerprint_text, "runs": self.plan.runs}
        if os.path.exists(self.file("design.csv")):
            self._check(about)
            if not may_be_there:
                raise ValueError(f"{self.path}: holds this study already: --resume goes on with it")
            return self.design()
        text = line(self.plan.columns()) + "".join(line(cells) for cells in draw(self.plan))
        about["design"] = hashlib.sha256(text.encode()).hexdigest()
        write_whole(self.file("study.json"), json.dumps(about, indent=2) + "\n")
        write_whole(self.file("design.csv"), text)
        return self.design()

    def _check(self, about):
        try:
            with open_regular(self.file("study.json")) as file:
                written = json.load(file)
        except (OSError, ValueError):
            raise ValueError(f"{self.path}: study.json must be that of a study") from None
        for key, what in (("study", "another study, or an earlier text of it"), ("version", "a study of another version")):
            if written.get(key) != about[key]:
                raise ValueError(f"{self.path}: holds {what}: take another folder")

    def design(self):
        """The rows of design.csv. :raises ValueError: if it is not what was drawn."""
        with open_regular(self.file("design.csv")) as file:
            data = file.read()
        with open_regular(self.file("study.json")) as file:
            wanted = json.load(file)["design"]
        if hashlib.sha256(data).hexdigest() != wanted:
            raise ValueError(f"{self.file('design.csv')}: was changed since it was drawn")
        return list(csv.reader(io.StringIO(data.decode("utf-8"), newline="")))[1:]

    def own(self, rows):
        """Those of the shard."""
        return rows[self.shard[0] - 1::self.shard[1]]

    def finished(self):
        """By number the rows that are there, of an earlier start that was broken off; what was not wholly written is cut off."""
        rows = {}
        for name in (self.rows_name(), self.part_name()):
            if os.path.exists(self.file(name)):
                rows.update(self._read(name))
        return rows

    def _read(self, name):
        with open_regular(self.file(name)) as file:
            data = file.read()
        whole = data[:data.rfind(b"\n") + 1].decode("utf-8")
        if len(whole.encode()) < len(data):
            with open(self.file(name), "r+b") as file:
                file.truncate(len(whole.encode()))
        return {int(row[0]): row for row in csv.reader(io.StringIO(whole, newline=""))
                if len(row) == len(self.columns) and row[0].isdigit()}

    def write(self, rows, expected):
        """Writes the finished rows in their order. :raises ValueError: if some are missing."""
        missing = [number for number in expected if number not in rows]
        if missing:
            raise ValueError(f"{self.path}: {len(missing)} runs are missing, the first is {missing[0]}")
        write_whole(self.file(self.rows_name()), line(self.columns) + "".join(line(rows[number]) for number in expected))
        if os.path.exists(self.file(self.part_name())):
            os.remove(self.file(self.part_name()))

    def shards(self):
        """All rows of the shards that lie here. :raises ValueError: if one is missing or there are those of several n."""
        found = [match for match in (re.fullmatch(r"shard-(\d+)-of-(\d+)\.csv", name) for name in sorted(os.listdir(self.path))) if match]
        counts = {int(match.group(2)) for match in found}
        if len(counts) != 1:
            raise ValueError(f"{self.path}: must have the shards of one n: " + (", ".join(match.group(0) for match in found) or "there is none"))
        count = counts.pop()
        missing = sorted(set(range(1, count + 1)) - {int(match.group(1)) for match in found})
        if missing:
            raise ValueError(f"{self.path}: shard {missing[0]}/{count} is missing")
        rows = {}
        for match in found:
            rows.update(self._read(match.group(0)))
        return rows
