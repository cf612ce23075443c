// SPDX-License-Identifier: Apache-2.0
// The slow, obvious tracer of these tests: watertight intersection in double, brute force, and plain recursion through
// layouts. It does not depend on how trees were built; it reads the layouts as wavetracer/device/bvh.h defines them.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "accel/layout.hpp"

namespace wavetracer::test {

struct OracleRay {
  std::array<double, 3> origin, direction;
};

struct OracleHit {
  double t = std::numeric_limits<double>::infinity();
  uint32_t primitive = ~0u;  // the lowest of several at the same distance
  bool operator==(const OracleHit&) const = default;
};

OracleHit trace_brute_force(std::span<const AccelTriangle> triangles, const OracleRay& ray);
OracleHit trace(const Bvh2& bvh, const OracleRay& ray);
OracleHit trace(const Bvh8& bvh, const OracleRay& ray);

// Walks a structure and returns its faults, if any: boxes that do not contain everything below them, nodes and
// triangles met more or less often than once, leaves that are too large, wrong depths. exact: no triangle may be cut.
std::vector<std::string> faults(const BinaryTree& tree, std::span<const AccelTriangle> triangles,
                                const BuildOptions& options);
std::vector<std::string> faults(const Bvh2& bvh, std::span<const AccelTriangle> triangles, bool exact);
std::vector<std::string> faults(const Bvh8& bvh, std::span<const AccelTriangle> triangles, bool exact);

}  // namespace wavetracer::test
