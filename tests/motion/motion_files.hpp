// SPDX-License-Identifier: Apache-2.0
// Small trajectory files for the tests of motion/: gzip, and FCD around samples.
// Assumes a writable folder for temporary files.
#pragma once
#include <doctest/doctest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>

#include "check_contains.hpp"
#include "motion/read.hpp"
#include "motion/track_motion.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::test {

inline constexpr double pi = std::numbers::pi;

inline std::string gzip(const std::string& text, int level = Z_BEST_SPEED) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, level, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string out(deflateBound(&stream, text.size()), '\0');
  std::string in = text;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

// The content in a file of this name, read.
inline Trajectories read_text(std::string_view content, const TrajectoryOptions& options = {},
                              const std::string& name = "drive.xml") {
  const TemporaryFolder folder;
  return read_trajectories(folder.write(name, content), options);
}

inline std::string fcd(const std::string& timesteps) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fcd-export>\n" + timesteps + "</fcd-export>\n";
}

// One line of an FCD file.
inline std::string timestep(const std::string& time, const std::string& elements) {
  return "<timestep time=\"" + time + "\">" + elements + "</timestep>\n";
}

// A sample that moves along its heading.
inline Sample sample_at(double time_s, glm::dvec3 position_m, double yaw_rad, double pitch_rad, double speed_m_s) {
  return {time_s, position_m, yaw_rad, pitch_rad, speed_m_s, speed_m_s * heading(yaw_rad, pitch_rad)};
}

inline void check_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    CHECK(std::abs(a[i] - b[i]) <= tolerance);
  }
}

}  // namespace wavetracer::test
