// What a simulation says of itself, gathered for the outputs.
// In this folder because the output folder knows no simulation.
#include "wavetracer/output.hpp"

namespace wavetracer {

Run make_run(const Simulation& simulation, uint64_t frames_asked, const std::string& command_line) {
  RunSummary summary;
  summary.device = simulation.device();
  summary.order = simulation.order();
  summary.features = simulation.features();
  summary.setup_seconds = simulation.setup_seconds();
  summary.command_line = command_line;
  summary.frames_asked = frames_asked;
  summary.warnings = simulation.warnings();
  return {simulation.config(), simulation.scene(), simulation.instances(), simulation.models(), std::move(summary)};
}

}  // namespace wavetracer
