// What a run has written, read back: paths.h5 of a folder, one frame at a time. Viewer, plots and exports read runs
// here. Everything in the file is checked before it is used; an HDF5 file is input like any other.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>
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

// Where a vehicle is: p_scene = position_m + rotation p_model, both in the coordinates of their files.
struct SavedPose {
  uint32_t instance = 0;  // of SavedRun::instances()
  glm::dvec3 position_m{0}, velocity_m_s{0};
  glm::dmat3 rotation{1.0};
};

struct SavedFrame {
  uint32_t number = 0;
  double time_s = 0;
  Paths paths;                   // of this frame alone, so vertex_offset begins with 0
  std::vector<SavedPose> poses;  // of the vehicles that are present
  // File coordinates, one per end of the run; NaN while it is absent.
  std::vector<glm::dvec3> transmitter_position_m, receiver_position_m;
  std::vector<glm::dvec3> transmitter_velocity_m_s, receiver_velocity_m_s;
  std::vector<Link> links;  // that were asked for, with paths or without
};

class SavedRun {
 public:
  // path: the folder of a run, or its paths.h5. Throws InputError where there is none, or it is none of wavetracer's,
  // or parts of it are missing, of another shape, or contradict each other.
  explicit SavedRun(const std::filesystem::path& path);
  ~SavedRun();
  SavedRun(SavedRun&&) noexcept;
  SavedRun& operator=(SavedRun&&) noexcept;

  const std::filesystem::path& file() const;
  const std::string& version() const;           // of the program that wrote it
  const std::string& device() const;            // by the summary.json beside it; empty where there is none
  const std::optional<Missed>& missed() const;  // by the same file; nothing where it is not known
  const std::string& config_text() const;       // TOML, with absolute paths
  double frequency_hz() const;
  // name, antenna, polarization and orientation as configured; positions of moving ends are those of frames.
  const std::vector<RadioEnd>& transmitters() const;
  const std::vector<RadioEnd>& receivers() const;
  const std::vector<SavedInstance>& instances() const;
  const std::vector<InputFile>& inputs() const;  // that the run has read; none where an older version wrote it
  uint32_t rx_ports() const;
  uint32_t tx_ports() const;

  // Rows are frames in their order, counted from 0; their numbers may begin elsewhere (run --frames).
  size_t frame_count() const;
  uint32_t number(size_t row) const;
  double time_s(size_t row) const;
  uint64_t path_count() const;            // of all frames
  uint64_t path_count(size_t row) const;  // of one
  uint64_t link_count() const;            // of all frames
  uint64_t first_link(size_t row) const;  // of that frame among those of all
  SavedFrame frame(size_t row) const;     // throws InputError

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer
