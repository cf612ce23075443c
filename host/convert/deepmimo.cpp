// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_deepmimo(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("deepmimo: not built yet"); }

}  // namespace wavetracer
