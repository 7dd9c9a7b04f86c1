"""The shared library: where it is, its structs, its functions. Mirrors include/bolter/*.h; a test
compares every size and offset with the compiler's."""

from __future__ import annotations

import ctypes as c
import os
from pathlib import Path
from typing import Iterator, List, Optional

VERSION = "0.2.0"
SONAME = "libbolter.so.0"
PACKAGE = Path(__file__).resolve().parent


def _ancestors(patterns: List[str]) -> Iterator[Path]:
    """What stands beside the package, in the prefix it is installed in, or in its source tree."""
    for folder in [PACKAGE, *list(PACKAGE.parents)[:5]]:
        for pattern in patterns:
            yield from sorted(folder.glob(pattern))


def _load() -> c.CDLL:
    named = os.environ.get("BOLTER_LIBRARY")
    if named:
        return c.CDLL(named)
    for path in _ancestors([SONAME, f"lib/{SONAME}", f"lib/*/{SONAME}", f"build/{SONAME}"]):
        return c.CDLL(str(path))
    return c.CDLL(SONAME)


def find_shipped(name: str) -> Path:
    """A file that is shipped, by its place in the source tree: "studies/reference/study.yaml"."""
    for path in _ancestors([f"share/bolter/{name}", name]):
        return path
    raise FileNotFoundError(f"{name} is not installed beside the package {PACKAGE}")


def find_study(name: str) -> Path:
    """The file of a study that is shipped: "reference"."""
    return find_shipped(f"studies/{name}/study.yaml")


# --- structs --------------------------------------------------------------------------------

MESSAGE = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p)


class bt_key(c.Structure):
    _fields_ = [
        ("path", c.c_char_p),
        ("unit", c.c_char_p),
        ("kind", c.c_char_p),
        ("equation", c.c_char_p),
        ("text", c.c_char_p),
        ("fallback", c.c_double),
        ("least", c.c_double),
        ("greatest", c.c_double),
    ]


class bt_landing_report(c.Structure):
    _fields_ = [
        ("size", c.c_size_t),
        ("failed", c.c_bool),
        ("engaged", c.c_bool),
        ("retained", c.c_bool),
        ("mode", c.c_char * 16),
        ("margin_m", c.c_double),
        ("throat_force_peak_N", c.c_double),
        ("hook_deck_force_peak_N", c.c_double),
        ("cable_tension_max_N", c.c_double),
        ("bounces", c.c_int),
        ("first_bounce_height_m", c.c_double),
        ("first_bounce_distance_m", c.c_double),
        ("strut_stroke_max_m", c.c_double * 3),
        ("tyre_force_max_N", c.c_double * 3),
        ("state_hash", c.c_uint64),
        ("failure", c.c_char * 320),
        ("remarks", c.c_char * 512),
    ]


class bt_landing_line(c.Structure):
    _fields_ = [
        ("time_s", c.c_double),
        ("count", c.c_int),
        ("names", c.POINTER(c.c_char_p)),
        ("values", c.c_void_p),
        ("cable_count", c.c_int),
        ("cable_x_m", c.c_void_p),
        ("cable_y_m", c.c_void_p),
        ("cable_z_m", c.c_void_p),
        ("cable_tension_N", c.c_void_p),
    ]


LANDING_WATCH = c.CFUNCTYPE(None, c.c_void_p, c.POINTER(bt_landing_line))


class bt_landing_def(c.Structure):
    _fields_ = [("size", c.c_size_t), ("watch", LANDING_WATCH), ("user", c.c_void_p)]


class bt_result_info(c.Structure):
    _fields_ = [("name", c.c_char_p), ("unit", c.c_char_p), ("text", c.c_char_p)]


BATCH_PROGRESSED = c.CFUNCTYPE(c.c_bool, c.c_void_p, c.c_int64, c.c_int64)


class bt_batch_def(c.Structure):
    _fields_ = [
        ("size", c.c_size_t),
        ("path_count", c.c_int),
        ("paths", c.POINTER(c.c_char_p)),
        ("count", c.c_int64),
        ("points", c.c_void_p),
        ("column_count", c.c_int),
        ("columns", c.POINTER(c.c_char_p)),
        ("threads", c.c_int),
        ("progress", BATCH_PROGRESSED),
        ("user", c.c_void_p),
    ]


