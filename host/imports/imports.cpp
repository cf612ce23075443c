// Stub.
#include "imports/imports.hpp"
