// SPDX-License-Identifier: Apache-2.0
// Exports of runs to the formats of other programs: one function per format, and the list that `wavetracer convert
// --to` offers. Each writes what its readers expect, completely or not at all; its own file describes the conventions.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

struct ExportOptions {
  std::filesystem::path output;        // a file or a folder, by the format; its parent folder must exist
  size_t first_row = 0, last_row = 0;  // frames of the run, both included
  std::string projection =
      {};  // for kml and osi: PROJ string of the scene's coordinates; empty: that of its georeference.json
  // Reports progress: called before each frame with the number of frames done and the number of all. It may be empty.
  std::function<void(uint64_t done, uint64_t total)> at = {};
  // row: row of the next frame
  void tell(size_t row) const {
    if (at) at(row - first_row, last_row - first_row + 1);
  }
};

// Has the format coordinates on the earth, for which --projection may be needed?
inline bool is_on_earth(std::string_view format) { return format == "kml" || format == "osi"; }

struct Exporter {
  const char* name;    // name that --to takes
  const char* suffix;  // suffix of the output, such as ".npz"; empty if it is a folder
  const char* doc;     // one line: what the format is, and who reads it
  // Returns the files that it wrote, the main one first. Adds warnings to `warnings`. Throws InputError, RuntimeError.
  std::vector<std::filesystem::path> (*write)(const SavedRun&, const ExportOptions&,
                                              std::vector<std::string>& warnings);
};

using Written = std::vector<std::filesystem::path>;
using Warnings = std::vector<std::string>;
Written export_sionna(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_deepmimo(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_ns3(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_matlab(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_vtk(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_glb(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_osi(const SavedRun& run, const ExportOptions& options, Warnings& warnings);
Written export_kml(const SavedRun& run, const ExportOptions& options, Warnings& warnings);

// The list that --to offers. A new format is its file, its declaration above and a row here.
// clang-format off
inline constexpr auto exporter_list = std::to_array<Exporter>({
    {"sionna", ".npz", "NumPy arrays in the layout of Sionna RT's Paths", export_sionna},
    {"deepmimo", "", "a scenario folder as DeepMIMO loads it", export_deepmimo},
    {"ns3", "", "a scenario folder of ns-3's QdChannelModel", export_ns3},
    {"matlab", ".mat", "MATLAB 7.3 (HDF5), one struct of arrays", export_matlab},
    {"vtk", "", "a folder for ParaView: scene.vtp, paths and ends a frame, and a .pvd with their times", export_vtk},
    {"glb", ".glb", "glTF 2.0 binary: scene, vehicles and paths of one frame", export_glb},
    {"kml", ".kml", "Google Earth: ends, vehicles and paths, with times", export_kml},
    {"osi", ".osi", "ASAM OSI 3: the traffic as a binary trace of GroundTruth messages", export_osi},
});
// clang-format on
constexpr std::span<const Exporter> exporters() { return exporter_list; }

inline std::vector<std::string> exporter_names() {
  std::vector<std::string> names;
  for (const Exporter& exporter : exporters()) names.push_back(exporter.name);
  return names;
}

}  // namespace wavetracer
