// SPDX-License-Identifier: Apache-2.0
// The hard suite: geometry and numbers at their limits, each case with its known answer.
// A case measures the difference between the program, run through Simulation, and that answer; the test and bench_hard
// share them.
#pragma once
#include <string>
#include <vector>

namespace wavetracer::test {

struct HardCase {
  std::string name, expectation;
  double measured = 0, tolerance = 0;
  std::string unit;
  bool holds() const { return measured <= tolerance; }  // false for NaN
};
using HardCases = std::vector<HardCase>;

// device: as for Simulation.
HardCases shadow_boundaries(const std::string& device);
HardCases bends(const std::string& device);
HardCases half_planes(const std::string& device);
HardCases surfaces_and_edges(const std::string& device);
HardCases meshes(const std::string& device);
HardCases grazing(const std::string& device);
HardCases far_away(const std::string& device);
HardCases many_bounces(const std::string& device);
HardCases energy(const std::string& device);
HardCases drives(const std::string& device);

struct HardTopic {
  const char* name;
  HardCases (*run)(const std::string& device);
};
inline constexpr HardTopic hard_topics[] = {{"shadow boundaries", shadow_boundaries},
                                            {"bends", bends},
                                            {"half planes", half_planes},
                                            {"surfaces and edges", surfaces_and_edges},
                                            {"meshes", meshes},
                                            {"grazing", grazing},
                                            {"far away", far_away},
                                            {"many bounces", many_bounces},
                                            {"energy", energy},
                                            {"drives", drives}};

}  // namespace wavetracer::test
