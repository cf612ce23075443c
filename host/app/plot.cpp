// `wavetracer plot`.
// Stub.
#include "app/commands.hpp"

namespace wavetracer::app {

void add_plot(CLI::App&) {}

}  // namespace wavetracer::app
