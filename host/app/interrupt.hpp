// Ctrl-C: the first one asks the run to stop after what it is doing, the second one stops it at once.
// One process has one such request; it is never taken back.
#pragma once

namespace wavetracer::app {

// From now on SIGINT and SIGTERM only raise the request.
void catch_interrupts();
bool interrupted();

}  // namespace wavetracer::app
