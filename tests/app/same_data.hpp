// SPDX-License-Identifier: Apache-2.0
// Checks that two runs have written the same data, whichever processes computed them.
// It is for programs of doctest; the HDF5 files are those of the expected run.
#pragma once
#include <doctest/doctest.h>
#include <filesystem>
#include "output/reader.hpp"

namespace wavetracer::test {

// The files byte for byte, with the dataset that differs where one does; links.csv must hold more than least_bytes.
inline void check_same_data(const std::filesystem::path& found, const std::filesystem::path& expected,
                            size_t least_bytes) {
  for (const char* file : {"paths.h5", "waypoints.h5"}) {
    if (!std::filesystem::exists(expected / file)) continue;
    const auto a = datasets(found / file), b = datasets(expected / file);
    REQUIRE(a.size() == b.size());
    for (const auto& [name, value] : b) {
      CAPTURE(name);
      CHECK(a.at(name) == value);
    }
    const bool same_bytes = slurp(found / file) == slurp(expected / file);
    CAPTURE(file);
    CHECK(same_bytes);
  }
  CHECK(slurp(found / "links.csv") == slurp(expected / "links.csv"));
  CHECK(slurp(expected / "links.csv").size() > least_bytes);
}

}  // namespace wavetracer::test
