"""YAML as the core reads it, and checks of its values that name key and rule."""
import math
import os
import re
import stat

import yaml

_RESOLVERS = (("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"), ("int", r"[-+]?[0-9]+", "-+0123456789"),
              ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)", "-+0123456789."),
              ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]), ("merge", r"<<", "<"))


class _Loader(yaml.SafeLoader):
    """YAML 1.2's core schema: 1e-3 is a number, yes a text; a key that stands twice is an error."""

    yaml_implicit_resolvers = {}

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value:
            if key.value in seen and key.value != "<<":
                raise ValueError(f"line {key.start_mark.line + 1}: duplicate key {key.value}")
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def _float(loader, node):
    return float(re.sub(r"^([-+]?)\.(?=[iInN])", r"\1", loader.construct_scalar(node)))


for _name, _pattern, _first in _RESOLVERS:
    _Loader.add_implicit_resolver(f"tag:yaml.org,2002:{_name}", re.compile(f"^(?:{_pattern})$"), list(_first))
_Loader.add_constructor("tag:yaml.org,2002:float", _float)
_Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(loader.construct_scalar(node)))


def check_regular(path):
    """What is no file might block, or never end. :raises ValueError: unless it is a regular file or a link to one."""
    mode = os.stat(path).st_mode
    if not stat.S_ISREG(mode):
        kind = ("a directory" if stat.S_ISDIR(mode) else "a FIFO" if stat.S_ISFIFO(mode) else
                "a socket" if stat.S_ISSOCK(mode) else "a device")
        raise ValueError(f"it is {kind}, must be a regular file")


def open_regular(path, mode="rb", **how):
    """open() of a regular file. :raises ValueError: that names it, if it is none."""
    try:
        check_regular(path)
    except ValueError as error:
        raise ValueError(f"{path}: cannot be read: {error}") from None
    return open(path, mode, **how)


def load(path):
    """The value that a file holds. :raises ValueError: that names file and line."""
    try:
        opened = open_regular(path, "r", encoding="utf-8")
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror}") from None
    try:
        with opened as file:
            return yaml.load(file, Loader=_Loader)  # noqa: S506 - a SafeLoader
    except UnicodeDecodeError:
        raise ValueError(f"{path}: must be UTF-8") from None
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise ValueError(f"{path}: {' '.join(str(error).split())}") from None


class Place:
    """A value and where it stands, such as "study.yaml: vary: mass: normal"; its checks say so."""

    def __init__(self, value, name):
        self.value = value
        self.name = name

    def error(self, rule):
        """A ValueError that names the place."""
        shown = "" if isinstance(self.value, (dict, list)) else f" = {self.value}"
        return ValueError(f"{self.name}{shown}: {rule}")

    def at(self, key):
        """The place of a member that is there."""
        return Place(self.value[key], f"{self.name}: {key}")

    def items(self, what):
        """The members of a map with names of texts."""
        if not isinstance(self.value, dict) or not self.value:
            raise self.error(f"must be a map of {what}")
        for key in self.value:
            if not isinstance(key, str):
                raise self.error(f"key {key}: must be a text")
        return [(key, self.at(key)) for key in self.value]

    def members(self, required, optional=()):
        """Checks a map's keys: those that must be there, and those that may."""
        allowed = [*required, *optional]
        for key, _ in self.items(", ".join(allowed)):
            if key not in allowed:
                raise self.error(f"unknown key {key}: must be one of: {', '.join(allowed)}")
        for key in required:
            if key not in self.value:
                raise self.error(f"{key} is missing")

    def number(self, above=None, least=None):
        """A finite number. :param above: it must be greater. :param least: it must not be less."""
        if isinstance(self.value, bool) or not isinstance(self.value, (int, float)):
            raise self.error("must be a number")
        try:
            number = float(self.value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise self.error("must be finite")
        if above is not None and number <= above:
            raise self.error(f"must be greater than {above:g}")
        if least is not None and number < least:
            raise self.error(f"must be at least {least:g}")
        return number

    def whole(self, least, most=2**63 - 1):
        """A whole number within bounds."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self.error("must be a whole number")
        if not least <= self.value <= most:
            raise self.error(f"must be from {least} to {most}")
        return self.value

    def text(self, among=None):
        """A text. :param among: it must be one of these."""
        if among is not None and self.value not in among:
            raise self.error(f"must be one of: {', '.join(among)}")
        if not isinstance(self.value, str) or not self.value:
            raise self.error("must be a text")
        return self.value

    def values(self, what="values"):
        """A list that is not empty, of places."""
        if not isinstance(self.value, list) or not self.value:
            raise self.error(f"must be a list of {what}")
        return [Place(value, f"{self.name}[{i}]") for i, value in enumerate(self.value)]

    def function(self):
        """MODULE:FUNCTION as text."""
        if not isinstance(self.value, str) or not re.fullmatch(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*", self.value):
            raise self.error("must be module:function")
        return self.value
