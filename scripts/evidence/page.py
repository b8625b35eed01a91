"""docs/results.md, from docs/results.json alone."""
from evidence.common import command_lines, prose, table
from evidence.real_time import LOOPS


def m(value, digits=3):
    return "–" if value is None else f"{value:.{digits}f}".replace("-", "−")


def percent(value):
    return "–" if value is None else f"{100 * value:.3g} %"


def interval(figure):
    return f"{m(figure['estimate'], 2)} ({m(figure['low'], 2)} to {m(figure['high'], 2)})"


def flown(entry):
    """How it came about."""
    return ["", *(f"    {line}" for line in command_lines(entry["command"])), "", f"Seeds {entry['seeds']}; commit {entry['commit']}; {entry['machine']}; {entry['date']}.", ""]


def of(row, found, all_of):
    return f"{row[found]} of {row[all_of]}"


def invented(row):
    names = ("vehicle", "trunk", "pole")
    return ", ".join(f"{row['classes'][name]['invented']} of {row['classes'][name]['mapped']}" for name in names if name in row["classes"])


def mission_rows(entry):
    for name in entry["variants"]:
        row = entry[name]
        said = row.get("predictions", {}).get("realised_over_predicted")
        errors = [f"{m(row[of_what]['bias_m'])}, {m(row[of_what]['sd_m'])}" for of_what in ("length", "width")]
        yield [f"`{name}`", of(row, "reachable_found", "reachable"), m(row["mae_m"]), *errors, m(row["size_nees"], 2),
               of(row, "succeeded", "runs"), row["collisions"], m(row["min_clearance_m"], 2), m(row["flight_time_s"], 0),
               m(row["path_m"], 0), invented(row), m(said, 2)]


def scenario_rows(entry):
    for where, rows in entry["scenarios"].items():
        yield [f"`{where}`", *(f"{of(row, 'reachable_found', 'reachable')}, {m(row['mae_m'])}, {m(row['flight_time_s'], 0)}"
                               for row in rows.values())]


def missions(entry):
    lines = prose("""Simulated missions in lockstep. All policies fly the same worlds with the same estimator: they differ in where they look from.
        `sides` and `paper` are the best that others would do. `sides` visits two opposite corners of each vehicle of the prior map, with as
        much time as `saker` or more. `paper` chooses among all views that its model has seen flown, not the centroids of the best
        quarter.""")
    lines += ["", *table(["name", "settings"], [[f"`{name}`", f"`{said}`"] for name, said in entry["variants"].items()]), ""]
    lines += prose("""Errors of length and width are mapped − true, of found targets; MAE: of both together. Found: of the targets that world and
        geofence let reach. NEES: 1 where covariances are honest. Home: missions that ended their tour and landed where they began.
        Predicted: the error after a viewpoint over what was predicted before it.""")
    heads = ["policy", "found", "MAE m", "length: bias, sd m", "width: bias, sd m", "NEES of size", "home", "collisions", "least clearance m",
             "time s", "path m", "invented: vehicles, trunks, poles", "predicted"]
    lines += ["", *table(heads, mission_rows(entry))]
    if entry["saker_against"]:
        rows = [[f"`{name}`", *(interval(row[key]) for key in ("mae_m", "sd_m", "flight_time_s"))] for name, row in entry["saker_against"].items()]
        lines += ["", "`saker` over each other policy, with 95 % intervals (paired bootstrap over missions):", ""]
        lines += table(["against", "MAE", "sd", "time"], rows)
    lines += ["", "By scenario: found, MAE (m), time (s).", ""]
    lines += table(["scenario", *(f"`{name}`" for name in entry["variants"])], scenario_rows(entry))
    return lines + flown(entry) + ["![Errors of length and width, mapped − true](pictures/policy_errors.png)"]


def real(entry):
    lines = prose("""From [real.md](real.md) (`scripts/real`). Median size: the error, had each listed vehicle been given the median length and
        width of all that are labelled in the drive.""")
    rows = [[f"`{name}`", of(row, "found", "listed"), m(row["size_mae_m"]), m(row["box_size_mae_m"]), m(row["length_bias_m"]),
             m(row["size_nees"], 2), m(row["window_mae_m"]), m(row["window_hull_mae_m"]), m(row["window_box_mae_m"]),
             m(row["sharpness_cm"], 2), row["commit"]] for name, row in entry["drives"].items()]
    heads = ["drive", "found", "MAE of length and width m", "median size m", "bias of length m", "NEES of size", "single windows m",
             "the same, paper's hull", "the same, a box of 4.5 m by 1.9 m", "odometry: sharpness cm", "commit"]
    lines += ["", *table(heads, rows), "", "Vehicle IoU:", ""]
    return lines + table([f"`{name}`" for name in entry["vehicle_iou"]], [[m(value, 2) for value in entry["vehicle_iou"].values()]])


