// SPDX-License-Identifier: Apache-2.0
// Holds the list of formats.
#include "convert/convert.hpp"
#include <array>

namespace wavetracer {

std::span<const Exporter> exporters() {
  static constexpr std::array<Exporter, 8> list{{
      {"sionna", ".npz", "NumPy arrays in the layout of Sionna RT's Paths", export_sionna},
      {"deepmimo", "", "a scenario folder as DeepMIMO loads it", export_deepmimo},
      {"ns3", "", "a scenario folder of ns-3's QdChannelModel", export_ns3},
      {"matlab", ".mat", "MATLAB 7.3 (HDF5), one struct of arrays", export_matlab},
      {"vtk", "", "a folder for ParaView: scene.vtp, paths and ends a frame, and a .pvd with their times", export_vtk},
      {"glb", ".glb", "glTF 2.0 binary: scene, vehicles and paths of one frame", export_glb},
      {"kml", ".kml", "Google Earth: ends, vehicles and paths, with times", export_kml},
      {"osi", ".osi", "ASAM OSI 3: the traffic as a binary trace of GroundTruth messages", export_osi},
  }};
  return list;
}

std::vector<std::string> exporter_names() {
  std::vector<std::string> names;
  for (const Exporter& exporter : exporters()) names.push_back(exporter.name);
  return names;
}

}  // namespace wavetracer
