// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_sionna(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("sionna: not built yet"); }

}  // namespace wavetracer
