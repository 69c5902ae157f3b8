# SPDX-License-Identifier: BSD-3-Clause
"""What a script imports: `from cambium import ...`. docs/python-plugins.md explains it.

The classes that hold payloads and missions are in `_cambium`, which the host brings along.
"""

import builtins
import hashlib
import io
import os
import re
import sys
import threading
import traceback
import types
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from _cambium import (Cloud, Payload, Trees, digest_file, map_to_geodetic, read_truth,  # noqa: F401
                      stems_of, travelled, write_file)
import _cambium


class Error(Exception):
    """What is wrong (`what`), at which file or line (`where`), and whose fault it is: code 2 the
    configuration's, 3 the script's, 4 the data's, 5 numerics."""

    def __init__(self, what, where="", code=4):
        super().__init__(f"{where}: {what}" if where else what)
        self.what, self.where, self.code = str(what), str(where), int(code)


class Cancelled(BaseException):
    """Raised by context.check_cancelled(). No Exception, so that `except Exception` lets it pass."""


# ------------------------------------------------------------------------------- parameters

@dataclass
class Constraint:
    """What a value must satisfy, and its unit."""
    low: float = -np.inf
    high: float = np.inf
    low_open: bool = False
    high_open: bool = False
    choices: list = field(default_factory=list)
    unit: str = ""


def between(low, high, unit=""):
    return Constraint(low=low, high=high, unit=unit)


def above(low, unit=""):
    return Constraint(low=low, low_open=True, unit=unit)


def at_least(low, unit=""):
    return Constraint(low=low, unit=unit)


def one_of(choices):
    return Constraint(choices=list(choices))


def in_unit(unit):
    return Constraint(unit=unit)


def a_file():
    """A path, relative to the pipeline. Its content is part of the cache key."""
    return Constraint(unit="file")


class Param:
    """A parameter of the class: default, a line for the user, bounds and unit. Its type is that of
    the default: bool, int, float, str, or a list of numbers or texts. In methods it is the value."""

    def __init__(self, default, doc, constraint=None):
        self.default, self.doc, self.constraint = default, doc, constraint or Constraint()
        if isinstance(default, (list, tuple)):
            texts = bool(self.constraint.choices) or (default and isinstance(default[0], str))
            self.default = [str(v) if texts else float(v) for v in default]
            self.type = "texts" if texts else "numbers"
        elif type(default) in (bool, int, float, str):
            self.type = type(default).__name__
        else:
            raise Error(f"a parameter's default must be a bool, int, float, str or list, found "
                        f"{type(default).__name__}", code=3)


# ------------------------------------------------------------------------------------ kinds

class Component:
    _methods = ()

    def check_params(self):
        """What is wrong between parameters, or nothing."""
        return ""


class MissionReader(Component):
    """accepts(path) -> bool; read(path, context) -> Mission"""
    _methods = ("accepts", "read")


class PayloadFilter(Component):
    """apply(mission, node, context) -> Payload"""
    _methods = ("apply",)
    uses_neighbours = False  # True: apply() looks at other nodes than its own, or at poses


class PlaceRecognizer(Component):
    """describe(mission, context) -> (nodes, numbers) array, or (array, bytes);
    match(query, reference, pairing, context) -> [(query, reference, score[, T_reference_query])]"""
    _methods = ("describe", "match")
    uses_poses = False  # True: describe() reads T_map_node
    yaw_invariant = False


class Registration(Component):
    """align(target, source, T_target_source_guess, context) -> Alignment; prepare(payload, context)
    may return what it wants to find in target.data and source.data."""
    _methods = ("align",)

    def prepare(self, payload, context):
        return None


class MapExporter(Component):
    """write(atlas, folder, context) -> [path]"""
    _methods = ("write",)


class Evaluator(Component):
    """evaluate(atlas, reference, context) -> [Metric]; reference is a path, or None: every mission
    brings its own truth."""
    _methods = ("evaluate",)
    needs_truth = True


KINDS = {"mission_reader": MissionReader, "payload_filter": PayloadFilter,
         "place_recognizer": PlaceRecognizer, "registration": Registration,
         "map_exporter": MapExporter, "evaluator": Evaluator}


