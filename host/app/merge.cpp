// `wavetracer merge`.
// Stub.
#include "app/commands.hpp"

namespace wavetracer::app {

void add_merge(CLI::App&, Invocation&) {}

}  // namespace wavetracer::app
