// SPDX-License-Identifier: Apache-2.0
// A bsdf may hold others, as twosided does: going down, the first radio bsdf is the material.
#include "scene/mitsuba_materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/mitsuba_properties.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

bool is_radio(pugi::xml_node node) {
  const std::string_view type = node.attribute("type").value();
  return type == "itu-radio-material" || type == "radio-material";
}

// Tells whether the type is a bsdf for light, of Mitsuba 0.6 to 3.
bool is_for_light(std::string_view type) {
  static const std::set<std::string_view> known = {
      "blendbsdf",       "bump",         "bumpmap",      "circular",
      "coating",         "conductor",    "dielectric",   "difftrans",
      "diffuse",         "hair",         "hk",           "holder-material",
      "irawan",          "mask",         "measured",     "measured_polarized",
      "mixturebsdf",     "normalmap",    "null",         "phong",
      "plastic",         "polarizer",    "pplastic",     "principled",
      "principledthin",  "retarder",     "roughcoating", "roughconductor",
      "roughdielectric", "roughdiffuse", "roughplastic", "thindielectric",
      "twosided",        "ward"};
  return known.contains(type);
}

const std::vector<std::string>& radio_properties(bool itu) {
  static const std::vector<std::string> common = {
      "thickness", "scattering_coefficient", "xpd_coefficient", "scattering_pattern", "alpha_r", "alpha_i", "lambda_",
      "color"};
  static const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return more;
  };
  static const std::vector<std::string> of_itu = with({"type"}), own = with({"relative_permittivity", "conductivity"});
  return itu ? of_itu : own;
}

}  // namespace

MitsubaMaterials::MitsubaMaterials(const MitsubaFiles& files, RawScene& raw) : files_(files), raw_(raw) {
  for (const pugi::xml_node node : files.elements()) {
    const std::string_view tag = node.name();
    const std::string id = files.attribute(node, "id");
    if (tag == "alias") continue;
    if (tag != "bsdf") {
      if (!id.empty()) others_.insert(id);
      continue;
    }
    const uint32_t index = add(node, "");
    if (!index_.try_emplace(raw_.materials[index].name, index).second && !id.empty())
      files.fail(node, ": another <bsdf> of this file has this id; keep one");
  }
  for (const pugi::xml_node node : files.elements())
    if (std::string_view(node.name()) == "alias") add_alias(node);
}

void MitsubaMaterials::add_alias(pugi::xml_node node) {
  files_.check_attributes(node, {"id", "as"});
  const std::string id = files_.attribute(node, "id"), as = files_.attribute(node, "as");
  if (others_.contains(id)) {
    others_.insert(as);
    return;
  }
  const auto found = index_.find(id);
  if (found == index_.end()) files_.fail(node, " names nothing that this file defines");
  if (as.empty() || !index_.try_emplace(as, found->second).second)
    files_.fail(node, fmt::format(": as=\"{}\" must be an id that nothing else has", as));
}

void MitsubaMaterials::warn_of_bsdf(pugi::xml_node node) {
  const std::string type = files_.attribute(node, "type");
  if (!is_radio(node) && !is_for_light(type))
    raw_.warnings.push_back(fmt::format("{}: {}: this type of bsdf is not known; nothing of it is used but its id",
                                        files_.where(node), MitsubaFiles::describe(node)));
  if (pugi::xml_node inner = node.child("bsdf"); inner && inner.next_sibling("bsdf") && !is_radio(node))
    raw_.warnings.push_back(fmt::format("{}: {} holds several bsdfs; only the first is looked at for a radio material",
                                        files_.where(node), MitsubaFiles::describe(node)));
}

// Returns the index in raw_.materials. fallback: a name for a material without an id.
uint32_t MitsubaMaterials::add(pugi::xml_node node, const std::string& fallback) {
  pugi::xml_node core = node;
  while (!is_radio(core) && core.child("bsdf")) {
    warn_of_bsdf(core);
    core = core.child("bsdf");
  }
  warn_of_bsdf(core);
  RawMaterial material;
  material.name = files_.attribute(node, "id");
  material.where = files_.where(node);
  if (is_radio(core)) read_radio(core, material);
  if (material.name.empty()) material.name = material.itu_type.value_or(fallback);
  raw_.materials.push_back(std::move(material));
  return static_cast<uint32_t>(raw_.materials.size() - 1);
}

void MitsubaMaterials::warn_of_scattering(pugi::xml_node node) {
  if (mitsuba_number(files_, node, "scattering_coefficient", 0, false).value_or(0) > 0) {
    raw_.warnings.push_back(
        fmt::format("{}: {}: scattering_coefficient is not used, nor its pattern; "
                    "give [[material]] the keys scattering, scattering_lobe and scattering_cross_polar",
                    files_.where(node), MitsubaFiles::describe(node)));
  }
}

void MitsubaMaterials::read_radio(pugi::xml_node node, RawMaterial& material) {
  constexpr double thinnest_m = 1e-9;  // a slab of zero thickness would not exist
  const bool itu = std::string_view(node.attribute("type").value()) == "itu-radio-material";
  check_properties(files_, node, radio_properties(itu), {"texture"});
  material.thickness_m = mitsuba_number(files_, node, "thickness", thinnest_m, true);
  warn_of_scattering(node);
  if (itu) {
    material.itu_type = files_.attribute(mitsuba_property(files_, node, "type", {"string"}), "value");
    if (material.itu_type->empty()) files_.fail(node, " needs <string name=\"type\" value=\"concrete\"/>");
  } else {  // Sionna RT's defaults are those of vacuum
    material.permittivity = mitsuba_number(files_, node, "relative_permittivity", 1, false).value_or(1);
    material.conductivity_s_m = mitsuba_number(files_, node, "conductivity", 0, false).value_or(0);
  }
}

// Mitsuba ignores the name of a reference: the referenced element says what it is.
uint32_t MitsubaMaterials::of_shape(pugi::xml_node shape, const std::string& name) {
  uint32_t out = no_material;
  for (const pugi::xml_node child : shape.children()) {
    const std::string_view tag = child.name(), role = child.attribute("name").value();
    uint32_t found = no_material;
    if (tag == "bsdf") found = add(child, name);
    if (tag == "ref") {
      files_.check_attributes(child, {"id", "name"});
      const std::string id = files_.attribute(child, "id");
      const auto at = index_.find(id);
      if (at == index_.end() && others_.contains(id) && role != "bsdf") continue;
      if (at == index_.end())
        throw InputError(fmt::format("{}: {} refers to the material '{}', but no <bsdf> of this file defines it",
                                     files_.where(child), MitsubaFiles::describe(shape), id));
      found = at->second;
    }
    if (found == no_material) continue;
    if (out != no_material)
      files_.fail(child, fmt::format(" is a second material of {}; keep one", MitsubaFiles::describe(shape)));
    out = found;
  }
  return out;
}

}  // namespace wavetracer