# ------------------------------------------------------------------- what goes in, what comes out

class Candidate(NamedTuple):
    query: int
    reference: int
    score: float                      # higher is better
    T_reference_query: object = None  # 4 x 4, a first guess


@dataclass
class Alignment:
    converged: bool
    T_target_source: object = field(default_factory=lambda: np.eye(4))
    information: object = field(default_factory=lambda: np.eye(6))  # (translation; rotation)
    scores: dict = field(default_factory=dict)
    reason: str = ""  # why it did not converge


@dataclass
class Prepared:
    """A payload, with what prepare() made of it."""
    payload: Payload
    data: object


class Metric(NamedTuple):
    name: str
    value: float
    unit: str = ""
    better: str = "neither"  # lower, higher, neither


class Fingerprints(NamedTuple):
    """What describe() returned."""
    table: object  # (nodes, numbers) of float32, read-only
    extra: bytes


@dataclass
class Pairing:
    """Which pairs of nodes may be proposed."""
    within_mission: bool
    min_path: float           # [m]
    query_path: object        # distance travelled at each node [m]
    reference_path: object

    def allowed(self, query, reference):
        """For two indices, or for arrays of them (they broadcast)."""
        far = np.asarray(self.query_path)[query] - np.asarray(self.reference_path)[reference]
        return (not self.within_mission) | (far >= self.min_path)

    def mask(self):
        """(queries, references) of bool."""
        queries, references = len(self.query_path), len(self.reference_path)
        return self.allowed(np.arange(queries)[:, None], np.arange(references)[None, :])


@dataclass
class Source:
    """A payload that load() -> Payload makes when it is wanted. `digest` is a text: equal texts mean
    equal payloads; `where` is for messages."""
    load: object
    digest: str
    where: str


def file_source(path, load):
    """The payload that load(path) makes of a file."""
    return Source(lambda: load(path), digest_file(path), str(path))


@dataclass
class Edge:
    tail: int
    head: int
    T_tail_head: object
    information: object = field(default_factory=lambda: np.eye(6))


@dataclass
class Fix:
    """A GNSS measurement, WGS 84."""
    sec: int
    nsec: int
    latitude: float   # [deg]
    longitude: float  # [deg]
    altitude: float   # above the ellipsoid [m]
    covariance: object = field(default_factory=lambda: np.eye(3))  # east, north, up [m^2]


@dataclass
class Mission:
    name: str
    T_mission_node: object                        # (nodes, 4, 4)
    stamps: object = None                         # (nodes, 2) of sec, nsec
    ids: object = None                            # ascending; None: 0, 1, 2, ...
    payloads: list = field(default_factory=list)  # a Source, a Payload or None for each node
    edges: object = None                          # [Edge]; None: odometry from the poses
    fixes: list = field(default_factory=list)     # [Fix]
    platform_id: int = 0
    warnings: list = field(default_factory=list)  # `file:line: message`


# ------------------------------------------------------------------------------ for the host

_modules = {}


def _read(path):
    with open(path, "rb") as file:
        return file.read()


def _beside(path, source):
    """(path, content) by name of the files that a script may import: those beside it whose names occur in it, or in
    one of these. The host looks for the same ones when it makes the cache key."""
    folder, found, texts = os.path.dirname(path), {}, [source]
    names = {name[:-3] for name in os.listdir(folder) if name.endswith(".py")} - {os.path.basename(path)[:-3]}
    while texts:
        for name in names.intersection(re.findall(r"\w+", texts.pop().decode(errors="replace"))) - found.keys():
            other = os.path.join(folder, name + ".py")
            found[name] = other, _read(other)
            texts.append(found[name][1])
    return found


def _execute(name, path, source, others, loaded):
    """Runs a file as a module, whose imports look among `others` first. They are modules of this script alone:
    another script may have others of the same names."""
    module = types.ModuleType(name)
    module.__file__ = path
    sys.modules[name] = module  # dataclasses and pickle look there

    def import_(wanted, globals=None, locals=None, fromlist=(), level=0):
        if level or wanted not in others:
            return builtins.__import__(wanted, globals, locals, fromlist, level)
        if wanted not in loaded:
            _execute(f"{name.partition('.')[0]}.{wanted}", *others[wanted], others, loaded)
        return loaded[wanted]

    module.__dict__["__builtins__"] = {**vars(builtins), "__import__": import_}
    loaded[os.path.splitext(os.path.basename(path))[0]] = module
    exec(compile(source, path, "exec"), module.__dict__)
    return module


