// SPDX-License-Identifier: Apache-2.0
// The document itself was not at hand. The numbers of tables 7.9.2.1-1, -2 and -4 to -7 were taken from two programs
// that state them independently, 5G NR Radar of NIST (getSigmaRCS.m, 2025) and Sionna RT 2.2
// (rcs/tr38901/parameters.py, 2026), and agree there. Table -3, k1 and k2 of persons and vehicles, the ratios of
// table 7.9.2.2-1 and the sizes are those of Sionna RT alone: NIST has k of large UAVs at vehicles.
#include "radio/target_kinds.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace wavetracer {
namespace {

constexpr std::array<double, 4> all_ways{0, 180, 0, 360};
constexpr double no_floor = std::numeric_limits<double>::infinity();

// Model 1 (eq. 7.9.2-2): the same in all directions, without a floor; table 7.9.2.1-1.
constexpr KindLobe small_uav[] = {{"all", 0, 0, 0, 0, -12.81, no_floor, all_ways}};
constexpr KindLobe person[] = {{"all", 0, 0, 0, 0, -1.37, no_floor, all_ways}};

// Model 2 (eq. 7.9.2-3).
constexpr KindLobe large_uav[] = {  // table 7.9.2.1-2
    {"left", 90, 7.13, 90, 8.68, 7.43, 14.30, {45, 135, 45, 135}},
    {"back", 180, 10.09, 90, 11.43, 3.99, 10.86, {45, 135, 135, 225}},
    {"right", 270, 7.13, 90, 8.68, 7.43, 14.30, {45, 135, 225, 315}},
    {"front", 0, 14.19, 90, 16.53, 1.02, 7.89, {45, 135, -45, 45}},
    {"bottom", 0, 0, 180, 4.93, 13.55, 20.42, {135, 180, 0, 360}},
    {"roof", 0, 0, 0, 4.93, 13.55, 20.42, {0, 45, 0, 360}}};
constexpr KindLobe person_aspects[] = {  // table 7.9.2.1-3
    {"front", 0, 216.65, 90, 55.7, 2.14, 7.7, {0, 180, -90, 90}},
    {"back", 180, 216.65, 90, 55.7, 2.14, 7.7, {0, 180, 90, 270}}};
constexpr KindLobe vehicle[] = {  // table 7.9.2.1-4
    {"left", 90, 26.90, 79.70, 44.42, 20.75, 13.68, {30, 180, 45, 135}},
    {"back", 180, 36.32, 79.65, 36.73, 14.56, 7.50, {30, 180, 135, 225}},
    {"right", 270, 26.90, 79.70, 44.42, 20.75, 13.68, {30, 180, 225, 315}},
    {"front", 0, 40.54, 71.75, 29.13, 15.52, 8.45, {30, 180, -45, 45}},
    {"roof", 0, 0, 0, 18.13, 21.26, 14.19, {0, 30, 0, 360}}};
constexpr KindLobe vehicle_points[] = {  // table 7.9.2.1-5
    {"left", 90, 26.90, 79.70, 44.42, 20.60, 20.52, all_ways},
    {"back", 180, 36.32, 79.65, 36.73, 13.90, 13.82, all_ways},
    {"right", 270, 26.90, 79.70, 44.42, 20.60, 20.52, all_ways},
    {"front", 0, 40.54, 71.75, 29.13, 14.99, 14.91, all_ways},
    {"roof", 0, 0, 0, 18.13, 21.12, 21.05, all_ways}};
constexpr KindLobe agv[] = {  // table 7.9.2.1-6
    {"front", 0, 13.68, 90, 13.68, 13.02, 23.29, {30, 180, -45, 45}},
    {"left", 90, 15.53, 75, 20.03, 7.33, 17.60, {30, 180, 45, 135}},
    {"back", 180, 12.49, 90, 11.89, 11.01, 21.28, {30, 180, 135, 225}},
    {"right", 270, 15.53, 75, 20.03, 7.33, 17.60, {30, 180, 225, 315}},
    {"roof", 0, 0, 0, 11.44, 11.79, 22.06, {0, 30, 0, 360}}};
constexpr KindLobe agv_points[] = {  // table 7.9.2.1-7
    {"front", 0, 13.68, 90, 13.68, 13.00, 30.26, all_ways},
    {"left", 90, 15.53, 75, 20.03, 7.27, 24.53, all_ways},
    {"back", 180, 12.49, 90, 11.89, 10.98, 28.24, all_ways},
    {"right", 270, 15.53, 75, 20.03, 7.27, 24.53, all_ways},
    {"roof", 0, 0, 0, 11.44, 11.77, 29.03, all_ways}};

constexpr std::array<double, 3> of_model_1{3, 1, 0}, of_persons{0.5714, 0.1, 5}, of_large_uavs{6.05, 1.33, 5},
    of_vehicles{6, 1.65, 5}, of_agvs{12, 1.45, 5};
constexpr double uav_xpr_db = 13.75, person_xpr_db = 19.81, vehicle_xpr_db = 21.12, agv_xpr_db = 9.60;
const glm::dvec3 person_size{0.5, 0.5, 1.75}, vehicle_size{5, 2, 1.6}, agv_size{0.5, 1, 0.5};
constexpr double person_height = 1.5 / 1.75;  // table 7.9.6.1-2

const KindLaw laws[] = {
    {"person", person, false, of_model_1, person_xpr_db, person_size, person_height},
    {"person-aspects", person_aspects, false, of_persons, person_xpr_db, person_size, person_height},
    {"uav-small", small_uav, false, of_model_1, uav_xpr_db, {0.3, 0.4, 0.2}, 0.5},
    {"uav-large", large_uav, false, of_large_uavs, uav_xpr_db, {1.6, 1.5, 0.7}, 0.5},
    {"vehicle", vehicle, false, of_vehicles, vehicle_xpr_db, vehicle_size, 0.5},
    {"vehicle-points", vehicle_points, true, of_vehicles, vehicle_xpr_db, vehicle_size, 0.5},
    {"agv", agv, false, of_agvs, agv_xpr_db, agv_size, 0.5},
    {"agv-points", agv_points, true, of_agvs, agv_xpr_db, agv_size, 0.5}};

// The middle of a side of a box of this size that stands on the origin.
glm::dvec3 side_of(std::string_view side, const glm::dvec3& size_m) {
  const glm::dvec3 half = size_m / 2.0;
  if (side == "front") return {half.x, 0, half.z};
  if (side == "back") return {-half.x, 0, half.z};
  if (side == "left") return {0, half.y, half.z};
  if (side == "right") return {0, -half.y, half.z};
  return {0, 0, size_m.z};
}

}  // namespace

const KindLaw& kind_law(TargetKind kind) {
  return *std::ranges::find_if(laws, [&](const KindLaw& law) { return law.kind.index() == kind.index(); });
}

std::vector<glm::dvec3> kind_points(TargetKind kind, const glm::dvec3& size_m) {
  const KindLaw& law = kind_law(kind);
  if (!law.points) return {{0, 0, law.height * size_m.z}};
  std::vector<glm::dvec3> out;
  for (const KindLobe& lobe : law.lobes) out.push_back(side_of(lobe.side, size_m));
  return out;
}

}  // namespace wavetracer
