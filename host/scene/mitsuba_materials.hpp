// SPDX-License-Identifier: Apache-2.0
// Reads the <bsdf> elements of a Mitsuba scene as radio materials, by id. Radio bsdfs are those of Sionna RT 1.x
// (itu-radio-material, radio-material); for any other bsdf only the outermost id counts.
#pragma once
#include <map>
#include <set>
#include <string>

#include "scene/mitsuba_files.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer {

class MitsubaMaterials {
 public:
  // Adds materials and warnings to raw. Materials at the top of the file are added at once, since references may point
  // forward.
  MitsubaMaterials(const MitsubaFiles& files, RawScene& raw);

  // Returns the material of a shape, from its <bsdf> or from a reference to one, or no_material if it has neither.
  // name: the shape's name, for a material without an id.
  uint32_t of_shape(pugi::xml_node shape, const std::string& name);

 private:
  uint32_t add(pugi::xml_node node, const std::string& fallback);
  void add_alias(pugi::xml_node node);
  void read_radio(pugi::xml_node node, RawMaterial& material);
  void warn_of_scattering(pugi::xml_node node);
  void warn_of_bsdf(pugi::xml_node node);

  const MitsubaFiles& files_;
  RawScene& raw_;
  std::map<std::string, uint32_t> index_;  // id -> index into raw_.materials
  std::set<std::string> others_;           // ids of other elements, such as a medium
};

}  // namespace wavetracer
