"""MMS-SLAM: localization and mapping among walking people and moving vehicles.

Stamps are whole nanoseconds, lengths meters. Poses are 4 x 4 matrices from the sensor to the world
frame. Errors are `Error` with the text of the command line; arguments that are no use to a function
raise ValueError.
"""
from ._mms import (
    Calibration, Camera, ConfigError, DataError, Error, FileError, Frame, MapCloud, ObjectBox,
    ObjectFrame, OccupancyGrid, Recording, Result, Slam, TrackedObject, Trajectory, TruthCloud,
    __version__, align_truth, evaluate_drift, evaluate_map, evaluate_masks, evaluate_objects,
    evaluate_trajectory, read_objects, write_objects)

__all__ = [
    "Calibration", "Camera", "ConfigError", "DataError", "Error", "FileError", "Frame", "MapCloud",
    "ObjectBox", "ObjectFrame", "OccupancyGrid", "Recording", "Result", "Slam", "TrackedObject",
    "Trajectory", "TruthCloud", "align_truth", "evaluate_drift", "evaluate_map", "evaluate_masks",
    "evaluate_objects", "evaluate_trajectory", "read_objects", "write_objects"]

for _name in __all__:  # as users see them, in texts and pickles
    globals()[_name].__module__ = __name__
del _name