def _load(path):
    """The script as a module; the same content is executed once in a process."""
    source = _read(path)
    others = _beside(path, source)
    key = path, source, tuple(sorted(others.items()))
    if key not in _modules:
        _modules[key] = _execute(f"cambium_script_{len(_modules)}", path, source, others, {})
    return _modules[key]


def _use_shipped(folder, digest):
    """Lets the scripts in `folder` import each other, if they are those that the host was built with."""
    names = sorted(str(p.relative_to(folder)) for pattern in ("*.py", "*/*.py") for p in Path(folder).glob(pattern))
    lines = [f"{n} {hashlib.sha256((Path(folder) / n).read_bytes()).hexdigest()}\n" for n in names]
    if hashlib.sha256("".join(lines).encode()).hexdigest() != digest:
        raise Error("its files are not those that this Cambium was built with; install them together. A changed copy of one "
                    "can be used under 'python', with 'script'", folder, 3)
    if folder not in sys.path:
        sys.path.append(folder)


def _choose(path, kind, class_name):
    """The class of the script that is of this kind."""
    module, base = _load(path), KINDS[kind]
    own = [c for c in vars(module).values() if isinstance(c, type) and issubclass(c, Component)
           and c.__module__ == module.__name__]
    fit = [c for c in own if issubclass(c, base) and (not class_name or c.__name__ == class_name)]
    if len(fit) != 1:
        found = ", ".join(f"{c.__name__}({', '.join(b.__name__ for b in c.__bases__)})" for c in own)
        wanted = f"class {class_name}({base.__name__})" if class_name else f"one class of {base.__name__}"
        many = "; name one of them with the parameter 'class'" if len(fit) > 1 else ""
        raise Error(f"expected {wanted}, found {found or 'no class of a kind'}{many}", path, 2)
    for method in base._methods:
        if not callable(getattr(fit[0], method, None)):
            raise Error(f"class {fit[0].__name__} lacks the method {method}(); expected "
                        f"{' '.join(base.__doc__.split())}", path, 3)
    return fit[0]


def _declared(cls, path):
    """(name, Param) in order of declaration, those of base classes first."""
    found = {}
    for base in reversed(cls.__mro__):
        found.update((n, p) for n, p in vars(base).items() if isinstance(p, Param))
    for name in ("script", "class"):
        if name in found:
            raise Error(f"the parameter '{name}' of {cls.__name__} has a name of the host's own", path, 3)
    return list(found.items())


def _make(cls, values):
    """An object whose parameters have their values before __init__() is called."""
    made = cls.__new__(cls)
    made.__dict__.update(values)
    made.__init__()
    return made


def _bytes(made):
    """About what an object takes in memory, for the host's budget."""
    if isinstance(made, dict):
        made = list(made.values())
    if isinstance(made, (list, tuple)):
        return sum(_bytes(part) for part in made)
    return getattr(made, "nbytes", sys.getsizeof(made))


def _explain(error, path):
    """(where, message) of an exception: the last line of the script, and the traceback."""
    if isinstance(error, SyntaxError) and error.filename == path:
        return f"{path}:{error.lineno}", f"{type(error).__name__}: {error.msg}"
    frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename != "<cambium>"]
    lines = [f.lineno for f in frames if f.filename == path]
    text = "".join(traceback.format_exception_only(type(error), error)).strip()
    trace = "".join(traceback.format_list(frames)).rstrip()
    return (f"{path}:{lines[-1]}" if lines else path), f"{text}\n{trace}" if trace else text


class _Output(io.TextIOBase):
    """print() becomes messages of the host, line by line."""

    def __init__(self):
        self._rest = threading.local()

    def write(self, text):
        lines = (getattr(self._rest, "text", "") + text).split("\n")
        self._rest.text = lines.pop()
        for line in lines:
            _cambium.say(line)
        return len(text)


sys.stdout = sys.stderr = _Output()
