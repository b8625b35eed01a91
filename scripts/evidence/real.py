"""What docs/real.json (scripts/real) says, in short: nothing is measured here."""
DRIVES = ("kitti_drive_0005", "pandaset_002")
OF_DRIVE = {"found": "map.found", "size_mae_m": "map.size_mae_m", "box_size_mae_m": "map.box_size_mae_m",
            "length_bias_m": "map.length_bias_m", "size_nees": "map.size_nees", "invented_on_moving_paths": "map.invented_on_moving_paths",
            "window_mae_m": "windows.size_mae_m", "window_hull_mae_m": "windows.hull_size_mae_m",
            "window_box_mae_m": "windows.box_size_mae_m", "sharpness_cm": "odometry.sharpness_cm",
            "parked_spread_m": "odometry.parked_spread_m"}


def section(document):
    """{"drives": {…}, "vehicle_iou": {…}}"""
    recordings = document["recordings"]
    value = lambda name, key: recordings[name]["figures"].get(key, {}).get("value")
    drives = {}
    for name in DRIVES:
        if name in recordings:
            drives[name] = {key: value(name, path) for key, path in OF_DRIVE.items()}
            drives[name] |= {"listed": recordings[name]["figures"]["map.found"]["of"], "commit": recordings[name]["commit"]}
    iou = {name: value(name, "vehicle.iou") for name in recordings if value(name, "vehicle.iou") is not None}
    return {"drives": drives, "vehicle_iou": iou}
