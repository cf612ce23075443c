// The signal handler sets a flag and nothing else.
// SA_RESETHAND restores the default action, so that a second signal ends the process.
#include "app/interrupt.hpp"
#include <csignal>

namespace wavetracer::app {
namespace {

volatile std::sig_atomic_t raised = 0;

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = [](int) { raised = 1; };
  action.sa_flags = SA_RESTART | SA_RESETHAND;  // a write to a file goes on
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return raised != 0; }

}  // namespace wavetracer::app
