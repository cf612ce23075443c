// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_matlab(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("matlab: not built yet"); }

}  // namespace wavetracer
