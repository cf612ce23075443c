// SPDX-License-Identifier: Apache-2.0
#include "calibration/agreements_of.hpp"
#include <algorithm>
#include <string>

namespace wavetracer::calibration {
namespace {

template <class Chosen>
Agreement agreement_of(const Calibration& result, bool with_held_out, const std::string& name, const Chosen& chosen) {
  std::vector<LevelPair> before, after, held_out;
  for (const FittedPoint& point : result.points) {
    if (result.files[point.file].points[point.point].below || !chosen(point)) continue;
    before.push_back({point.measured_db, point.before.gain_db});
    after.push_back({point.measured_db, point.after.gain_db + point.offset_db});
    held_out.push_back({point.measured_db, point.held_out.gain_db + point.offset_held_out_db});
  }
  Agreement out{name, statistics_of(before), statistics_of(after), {}};
  if (with_held_out) out.held_out = statistics_of(held_out);
  return out;
}

}  // namespace

std::vector<Agreement> agreements_of(const Calibration& result, bool held_out) {
  std::vector<Agreement> out{agreement_of(result, held_out, "all", [](const FittedPoint&) { return true; })};
  const auto add_each = [&](const auto& name_of_point) {
    std::vector<std::string> names;
    for (const FittedPoint& point : result.points)
      if (const std::string name = name_of_point(point); std::ranges::find(names, name) == names.end())
        names.push_back(name);
    if (names.size() < 2) return;
    for (const std::string& name : names)
      out.push_back(
          agreement_of(result, held_out, name, [&](const FittedPoint& point) { return name_of_point(point) == name; }));
  };
  add_each([&](const FittedPoint& point) { return result.files[point.file].file; });
  add_each([&](const FittedPoint& point) { return point.tx; });
  add_each([&](const FittedPoint& point) { return result.files[point.file].points[point.point].group; });
  return out;
}

}  // namespace wavetracer::calibration
