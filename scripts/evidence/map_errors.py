"""What maps of simulated missions say wrongly, beside what they state: errors of each kind with the parts of their variance.

A map states sd² = shared · g² + common² + (taper · radius)², where g is the graph's: with the values that the run was flown with g² follows
from what is written, so that other values can be tried without flying again.
"""
import collections
import json
import math
import re

GATE_M = {"cuboid": 1.5, "cylinder": 0.8}  # as `saker map eval`
FIXED, FITTED = "fixed", "fitted"
OF_RADIUS = ("common_root", "common_taper")  # shares of it

# keys: (key of slam.noise, the power in which it is the weight of a part). Errors of an object along several axes are several rows.
Kind = collections.namedtuple("Kind", "name shape keys")


def kinds(source):
    """With fitted noise cells count once, and what vehicles have in common is the model's."""
    radius = "shared_radius" if source == FIXED else "shared_radius_cells"
    found = [Kind("radius", "cylinder", ((radius, 1), ("common_radius_m", 2), ("common_taper", 2)))]
    if source == FITTED:
        return [*found, Kind("root", "cylinder", (("common_root", 2),))]
    return [*found, Kind("root", "cylinder", (("shared_root", 1), ("common_root", 2))),
            Kind("place", "cuboid", (("shared_place", 1), ("common_place_m", 2))),
            Kind("length", "cuboid", (("shared_length", 1), ("common_length_m", 2))),
            Kind("width", "cuboid", (("shared_width", 1), ("common_width_m", 2)))]


def runs_below(folder):
    """Folders with a map in the frame of its truth."""
    return sorted(file.parent for file in folder.rglob("map.json") if (file.parent / "truth.json").exists())


def flown_with(run):
    """The text of the configuration, from the experiment that the run belongs to."""
    for folder in (run, *run.parents):
        if (folder / "experiment.json").exists():
            return json.loads((folder / "experiment.json").read_text())["configuration"]
    raise ValueError(f"{run}: no experiment.json there or above says what it was flown with")


def values_of(text):
    """{slam.noise key: number} and slam.measurement_noise of a configuration as `saker config --all` prints it."""
    path, values, source = [], {}, None
    for line in text.splitlines():
        found = re.match(r"( *)(\w+): *([^# ]*)", line)
        if not found:
            continue
        path = path[:len(found[1]) // 2] + [found[2]]
        if path[:2] == ["slam", "noise"] and len(path) == 3:
            values[path[2]] = float({"true": 1, "false": 0}.get(found[3], found[3]))
        if path == ["slam", "measurement_noise"]:
            source = found[3]
    if not values or source not in (FIXED, FITTED):
        raise ValueError("a configuration without slam.noise or slam.measurement_noise")
    return values, source


def noise_of(runs):
    """Of all runs, which are to have been flown with the same."""
    texts = [values_of(flown_with(run)) for run in runs]
    if any(other != texts[0] for other in texts):
        raise ValueError("the runs were flown with different slam.noise or slam.measurement_noise")
    return texts[0]


def place(item):
    return item.get("position") or item["root"]


def distance(a, b):
    return math.dist(place(a)[:2], place(b)[:2])


def pairs(mapped, truth, shape):
    """Of objects of one class those that are each other's nearest, within the gate."""
    held = "size" if shape == "cuboid" else "radius"
    mapped, truth = [[o for o in objects if held in o] for objects in (mapped, truth)]
    nearest = lambda one, others: min((o for o in others if o["class"] == one["class"]), key=lambda o: distance(one, o), default=None)
    for one in mapped:
        other = nearest(one, truth)
        if other is not None and nearest(other, mapped) is one and distance(one, other) <= GATE_M[shape]:
            yield one, other


def yaw(item):
    x, y, z, w = item["rotation"]
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def along(item, dx, dy):
    """A horizontal vector in the object's own frame."""
    c, s = math.cos(yaw(item)), math.sin(yaw(item))
    return c * dx + s * dy, c * dy - s * dx


def of_pair(one, other, kind):
    """[(error, stated sd)]; nothing where length and width are mixed up: that is another error than those of a size."""
    d = [a - b for a, b in zip(place(one), place(other))]
    if kind.name == "root":
        return list(zip(d[:2], one["sd"]["root"][:2]))
    if kind.name == "radius":
        return [(one["radius"] - other["radius"], one["sd"]["radius"])]
    if abs(math.sin(yaw(one) - yaw(other))) > math.sqrt(0.5):
        return []
    if kind.name == "place":
        return list(zip(along(one, *d[:2]), one["sd"]["position"][:2]))
    axis = ("length", "width").index(kind.name)
    return [(one["size"][axis] - other["size"][axis], one["sd"]["size"][axis])]


def parts(stated, radius, kind, noise):
    """(what the kind's weights multiply, what has no weight): the graph's part, where cells count once, has none."""
    common = [(key, power) for key, power in kind.keys if not key.startswith("shared_")]
    own = [radius ** 2 if key in OF_RADIUS else 1.0 for key, _ in common]
    graph = max(0.0, stated ** 2 - sum(noise[key] ** power * part for (key, power), part in zip(common, own)))
    shared = [noise[key] for key, _ in kind.keys if key.startswith("shared_")]
    return ([graph / shared[0], *own], 0.0) if shared else (own, graph)


def rows(run, kind, noise):
    """[(error, parts, known)] of a run's map, as scripts/evidence/variances.py takes them."""
    mapped, truth = [json.loads((run / name).read_text())["objects"] for name in ("map.json", "truth.json")]
    found = []
    for one, other in pairs(mapped, truth, kind.shape):
        if "sd" not in one:
            continue
        for error, stated in of_pair(one, other, kind):
            found.append((error, *parts(stated, one.get("radius", 0.0), kind, noise)))
    return found
