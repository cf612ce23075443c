// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_kml(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("kml: not built yet"); }

}  // namespace wavetracer
