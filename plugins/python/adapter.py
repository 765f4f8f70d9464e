# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python half of the adapter: a user's class Rasterizer, with the interface's memory as NumPy arrays.

Runs inside the adapter's interpreter; `farop_host` is the module that adapter.cpp provides.
"""
import sys
import traceback
import types

import farop_host
import numpy as np

VERTEX = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("r", "u1"), ("g", "u1"), ("b", "u1"), ("reserved", "u1")])
WISHES = {"triangles": 1, "normals": 2, "eye_positions": 4, "vertex_ids": 8, "material": 16}
REQUIRED = ("begin_frame", "polygon", "end_frame")


class Log:
    """What print() writes becomes lines of the log: standard output is the host's, for data."""

    def __init__(self, level):
        self.level, self.line = level, ""

    def write(self, text):
        *lines, self.line = (self.line + text).split("\n")
        for line in lines:
            farop_host.log(self.level, line)
        return len(text)

    def flush(self):
        pass


class Host:
    """What the host offers: log(text, level) and option(key)."""

    DEBUG, INFO, WARNING, ERROR = range(4)

    @staticmethod
    def log(text, level=INFO):
        farop_host.log(level, str(text))

    @staticmethod
    def option(key, default=None):
        value = farop_host.option(str(key))
        return default if value is None else value


def report(error, file):
    """Logs a failure so that the line of the user's file comes last, where the host quotes it from."""
    if isinstance(error, SyntaxError) and error.filename == file:
        farop_host.log(3, f"{file}:{error.lineno}:{error.offset}: {error.msg}")
        return
    for line in "".join(traceback.format_exception(error)).rstrip().split("\n"):
        farop_host.log(1, line)
    frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename == file]
    where = f"{file}:{frames[-1].lineno}: " if frames else ""
    words = str(error).strip().split("\n")[-1]
    farop_host.log(3, f"{where}{type(error).__name__}: {words}")


def load(source, file):
    """The class of the user's file, the bits that it wants, and what it says of itself."""
    sys.stdout, sys.stderr = Log(1), Log(2)
    module = types.ModuleType("rasterizer")
    module.__file__ = file
    sys.modules["rasterizer"] = module
    exec(compile(source, file, "exec"), module.__dict__)
    rasterizer = module.__dict__.get("Rasterizer")
    if not isinstance(rasterizer, type):
        raise TypeError("it defines no class Rasterizer")
    for name in REQUIRED:
        if not callable(getattr(rasterizer, name, None)):
            raise TypeError(f"its class Rasterizer has no method {name}")
    wants = 0
    for wish in getattr(rasterizer, "wants", ()):
        if wish not in WISHES:
            raise ValueError(f"it wants {wish!r}, which is none of {', '.join(WISHES)}")
        wants |= WISHES[wish]
    text = (rasterizer.__doc__ or module.__doc__ or "").strip().split("\n")[0]
    return rasterizer, wants, text


def create(rasterizer):
    self = rasterizer()
    if hasattr(self, "create"):
        self.create(Host)
    return self


def destroy(self):
    if hasattr(self, "destroy"):
        self.destroy()


def begin_frame(self, memory, row_bytes, background, **numbers):
    frame = types.SimpleNamespace(**numbers)
    frame.background = tuple(background)
    frame.pixels = np.ndarray((frame.height, frame.width, 3), np.uint8, memory, strides=(row_bytes, 3, 1))
    return self.begin_frame(frame)


def vectors(memory):
    return None if memory is None else np.frombuffer(memory, np.float32).reshape(-1, 3)


def polygon(self, vertices, normals, eye_positions, vertex_ids, material, index, flags, surface_id, object_id):
    p = types.SimpleNamespace(
        vertices=np.frombuffer(vertices, VERTEX),
        normals=vectors(normals),
        eye_positions=vectors(eye_positions),
        vertex_ids=None if vertex_ids is None else np.frombuffer(vertex_ids, np.uint32),
        material=None,
        index=index,
        convex=bool(flags & 1),
        back_facing=bool(flags & 2),
        surface_id=surface_id,
        object_id=object_id,
    )
    if material is not None:
        number, values = material
        p.material = types.SimpleNamespace(
            id=number, color=values[0:3], ambient=values[3], diffuse=values[4], specular=values[5],
            shininess=values[6], opacity=values[7:10])
    return self.polygon(p)


def end_frame(self):
    return self.end_frame()
