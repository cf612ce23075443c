// `wavetracer serve`.
// Stub.
#include "app/commands.hpp"

namespace wavetracer::app {

void add_serve(CLI::App&, Invocation&) {}

}  // namespace wavetracer::app
