// Runs in the formats of other programs: one function per format, and the list that `wavetracer convert --to` offers.
// Each writes what its readers expect, whole or not at all, and says in its own file which conventions that means.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

struct ExportOptions {
  std::filesystem::path output;        // a file or a folder, by the format; its parent folder must exist
  size_t first_row = 0, last_row = 0;  // frames of the run, both included
  std::string projection =
      {};  // kml, osi: PROJ string of the scene's coordinates; empty: that of its georeference.json
  // How far it is: asked before each frame, with the number of those that are done, of all. May be left out.
  std::function<void(uint64_t done, uint64_t total)> at = {};
  // row: of the frame that is next.
  void tell(size_t row) const {
    if (at) at(row - first_row, last_row - first_row + 1);
  }
};

struct Exporter {
  const char* name;    // of --to
  const char* suffix;  // of the output, such as ".npz"; empty where it is a folder
  const char* doc;     // one line: what it is, who reads it
  // Returns the files that it wrote, the main one first. Warnings go to `warnings`. Throws InputError, RuntimeError.
  std::vector<std::filesystem::path> (*write)(const SavedRun&, const ExportOptions&,
                                              std::vector<std::string>& warnings);
};

std::span<const Exporter> exporters();
std::vector<std::string> exporter_names();

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

}  // namespace wavetracer
