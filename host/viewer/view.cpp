// Stub.
#include "viewer/view.hpp"
