// `wavetracer convert`.
// Stub.
#include "app/commands.hpp"

namespace wavetracer::app {

void add_convert(CLI::App&) {}

}  // namespace wavetracer::app
