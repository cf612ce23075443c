// `wavetracer documentation`.
// Stub.
#include "app/commands.hpp"

namespace wavetracer::app {

void add_documentation(CLI::App&) {}

}  // namespace wavetracer::app
