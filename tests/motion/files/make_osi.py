#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes ground_truth.osi and sensor_view.osi with ASAM's own bindings (PyPI: osi-python 3.8.0), for osi_test.cpp.

usage: make_osi.py FOLDER

A car drives a circle of 20 m radius at 10 m/s and sinks its nose by 0.1 rad, a bus stands, a pedestrian has no size.
"""
import math
import pathlib
import struct
import sys

from osi3.osi_groundtruth_pb2 import GroundTruth
from osi3.osi_object_pb2 import MovingObject
from osi3.osi_sensorview_pb2 import SensorView

RADIUS, SPEED = 20.0, 10.0
Vehicle = MovingObject.VehicleClassification


def set_triple(message, values):
    for field, value in zip(message.DESCRIPTOR.fields, values):
        setattr(message, field.name, value)


def add_object(truth, number, kind, vehicle, size, position, angles, velocity):
    thing = truth.moving_object.add()
    thing.id.value = number
    thing.type = kind
    if vehicle is not None:
        thing.vehicle_classification.type = vehicle
    if size:
        set_triple(thing.base.dimension, size)
    set_triple(thing.base.position, position)
    set_triple(thing.base.orientation, angles)
    set_triple(thing.base.velocity, velocity)


def ground_truth(frame):
    time_s = 100 + 0.1 * frame
    truth = GroundTruth()
    truth.version.version_major, truth.version.version_minor, truth.version.version_patch = 3, 8, 0
    truth.timestamp.seconds, truth.timestamp.nanos = int(time_s), round((time_s - int(time_s)) * 1e9)
    truth.host_vehicle_id.value = 7
    wall = truth.stationary_object.add()
    wall.id.value = 1
    light = truth.traffic_light.add()
    light.id.value = 2
    set_triple(light.base.position, (1, 2, 3))
    angle = SPEED / RADIUS * 0.1 * frame
    yaw, pitch = angle + math.pi / 2, 0.1
    ahead = (math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), -math.sin(pitch))
    up = (math.sin(pitch) * math.cos(yaw), math.sin(pitch) * math.sin(yaw), math.cos(pitch))
    foot = (RADIUS * math.cos(angle), RADIUS * math.sin(angle), 2.0)  # the middle of the footprint
    add_object(truth, 7, MovingObject.TYPE_VEHICLE, Vehicle.TYPE_MEDIUM_CAR, (4.6, 1.9, 1.4),
               [f + 0.7 * u for f, u in zip(foot, up)], (0, pitch, yaw), [SPEED * a for a in ahead])
    add_object(truth, 8, MovingObject.TYPE_VEHICLE, Vehicle.TYPE_BUS, (11.0, 2.6, 3.2), (-30, 5, 1.6), (0, 0, 0), (0, 0, 0))
    add_object(truth, 9, MovingObject.TYPE_PEDESTRIAN, None, None, (3, 4 + 0.14 * frame, 0.8595), (0, 0, math.pi / 2),
               (0, 1.4, 0))
    return truth


def sensor_view(frame, sensor):
    view = SensorView()
    truth = ground_truth(frame)
    view.version.CopyFrom(truth.version)
    view.timestamp.CopyFrom(truth.timestamp)
    view.sensor_id.value = 100 + sensor
    view.host_vehicle_id.value = 7
    view.global_ground_truth.CopyFrom(truth)
    return view


def write(file, messages):
    with open(file, "wb") as out:
        for message in messages:
            data = message.SerializeToString()
            out.write(struct.pack("<L", len(data)) + data)


if len(sys.argv) != 2:
    sys.exit(__doc__)
folder = pathlib.Path(sys.argv[1])
write(folder / "ground_truth.osi", [ground_truth(frame) for frame in range(6)])
write(folder / "sensor_view.osi", [sensor_view(frame, sensor) for frame in range(6) for sensor in range(2)])