class bt_campaign_counts(c.Structure):
    _fields_ = [
        ("total", c.c_int64),
        ("before", c.c_int64),
        ("done", c.c_int64),
        ("engaged", c.c_int64),
        ("missed", c.c_int64),
        ("failed", c.c_int64),
        ("seconds", c.c_double),
    ]


CAMPAIGN_PROGRESSED = c.CFUNCTYPE(c.c_bool, c.c_void_p, c.POINTER(bt_campaign_counts))


class bt_campaign_def(c.Structure):
    _fields_ = [
        ("size", c.c_size_t),
        ("shard", c.c_int),
        ("shards", c.c_int),
        ("progress", CAMPAIGN_PROGRESSED),
        ("user", c.c_void_p),
    ]


class bt_campaign_row(c.Structure):
    _fields_ = [
        ("run", c.c_int64),
        ("input_count", c.c_int),
        ("inputs", c.POINTER(c.c_char_p)),
        ("values", c.POINTER(c.c_double)),
        ("log_density", c.c_double),
        ("report", bt_landing_report),
    ]


class bt_rig_metric(c.Structure):
    _fields_ = [
        ("name", c.c_char_p),
        ("unit", c.c_char_p),
        ("value", c.c_double),
        ("reference", c.c_double),
        ("error_percent", c.c_double),
        ("accepted", c.c_bool),
    ]


class bt_rig_line(c.Structure):
    _fields_ = [
        ("time_s", c.c_double),
        ("count", c.c_int),
        ("names", c.POINTER(c.c_char_p)),
        ("values", c.c_void_p),
    ]


RIG_WATCH = c.CFUNCTYPE(None, c.c_void_p, c.POINTER(bt_rig_line))


class bt_rig_def(c.Structure):
    _fields_ = [
        ("size", c.c_size_t),
        ("rig", c.c_char_p),
        ("watch", RIG_WATCH),
        ("user", c.c_void_p),
    ]


class bt_fit_report(c.Structure):
    _fields_ = [
        ("size", c.c_size_t),
        ("trained_now", c.c_bool),
        ("train_count", c.c_int),
        ("train_correct", c.c_int),
        ("holdout_count", c.c_int),
        ("holdout_correct", c.c_int),
        ("holdout_ci95", c.c_double * 2),
        ("confusion", (c.c_int * 2) * 2),
        ("constant", c.c_bool),
        ("C", c.c_double),
        ("gamma", c.c_double),
        ("support_vectors", c.c_int),
        ("seconds", c.c_double),
    ]


class bt_fit_def(c.Structure):
    _fields_ = [("size", c.c_size_t), ("again", c.c_bool)]


class bt_reliability_line(c.Structure):
    _fields_ = [
        ("parameter", c.c_char_p),
        ("unit", c.c_char_p),
        ("value", c.c_double),
        ("corrected", c.c_double),
        ("corrected_ci95", c.c_double * 2),
        ("corrected_sampling", c.c_double),
        ("corrected_unseen", c.c_double),
        ("reweighted", c.c_double),
        ("reweighted_ci95", c.c_double * 2),
        ("effective_landings", c.c_double),
        ("surrogate", c.c_double),
        ("surrogate_ci95", c.c_double * 2),
        ("outside_share", c.c_double),
        ("landings", c.c_int64),
    ]


RELIABILITY_VISIT = c.CFUNCTYPE(None, c.c_void_p, c.POINTER(bt_reliability_line))
RELIABILITY_PROGRESSED = c.CFUNCTYPE(c.c_bool, c.c_void_p, c.c_int, c.c_int)


class bt_reliability_def(c.Structure):
    _fields_ = [("size", c.c_size_t), ("progress", RELIABILITY_PROGRESSED), ("user", c.c_void_p)]


STRUCTS = (
    bt_key,
    bt_landing_report,
    bt_landing_line,
    bt_landing_def,
    bt_result_info,
    bt_batch_def,
    bt_campaign_counts,
    bt_campaign_def,
    bt_campaign_row,
    bt_rig_metric,
    bt_rig_line,
    bt_rig_def,
    bt_fit_report,
    bt_fit_def,
    bt_reliability_line,
    bt_reliability_def,
)

# --- functions ------------------------------------------------------------------------------

KEY_VISIT = c.CFUNCTYPE(c.c_bool, c.c_void_p, c.POINTER(bt_key))
RESULT_VISIT = c.CFUNCTYPE(c.c_bool, c.c_void_p, c.POINTER(bt_result_info))
CAMPAIGN_VISIT = c.CFUNCTYPE(c.c_bool, c.c_void_p, c.POINTER(bt_campaign_row))

