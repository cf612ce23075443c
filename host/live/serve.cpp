// Stub.
#include "live/serve.hpp"
