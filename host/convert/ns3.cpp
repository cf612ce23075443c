// Stub.
#include "convert/convert.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Written export_ns3(const SavedRun&, const ExportOptions&, Warnings&) { throw RuntimeError("ns3: not built yet"); }

}  // namespace wavetracer
