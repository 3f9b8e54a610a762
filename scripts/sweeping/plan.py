"""Reads a sweep: a base case, and axes whose combinations are the points."""

import itertools
import json
import math
import re
import tomllib
from dataclasses import dataclass

PLAIN = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.+-]*\Z")
LABEL = re.compile(r"[A-Za-z0-9_.+-][A-Za-z0-9_.,+-]*\Z")
LONGEST_NAME = 200  # of a point, in bytes: a folder's name may have 255
MOST_POINTS = 10_000
MOST_THREADS = 4096
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
    varied: set  # keys of the case that axes set


def toml_text(value):
    """A value as `slagflow --set` takes it: TOML and JSON agree on what a case file holds."""
    return json.dumps(value)


def matches(values, rule):
    return all(values[key] in wanted for key, wanted in rule.items())


def advice(text, error):
    """What is meant by the line that the error of TOML names, or nothing."""
    found = re.search(r"at line (\d+)", error)
    lines = text.splitlines()
    line = lines[int(found[1]) - 1] if found and int(found[1]) <= len(lines) else ""
    if re.search("[\u201c\u201d\u201e\u2018\u2019\u00ab\u00bb]", line):
        return f", in {line.strip()!r}; straight quotes: write \""
    if "\u2212" in line or "\u2013" in line:
        return f", in {line.strip()!r}; a minus sign from the keyboard: write -"
    if re.search(r'"[^"]*\\', line):
        return f", in {line.strip()!r}; a backslash in \"...\" begins an escape: write / in paths, or single quotes '...'"
    if number := re.search(r"(\d+),(\d+)(?=\s*(;|#|$))", line):
        return f", in {line.strip()!r}; a decimal point, not a comma: write {number[1]}.{number[2]}; between values a comma"
    return ""


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
        if isinstance(value, list):
            return [self.value(entry, where) for entry in value]
        if not isinstance(value, (bool, int, float, str)) or (isinstance(value, float) and not math.isfinite(value)):
            self.fail(f"key '{where}': value {value}: allowed: finite numbers, texts, true, false and lists of them")
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
        if not isinstance(value, str) or not PLAIN.match(value):
            self.fail(f"key '{where}': value {value!r}: allowed: letters, digits, _ . + - as a name")
        return value

    def label(self, value, where):
        """A value as part of a folder's name: -5, 0.002, true, 0,0,-9.81."""
        if isinstance(value, bool):
            return str(value).lower()
        if isinstance(value, list) and value and not any(isinstance(entry, list) for entry in value):
            return ",".join(self.label(entry, where) for entry in value)
        text = f"{value:.12g}" if isinstance(value, float) else str(value)
        if isinstance(value, list) or not LABEL.match(text):
            self.fail(f"key '{where}': value {value!r}: allowed: numbers, words of letters, digits, _ . + -, true, false, "
                      "and lists of these; for others `points`, each with a name")
        return text

    def axis(self, table, where):
        """Name and [(value, label, overrides)] of an axis."""
        self.table(table, where, "axis")
        if not isinstance(table.get("key", ""), str):
            self.fail(f"key '{where}.key': value {table['key']!r}: allowed: a dotted key of the case")
        named = f"{where}.name" if "name" in table else f"{where}.key"
        name = self.name(table.get("name", table.get("key", "").split(".")[-1]), named)
        if ("values" in table) == ("points" in table):
            self.fail(f"axis '{name}': allowed: either `key` and `values`, or `points`")
        if "values" in table:
            if not isinstance(table.get("key"), str):
                self.fail(f"axis '{name}': key 'key': missing: required: a dotted key of the case")
            values = [self.value(v, f"{where}.values") for v in self.list_of(table["values"], f"{where}.values")]
            entries = [(v, self.label(v, f"{where}.values"), {table["key"]: v}) for v in values]
        else:
            entries = []
            for point in self.list_of(table["points"], f"{where}.points"):
                self.table(point, f"{where}.points", "point")
                if not isinstance(point.get("name"), str) or not LABEL.match(point["name"]):
                    self.fail(f"key '{where}.points.name': value {point.get('name')!r}: allowed: a text of letters, digits, _ . , + -")
                label = point["name"]
                entries.append((label, label, self.overrides(point.get("set", {}), f"{where}.points.set")))
        labels = [label for _, label, _ in entries]
        if not entries or len(set(labels)) < len(labels):
            self.fail(f"axis '{name}': values {', '.join(labels) or 'none'}: allowed: at least one, each once")
        return name, entries

    def match(self, rule, where, axes):
        """Axis name -> the values that match."""
        if not isinstance(rule, dict) or not rule:
            self.fail(f"'{where}': allowed: a table of axes and their values")
        present = {name: [value for value, _, _ in entries] for name, entries in axes}
        wanted = {key: value if isinstance(value, list) and value not in present.get(key, []) else [value]
                  for key, value in rule.items()}
        for key, values in wanted.items():
            if key not in present:
                self.fail(f"key '{where}.{key}': unknown: allowed: {', '.join(present)}")
            for value in values:
                if value not in present[key]:
                    self.fail(f"key '{where}.{key}': value {value!r}: allowed: {', '.join(map(str, present[key]))}")
        return wanted

    def load(self):
        try:
            return tomllib.loads(self.path.read_text(encoding="utf-8-sig"))
        except OSError as error:
            self.fail(f"cannot be read: {error.strerror}")
        except tomllib.TOMLDecodeError as error:
            self.fail(f"{error}{advice(self.path.read_text(encoding='utf-8-sig'), str(error))}")
        except UnicodeDecodeError:
            self.fail("not UTF-8")

    def read(self):
        root = self.load()
        self.table(root, "", "")
        about = self.table(root.get("sweep", {}), "sweep", "sweep")
        if not isinstance(about.get("case"), str):
            found = f"value {about['case']!r}: allowed" if "case" in about else "missing: required"
            self.fail(f"key 'sweep.case': {found}: a case file, relative to this file")
        case = (self.path.parent / about["case"]).resolve()
        if not case.is_file():
            escaped = re.search(r"[\x00-\x1f]", about["case"])
            hint = "; a backslash in \"...\" begins an escape: write / in paths, or single quotes '...'" if escaped else ""
            self.fail(f"key 'sweep.case': {str(case)!r} is not there{hint}")
        threads = about.get("threads", 1)
        if type(threads) is not int or not 1 <= threads <= MOST_THREADS:
            self.fail(f"key 'sweep.threads': value {threads!r}: allowed: a whole number, 1 to {MOST_THREADS}")
        name = self.name(about["name"], "sweep.name") if "name" in about else re.sub(r"[^A-Za-z0-9_.+-]", "_", self.path.stem)
        axes = self.axes(root)
        varied = {key for _, entries in axes for _, _, changes in entries for key in changes}
        return Sweep(name, case, threads, self.points(root, axes), varied)

    def axes(self, root):
        axes = [self.axis(table, f"axis.{k}") for k, table in enumerate(self.list_of(root.get("axis", []), "axis"))]
        names = [name for name, _ in axes]
        if not axes or len(set(names)) < len(names):
            self.fail(f"axes {', '.join(names) or 'none'}: allowed: at least one, each with a name of its own")
        setters = {}
        for name, entries in axes:
            for key in dict.fromkeys(key for _, _, changes in entries for key in changes):
                if key in setters:
                    self.fail(f"axes '{setters[key]}' and '{name}' both set '{key}': allowed: one of them")
                setters[key] = name
        count = math.prod(len(entries) for _, entries in axes)
        if count > MOST_POINTS:
            sizes = " x ".join(str(len(entries)) for _, entries in axes)
            self.fail(f"{count} points ({sizes}): allowed: up to {MOST_POINTS}")
        return axes

    def rules(self, root, axes):
        """What is excluded, and further keys of points that match."""
        excluded = [self.match(rule, "exclude", axes) for rule in self.list_of(root.get("exclude", []), "exclude")]
        changes = []
        for table in self.list_of(root.get("when", []), "when"):
            self.table(table, "when", "when")
            changes.append((self.match(table.get("match"), "when.match", axes), self.overrides(table.get("set"), "when.set")))
        return excluded, changes

    def points(self, root, axes):
        common = self.overrides(root.get("set", {}), "set")
        excluded, rules = self.rules(root, axes)
        points = []
        for entries in itertools.product(*(entries for _, entries in axes)):
            values = {name: value for (name, _), (value, _, _) in zip(axes, entries)}
            if any(matches(values, rule) for rule in excluded):
                continue
            overrides = dict(common)
            for _, _, changes in entries:
                overrides |= changes
            for rule, changes in rules:
                overrides |= changes if matches(values, rule) else {}
            points.append(Point("_".join(f"{n}={label}" for (n, _), (_, label, _) in zip(axes, entries)), values, overrides))
        if not points:
            self.fail("no point is left: all are excluded")
        longest = max((p.name for p in points), key=len)
        if len(longest) > LONGEST_NAME:
            self.fail(f"point '{longest}': a name of {len(longest)} letters: allowed: {LONGEST_NAME}; `points` give short names")
        return points


def setting_of(text, reader):
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise SweepError(f"--set {text}: allowed: key=value")
    try:
        parsed = tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        parsed = value
    return key.strip(), reader.value(parsed, f"--set {key.strip()}")


def read_sweep(path, settings=()):
    """The sweep in a file; `settings`, "dotted.key=value" each, go to all points. Throws SweepError."""
    reader = Reader(path)
    sweep = reader.read()
    for setting in settings:
        key, value = setting_of(setting, reader)
        if key in sweep.varied:
            raise SweepError(f"--set {setting}: an axis of {path} sets that key: allowed: other keys")
        for point in sweep.points:
            point.overrides[key] = value
    return sweep
