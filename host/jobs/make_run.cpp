// SPDX-License-Identifier: Apache-2.0
// Gathers the description of a simulation for the outputs.
// It is in this folder because the output folder does not know simulations.
#include <fmt/format.h>
#include <algorithm>
#include "base/hash.hpp"
#include "config/input_files.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

void add_input(std::vector<InputFile>& inputs, const std::string& name, const std::string& file) {
  if (std::ranges::find(inputs, file, &InputFile::file) != inputs.end()) return;
  const auto hash = hash_of_file(file);
  if (!hash) throw InputError(fmt::format("{} ({}): can no longer be read; put it back and run again", file, name));
  inputs.push_back({name, file, hash->bytes, hash->hash});
}

// Adds the files of a scene except the first, which is named by its key.
void add_named_by(std::vector<InputFile>& inputs, const std::string& key, const Scene& scene) {
  const fs::path folder = fs::path(scene.file).parent_path();
  for (const std::string& file : scene.files)
    add_input(inputs, key + ": " + fs::path(file).lexically_relative(folder).string(), file);
}

std::vector<InputFile> inputs_of(const Simulation& simulation) {
  std::vector<InputFile> inputs;
  Config config = simulation.config();
  for (const config::NamedFile& file : config::input_files(config)) add_input(inputs, file.key, *file.path);
  add_named_by(inputs, "scene.file", simulation.scene());
  for (const Scene& model : simulation.models()) add_named_by(inputs, "vehicle_type.model", model);
  return inputs;
}

}  // namespace

Run make_run(const Simulation& simulation, uint64_t frames_asked, const std::string& command_line) {
  RunSummary summary;
  summary.device = simulation.device();
  summary.order = simulation.order();
  summary.edge_rays = simulation.edge_rays();
  summary.diffraction_range_db = simulation.diffraction_range_db();
  summary.features = simulation.features();
  summary.setup_seconds = simulation.setup_seconds();
  summary.command_line = command_line;
  summary.inputs = inputs_of(simulation);
  summary.frames_asked = frames_asked;
  summary.warnings = simulation.warnings();
  return {simulation.config(), simulation.scene(),   simulation.instances(), simulation.models(),
          std::move(summary),  simulation.targets(), simulation.radar_axes()};
}

}  // namespace wavetracer
