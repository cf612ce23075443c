// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_vtk(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("vtk: not built yet"); }

}  // namespace wavetracer
