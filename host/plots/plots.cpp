// Stub.
#include "plots/plots.hpp"