_case, _text, _int, _user = c.c_void_p, c.c_char_p, c.c_int, c.c_void_p
_texts, _opened, _real = c.POINTER(c.c_char_p), c.POINTER(c.c_void_p), c.POINTER(c.c_double)
_flight, _p = c.c_void_p, c.POINTER

#: name: (result, arguments)
FUNCTIONS = {
    "bt_version": (_text, []),
    "bt_status_text": (_text, [_int]),
    "bt_case_open": (_int, [_text, _texts, _int, MESSAGE, _user, _opened]),
    "bt_case_open_rigs": (_int, [_text, _texts, _int, MESSAGE, _user, _opened]),
    "bt_case_open_text": (_int, [_text, _text, c.c_size_t, MESSAGE, _user, _opened]),
    "bt_case_open_defaults": (_int, [_text, MESSAGE, _user, _opened]),
    "bt_case_close": (None, [_case]),
    "bt_case_set": (_int, [_case, _text, c.c_double]),
    "bt_case_get": (_int, [_case, _text, _real]),
    "bt_case_set_text": (_int, [_case, _text, _text]),
    "bt_case_title": (_text, [_case]),
    "bt_case_directory": (_text, [_case]),
    "bt_case_set_directory": (_int, [_case, _text]),
    "bt_case_text": (_text, [_case]),
    "bt_keys": (None, [KEY_VISIT, _user]),
    "bt_case_land": (_int, [_case, _p(bt_landing_report)]),
    "bt_case_land_watched": (_int, [_case, _p(bt_landing_def), _p(bt_landing_report)]),
    "bt_results": (None, [RESULT_VISIT, _user]),
    "bt_case_result": (_int, [_case, _text, _real]),
    "bt_mode_label": (_text, [_int]),
    "bt_case_land_batch": (_int, [_case, _p(bt_batch_def), c.c_void_p]),
    "bt_case_campaign": (_int, [_case, _p(bt_campaign_def), _p(bt_campaign_counts)]),
    "bt_case_ledger": (_int, [_case, CAMPAIGN_VISIT, _user]),
    "bt_case_rig": (_int, [_case, _p(bt_rig_def), _p(bt_rig_metric), _int, _p(_int)]),
    "bt_case_fit": (_int, [_case, _p(bt_fit_def), _p(bt_fit_report)]),
    "bt_case_fit_inputs": (_int, [_case]),
    "bt_case_fit_input": (_text, [_case, _int]),
    "bt_case_reliability": (
        _int,
        [_case, _p(bt_reliability_def), RELIABILITY_VISIT, _user],
    ),
    "bt_flight_create": (_int, [_case, _p(_flight)]),
    "bt_flight_destroy": (None, [_flight]),
    "bt_flight_step": (c.c_bool, [_flight]),
    "bt_flight_look": (None, [_flight, LANDING_WATCH, _user]),
    "bt_flight_copy": (_int, [_flight, _p(_flight)]),
    "bt_flight_equal": (c.c_bool, [_flight, _flight]),
    "bt_flight_report": (_int, [_flight, _p(bt_landing_report)]),
    "bt_case_predict": (_int, [_case, c.c_void_p, _int, c.c_void_p]),
}


def _bind() -> c.CDLL:
    try:
        library = _load()
    except OSError as error:
        raise ImportError(
            f"{SONAME} is not beside the package, not named by BOLTER_LIBRARY, and not found by "
            f"the system's loader: {error}"
        ) from error
    for name, (result, arguments) in FUNCTIONS.items():
        try:
            function = getattr(library, name)
        except AttributeError as error:
            raise ImportError(f"{library._name} is no library of Bolter {VERSION}: {error}") from error
        function.restype = result
        function.argtypes = arguments
    running = library.bt_version().decode()
    if running.split(".")[:2] != VERSION.split(".")[:2]:
        raise ImportError(f"{library._name} is of version {running}, the package of {VERSION}")
    return library


LIBRARY = _bind()


def texts(values: List[str]) -> "c.Array[c.c_char_p]":
    """``const char* const*`` of Python strings; it keeps them alive."""
    return (c.c_char_p * max(len(values), 1))(*[v.encode() for v in values])


def decode(text: Optional[bytes]) -> str:
    return text.decode("utf-8", "replace") if text else ""
