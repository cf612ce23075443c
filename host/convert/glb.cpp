// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_glb(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("glb: not built yet"); }

}  // namespace wavetracer
