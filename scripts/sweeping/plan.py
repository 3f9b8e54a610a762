"""Reads a sweep: a base case, and axes whose combinations are the points."""

import itertools
import json
import re
import tomllib
from dataclasses import dataclass

PLAIN = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.+-]*\Z")
KEYS = {"": {"sweep", "set", "axis", "when", "exclude"}, "when": {"match", "set"}, "sweep": {"name", "description", "case", "threads"},
        "axis": {"name", "key", "values", "points"}, "point": {"name", "set"}}


class SweepError(Exception):
    """The sweep file is wrong; the message names file, key, value and what is allowed."""


@dataclass
class Point:
    name: str  # of the axes' values, a folder's name
    axes: dict  # axis name -> value, or the name of a composite point
    overrides: dict  # dotted key of the case -> value


@dataclass
class Sweep:
    name: str
    case: object  # Path of the base case
    threads: int
    points: list


def toml_text(value):
    """A value as `slagflow --set` takes it: TOML and JSON agree on what a case file holds."""
    return json.dumps(value)


def matches(values, rule):
    return all(values[key] in wanted for key, wanted in rule.items())


class Reader:
    def __init__(self, path):
        self.path = path

    def fail(self, what):
        raise SweepError(f"{self.path}: {what}")

    def table(self, value, where, kind):
        if not isinstance(value, dict):
            self.fail(f"'{where}' is no table")
        for key in value:
            if key not in KEYS[kind]:
                self.fail(f"key '{where}.{key}': unknown: allowed: {', '.join(sorted(KEYS[kind]))}".replace("'.", "'"))
        return value

    def list_of(self, value, where):
        if not isinstance(value, list):
            self.fail(f"key '{where}': value {value!r}: allowed: a list")
        return value

    def value(self, value, where):
        try:
            toml_text(value)
        except TypeError:
            self.fail(f"key '{where}': value {value}: allowed: numbers, texts, true, false and lists of them")
        return value

    def overrides(self, value, where):
        """Dotted keys; nested tables, as TOML makes of unquoted dotted keys, are flattened."""
        if not isinstance(value, dict):
            self.fail(f"'{where}' is no table of case keys: allowed: {{\"fluid.slag.yield_stress\" = 5}}")
        flat = {}
        for key, entry in value.items():
            if isinstance(entry, dict):
                flat |= {f"{key}.{rest}": v for rest, v in self.overrides(entry, f"{where}.{key}").items()}
            else:
                flat[key] = self.value(entry, f"{where}.{key}")
        return flat

    def name(self, value, where):
        text = f"{value:g}" if isinstance(value, float) else str(value)
        if not PLAIN.match(text):
            self.fail(f"key '{where}': value {value!r}: allowed: letters, digits, _ . + - as a name")
        return text

    def axis(self, table, where):
        """Name and [(value, label, overrides)] of an axis."""
        self.table(table, where, "axis")
        if not isinstance(table.get("key", ""), str):
            self.fail(f"key '{where}.key': value {table['key']!r}: allowed: a dotted key of the case")
        name = self.name(table.get("name", table.get("key", "").split(".")[-1]), f"{where}.name")
        if ("values" in table) == ("points" in table):
            self.fail(f"axis '{name}': allowed: either `key` and `values`, or `points`")
        if "values" in table:
            if not isinstance(table.get("key"), str):
                self.fail(f"axis '{name}': key 'key': missing: required: a dotted key of the case")
            values = [self.value(v, f"{where}.values") for v in self.list_of(table["values"], f"{where}.values")]
            entries = [(v, self.name(v, f"{where}.values"), {table["key"]: v}) for v in values]
        else:
            entries = []
            for point in self.list_of(table["points"], f"{where}.points"):
                self.table(point, f"{where}.points", "point")
                label = self.name(point.get("name", ""), f"{where}.points.name")
                entries.append((label, label, self.overrides(point.get("set", {}), f"{where}.points.set")))
        labels = [label for _, label, _ in entries]
        if not entries or len(set(labels)) < len(labels):
            self.fail(f"axis '{name}': values {labels}: allowed: at least one, each once")
        return name, entries

    def match(self, rule, where, axes):
        """Axis name -> the values that match."""
        if not isinstance(rule, dict) or not rule:
            self.fail(f"'{where}': allowed: a table of axes and their values")
        present = {name: [value for value, _, _ in entries] for name, entries in axes}
        wanted = {key: value if isinstance(value, list) else [value] for key, value in rule.items()}
        for key, values in wanted.items():
            if key not in present:
                self.fail(f"key '{where}.{key}': unknown: allowed: {', '.join(present)}")
            for value in values:
                if value not in present[key]:
                    self.fail(f"key '{where}.{key}': value {value!r}: allowed: {', '.join(map(str, present[key]))}")
        return wanted

    def read(self):
        try:
            root = tomllib.loads(self.path.read_text())
        except OSError as error:
            self.fail(f"cannot be read: {error.strerror}")
        except tomllib.TOMLDecodeError as error:
            self.fail(error)
        except UnicodeDecodeError:
            self.fail("not UTF-8")
        self.table(root, "", "")
        about = self.table(root.get("sweep", {}), "sweep", "sweep")
        if not isinstance(about.get("case"), str):
            self.fail("key 'sweep.case': missing: required: a case file, relative to this file")
        case = (self.path.parent / about["case"]).resolve()
        if not case.is_file():
            self.fail(f"key 'sweep.case': {case} is not there")
        threads = about.get("threads", 1)
        if not isinstance(threads, int) or threads < 1:
            self.fail(f"key 'sweep.threads': value {threads!r}: allowed: an integer >= 1")
        name = self.name(about.get("name", self.path.stem), "sweep.name")
        return Sweep(name, case, threads, self.points(root))

    def points(self, root):
        common = self.overrides(root.get("set", {}), "set")
        axes = [self.axis(table, f"axis.{k}") for k, table in enumerate(self.list_of(root.get("axis", []), "axis"))]
        names = [name for name, _ in axes]
        if not axes or len(set(names)) < len(names):
            self.fail(f"axes {names}: allowed: at least one, each with a name of its own")
        excluded = [self.match(rule, "exclude", axes) for rule in self.list_of(root.get("exclude", []), "exclude")]
        rules = []
        for table in self.list_of(root.get("when", []), "when"):
            self.table(table, "when", "when")
            rules.append((self.match(table.get("match"), "when.match", axes), self.overrides(table.get("set"), "when.set")))
        points = []
        for entries in itertools.product(*(entries for _, entries in axes)):
            values = {name: value for name, (value, _, _) in zip(names, entries)}
            if any(matches(values, rule) for rule in excluded):
                continue
            overrides = dict(common)
            for _, _, changes in entries:
                overrides |= changes
            for rule, changes in rules:
                overrides |= changes if matches(values, rule) else {}
            points.append(Point("_".join(f"{n}={label}" for n, (_, label, _) in zip(names, entries)), values, overrides))
        if not points:
            self.fail("no point is left")
        return points


def read_sweep(path, settings=()):
    """The sweep in a file; `settings`, "dotted.key=value" each, go to all points. Throws SweepError."""
    sweep = Reader(path).read()
    for setting in settings:
        key, equals, text = setting.partition("=")
        if not equals:
            raise SweepError(f"--set {setting}: allowed: key=value")
        try:
            value = tomllib.loads(f"value = {text}")["value"]
        except tomllib.TOMLDecodeError:
            value = text
        for point in sweep.points:
            point.overrides[key] = value
    return sweep
