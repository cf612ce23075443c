// SPDX-License-Identifier: Apache-2.0
// Reads the results of a run: paths.h5 of a folder, one frame at a time. Viewer, plots and exports read runs through
// it. The file is not trusted: everything is checked before it is used.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include "output/summary_json.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/missed.hpp"
#include "wavetracer/output.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// A vehicle of the run: a row of /instances.
struct SavedInstance {
  std::string id, type;
  std::string model;  // a mesh file, or the name of a built-in shape
};

// The pose of a vehicle: p_scene = position_m + rotation p_model, both in the coordinates of their files.
struct SavedPose {
  uint32_t instance = 0;  // index in SavedRun::instances()
  glm::dvec3 position_m{0}, velocity_m_s{0};
  glm::dmat3 rotation{1.0};
};

struct SavedFrame {
  uint32_t number = 0;
  double time_s = 0;
  Paths paths;                   // paths of this frame alone, so vertex_offset begins with 0
  std::vector<SavedPose> poses;  // poses of the vehicles that are present
  // In file coordinates, one per end of the run; NaN while it is absent.
  std::vector<glm::dvec3> transmitter_position_m, receiver_position_m;
  std::vector<glm::dvec3> transmitter_velocity_m_s, receiver_velocity_m_s;
  std::vector<Link> links;  // links that were computed, with paths or without
};

class SavedRun {
 public:
  // path: the folder of a run, or its paths.h5. Throws InputError if the file does not exist, was not written by
  // wavetracer, or parts of it are missing, have another shape, or contradict each other.
  explicit SavedRun(const std::filesystem::path& path);
  ~SavedRun();
  SavedRun(SavedRun&&) noexcept;
  SavedRun& operator=(SavedRun&&) noexcept;

  const std::filesystem::path& file() const;
  const std::string& version() const;           // version of the program that wrote it
  const std::string& device() const;            // from the summary.json beside it; empty if there is none
  const std::optional<Missed>& missed() const;  // from the same file; nothing if unknown
  const std::string& missed_unknown() const;    // why frames do not know what was missed; empty if all know it
  const std::optional<CertificateFacts>& certificate() const;  // from the same file; nothing without beams
  const std::string& config_text() const;                      // TOML, with absolute paths
  double frequency_hz() const;
  // Name, antenna, polarization and orientation are as configured; positions of moving ends are in frames.
  const std::vector<RadioEnd>& transmitters() const;
  const std::vector<RadioEnd>& receivers() const;
  const std::vector<SavedInstance>& instances() const;
  const std::vector<InputFile>& inputs() const;  // files that the run has read; none if an older version wrote it
  uint32_t rx_ports() const;
  uint32_t tx_ports() const;

  // Rows are frames in their order, counted from 0; their numbers may start elsewhere (run --frames).
  size_t frame_count() const;
  uint32_t number(size_t row) const;
  double time_s(size_t row) const;
  uint64_t path_count() const;            // over all frames
  uint64_t path_count(size_t row) const;  // number in one frame
  uint64_t link_count() const;            // over all frames
  uint64_t first_link(size_t row) const;  // row of the frame's first link among those of all frames
  SavedFrame frame(size_t row) const;     // throws InputError

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer
