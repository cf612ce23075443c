// SPDX-License-Identifier: Apache-2.0
// Columns of wavetracer.h, whose type and width follow from the vector that holds them. Vectors of glm and of
// std::complex must be their numbers side by side.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>
#include "wavetracer/paths.hpp"
#include "wavetracer/wavetracer.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer::c_api {

static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && sizeof(Link) == 2 * sizeof(uint32_t));

template <class T>
struct Layout;
template <>
struct Layout<uint8_t> {
  static constexpr int type = WAVETRACER_UINT8, width = 1;
};
template <>
struct Layout<uint32_t> {
  static constexpr int type = WAVETRACER_UINT32, width = 1;
};
template <>
struct Layout<Link> {
  static constexpr int type = WAVETRACER_UINT32, width = 2;
};
template <>
struct Layout<uint64_t> {
  static constexpr int type = WAVETRACER_UINT64, width = 1;
};
template <>
struct Layout<double> {
  static constexpr int type = WAVETRACER_FLOAT64, width = 1;
};
template <>
struct Layout<glm::dvec3> {
  static constexpr int type = WAVETRACER_FLOAT64, width = 3;
};

template <>
struct Layout<GroupNumbers> {
  static constexpr int type = WAVETRACER_UINT32, width = most_groups;
};
template <>
struct Layout<GroupWeights> {
  static constexpr int type = WAVETRACER_FLOAT64, width = most_groups;
};

inline wavetracer_column checked(wavetracer_column column) {
  static const double nothing = 0;
  if (!column.data) column.data = &nothing;
  return column;
}

template <class T>
wavetracer_column view(const std::vector<T>& rows) {
  return checked({rows.data(), rows.size(), Layout<T>::width, Layout<T>::type});
}

}  // namespace wavetracer::c_api
