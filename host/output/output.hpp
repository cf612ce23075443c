// Outputs of a run: wavetracer/output.hpp, under the name that this folder's other headers go by.
// make_run() is defined in host/library, which knows the simulation.
#pragma once
#include "wavetracer/output.hpp"