def flights(entry):
    lines = prose(f"""{entry['flights']} simulated flights past parked vehicles, trees and poles (OS1-64, 40 s each), mapped from their captures. A true
        object counts where 100 returns hit it. Mean size: the error, had all vehicles been given that of them all.""")
    rows = []
    for name, row in entry["classes"].items():
        sizes = [m(row.get("size_mae_m")), m(row.get("constant_size_mae_m")), m(row.get("length_slope"), 2)]
        nees = [m(row["nees"][what], 2) for what in ("size", "place")]
        rows.append([name, of(row, "found", "truth"), of(row, "invented", "mapped"), row["duplicates"], *sizes, *nees])
    heads = ["class", "found", "invented", "twice", "MAE of length and width m", "mean size m", "slope of mapped on true length",
             "NEES of size", "NEES of place"]
    trajectory = entry["trajectory_m"]
    lines += ["", *table(heads, rows), ""]
    lines += prose(f"""Trajectory, position RMSE: {m(trajectory['median'])} m (median), {m(trajectory['worst'])} m (worst); at least
        {m(entry['real_time_factor'], 1)} times real time.""")
    return lines + flown(entry)


REAL_TIME_ROWS = [
    ("targets found", "found", 0), ("MAE of length and width, m", "mae_m", 3), ("trajectory, position RMSE, m", "trajectory_error_m", 3),
    ("its greatest error, m", "trajectory_max_m", 3), ("collisions", "collisions", 0),
    ("clearance of the vehicle's sphere, m", "min_clearance_m", 2), ("in the air, s", "flight_time_s", 0), ("path, m", "path_m", 0),
    ("executive, CPU seconds a second", "cpu", 2), ("collision checker", "checker_cpu", 2), ("simulator", "simulator_cpu", 2)]


def real_time(entry):
    both = (entry["median"], entry["worst"])
    rows = [[name, *(m(row.get(key), digits) for row in both)] for name, key, digits in REAL_TIME_ROWS]
    for loop in LOOPS:
        rows.append([f"{loop}: late by more than 5 ms; worst, ms",
                     *(f"{percent(row[loop + '_late'])}; {m(row[loop + '_worst_ms'], 1)}" for row in both)])
    lines = prose(f"""Simulator, collision checker and executive, three processes over LCM and UDP, {entry['median']['targets']:.0f} targets. Of
        {entry['flights']} flights the median and the worst of each figure.""")
    return lines + ["", *table(["figure", "median", "worst"], rows), *flown(entry),
                    "![The mission's map: objects, trajectory, viewpoints and truth from above](pictures/mission.png)"]


def teams(entry):
    lines = prose("""Three robots take off side by side, each maps the vehicles of its lot, the base merges what they tell it
        (`configs/missions/lots.yaml`).""")
    rows = [[name, of(row, "found", "targets"), m(row["objects_per_min"], 2), m(row["bias_m"]), m(row["sd_m"]), m(row["mae_m"]),
             row["collisions"], m(row["busy_s"], 0)] for name, row in entry["robots"].items()]
    heads = ["robot", "found", "objects a minute", "bias m", "sd m", "MAE m", "collisions", "flight and exchange s"]
    ratio = {key: m(value, 2) for key, value in entry["together_over_mean"].items()}
    lines += ["", *table(heads, rows), ""]
    lines += prose(f"""All together over the mean of the three: objects a minute {ratio['objects_per_min']} times, MAE {ratio['mae_m']} times,
        sd {ratio['sd_m']} times.""")
    return lines + flown(entry)


PARTS = {"missions": ("Missions: where to look from", missions), "real": ("Real recordings", real), "flights": ("Simulated flights", flights),
         "real-time": ("Flown in real time", real_time), "teams": ("Several robots", teams)}


def page(document):
    lines = ["# Results", ""]
    lines += prose("""`scripts/results` flies, measures and writes this page and [results.json](results.json).""")
    for part, (title, lines_of) in PARTS.items():
        body = lines_of(document[part]) if part in document else [f"Not measured yet: `scripts/results {part}`."]
        lines += ["", f"## {title}", "", *body]
    return "\n".join(lines).rstrip("\n") + "\n"
