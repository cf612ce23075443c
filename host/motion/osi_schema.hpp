// SPDX-License-Identifier: Apache-2.0
// ASAM Open Simulation Interface 3.8.0: the numbers of the fields that are read (osi_common, osi_object,
// osi_groundtruth and osi_sensorview.proto), and its classes of vehicles.
// Numbers never change between versions 3.x; fields of newer versions are skipped.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "motion/vehicle_types.hpp"

namespace wavetracer::osi {

inline constexpr std::array<uint32_t, 3> version = {3, 8, 0};

// Fields, by message.
namespace ground_truth {
enum : uint32_t { version = 1, timestamp = 2, moving_object = 5, proj_string = 14 };
}
namespace sensor_view {
enum : uint32_t { timestamp = 2, global_ground_truth = 7 };
}
namespace interface_version {
enum : uint32_t { major = 1, minor = 2, patch = 3 };
}
namespace timestamp {
enum : uint32_t { seconds = 1, nanos = 2 };
}
namespace identifier {
enum : uint32_t { value = 1 };
}
namespace moving_object {
enum : uint32_t { id = 1, base = 2, type = 3, vehicle_classification = 6, source_reference = 10 };
}
namespace base_moving {
enum : uint32_t { dimension = 1, position = 2, orientation = 3, velocity = 4, orientation_rate = 6 };
}
// Vector3d: x, y, z; Dimension3d: length, width, height; Orientation3d: roll, pitch, yaw.
namespace triple {
enum : uint32_t { first = 1, second = 2, third = 3 };
}
namespace vehicle_classification {
enum : uint32_t { type = 1 };
}
namespace external_reference {
enum : uint32_t { reference = 1, type = 2, identifier = 3 };
}

// MovingObject.Type
enum : uint64_t { other_object = 1, vehicle_object = 2, pedestrian_object = 3 };

// The source_reference of this program: identifiers are the id of the vehicle and the name of its type.
inline constexpr std::string_view reference = "wavetracer", reference_type = "org.wavetracer.vehicle";

// MovingObject.VehicleClassification.Type, and the SUMO class that is most like it. If a number or a class has several
// rows, the first counts.
struct ClassRow {
  uint64_t number;
  std::string_view word;
};
inline constexpr ClassRow classes[] = {
    {4, "passenger"}, {2, "passenger"}, {3, "passenger"},   {5, "passenger"},      {6, "delivery"},   {6, "van"},
    {6, "emergency"}, {7, "truck"},     {7, "lorry"},       {16, "truck"},         {8, "trailer"},    {9, "trailer"},
    {12, "bus"},      {12, "coach"},    {10, "motorcycle"}, {10, "moped"},         {11, "bicycle"},   {11, "bike"},
    {13, "tram"},     {14, "rail"},     {14, "rail_urban"}, {14, "rail_electric"}, {14, "rail_fast"}, {15, "bicycle"},
    {17, "bicycle"},  {18, "bicycle"},  {19, "truck"},      {20, "ship"}};

// A vehicle of an unknown class becomes a car of its size.
constexpr std::string_view class_of_number(uint64_t number) {
  for (const ClassRow& row : classes)
    if (row.number == number) return row.word;
  return "passenger";
}

// The OSI names of one of our types: MovingObject.Type, and the class of vehicles, 0 if it has none.
struct ObjectClass {
  uint64_t object, vehicle;
};
inline ObjectClass object_class(std::string_view type) {
  const std::string_view word = vehicle_class(type);
  if (word == "pedestrian" || word == "default_pedtype") return {pedestrian_object, 0};
  for (const ClassRow& row : classes)
    if (row.word == word) return {vehicle_object, row.number};
  if (word.empty() || word == "default_containertype") return {other_object, 0};
  return {vehicle_object, word == "default_biketype" ? 11u : word == "default_railtype" ? 14u : 4u};
}

}  // namespace wavetracer::osi
