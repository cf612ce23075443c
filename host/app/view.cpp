// `wavetracer view`.
// Stub.
#include "app/commands.hpp"

namespace wavetracer::app {

void add_view(CLI::App&) {}

}  // namespace wavetracer::app
