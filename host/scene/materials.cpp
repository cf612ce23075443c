// SPDX-License-Identifier: Apache-2.0
// Resolves material names: alias, then configuration, then file, then the ITU table.
// Names of [[material]] must be unique; a second one of the same name is an error.
#include "scene/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scene/material_checks.hpp"
#include "scene/material_laws.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view unused = ": no mesh has this material";

class Resolver {
 public:
  Resolver(const SceneConfig& scene, const std::vector<MaterialConfig>& overrides, double frequency_hz)
      : scene_(scene), overrides_(overrides), frequency_ghz_(frequency_hz / 1e9) {
    std::set<std::string> names;
    for (const MaterialConfig& m : overrides) {
      if (m.name.empty()) throw ConfigError("[[material]]: name is missing");
      if (!names.insert(m.name).second) {
        throw ConfigError(fmt::format("[[material]] '{}' is defined twice: keep one", m.name));
      }
      check_material(m);
    }
    for (const MaterialConfig& m : overrides) check_layers_of(m);
  }

  // definition: the file's own definition, or null if the file only gives a name.
  Material resolve(std::string_view name, const RawMaterial* definition, const std::string& used_by) {
    for (const std::string& spelling : spellings(name)) {
      const auto alias = scene_.material_alias.find(spelling);
      if (alias == scene_.material_alias.end()) continue;
      used_.insert("alias " + spelling);
      if (const auto material = known(alias->second)) return *material;
      throw ConfigError(
          fmt::format("[scene.material_alias]: '{}' is mapped to '{}', which is not a known material; known materials: "
                      "{}; define others with [[material]]",
                      spelling, alias->second, itu_names(scene_.itu_edition)));
    }
    const MaterialConfig* const over = override_of(name);
    const bool is_defined = definition && (definition->itu_type || definition->permittivity);
    if (is_defined && !(over && !over->layers.empty())) return defined(*definition);
    if (const auto material = known(name)) return *material;
    throw InputError(fmt::format(
        "{}: the material '{}' is not known{}; known ITU materials: {}; of vehicles: {}. Map it in the configuration:\n"
        "  [scene.material_alias]\n  \"{}\" = \"concrete\"\nor define it:\n"
        "  [[material]]\n  name = \"{}\"\n  permittivity = 5.24\n  conductivity_s_m = 0.19",
        used_by, name, newer_edition(spellings(name)[2]), itu_names(scene_.itu_edition), vehicle_material_names(), name,
        name));
  }

  // Returns the library's messages, then those about entries that no mesh uses.
  std::vector<std::string> warnings() const {
    std::vector<std::string> out(notes_.begin(), notes_.end());
    for (const auto& [from, to] : scene_.material_alias) {
      if (!used_.contains("alias " + from)) {
        out.push_back(fmt::format("[scene.material_alias] '{}' = '{}'{}", from, to, unused));
      }
    }
    for (const MaterialConfig& m : overrides_) {
      if (!used_.contains("material " + m.name)) {
        out.push_back(fmt::format("[[material]] '{}'{}", m.name, unused));
      }
    }
    return out;
  }

 private:
  // Returns "", or a note that the newest edition knows the name.
  std::string newer_edition(const std::string& name) const {
    constexpr ItuEdition newest = "P.2040-4";
    if (scene_.itu_edition == newest || ranges_in_words(newest, name).empty()) return "";
    return fmt::format(" to ITU-R {} (scene.itu_edition), but to {}", scene_.itu_edition.word(), newest.word());
  }

  std::string not_in_library(const std::string& name, const std::string& who) const {
    return fmt::format("{}: library = '{}' is not a material{}; known: {}", who, name,
                       newer_edition(spellings(name)[2]), itu_names(scene_.itu_edition));
  }

  // Writes the configuration's fields over base. Coefficients that the user gave are not bound to the table's range.
  void apply(const MaterialConfig& over, Material& base) {
    used_.insert("material " + over.name);
    if (over.permittivity) base.a = *over.permittivity, base.b = 0;
    if (over.conductivity_s_m) base.c = *over.conductivity_s_m, base.d = 0;
    base.a = over.a.value_or(base.a);
    base.b = over.b.value_or(base.b);
    base.c = over.c.value_or(base.c);
    base.d = over.d.value_or(base.d);
    base.thickness_m = over.thickness_m.value_or(base.thickness_m);
    base.scattering = over.scattering.value_or(base.scattering);
    base.scattering_lobe = over.scattering_lobe.value_or(base.scattering_lobe);
    base.scattering_cross_polar = over.scattering_cross_polar.value_or(base.scattering_cross_polar);
    if (gives_law(over)) {
      base.min_ghz = 0;
      base.max_ghz = std::numeric_limits<double>::infinity();
    }
  }

  const MaterialConfig* override_of(std::string_view name) const {
    for (const std::string& spelling : spellings(name)) {
      for (const MaterialConfig& m : overrides_) {
        if (m.name == spelling || spellings(m.name)[2] == spelling) return &m;
      }
    }
    return nullptr;
  }

  // Returns the libraries' law for this exact name at the carrier, or the nearest law outside the ranges, without its
  // range limit if the configuration asks for that. law_is_given: the configuration replaces it: there is no warning.
  std::optional<Material> itu(const std::string& name, bool law_is_given) {
    std::optional<ItuLaw> law = find_itu_law(scene_.itu_edition, name, frequency_ghz_);
    if (!law) law = find_vehicle_law(name, frequency_ghz_);
    if (!law || law_is_given) return law ? std::optional(law->material) : std::nullopt;
    if (!law->choice.empty()) notes_.insert(law->choice);
    if (!law->in_range && scene_.extrapolate_materials && !range_is_a_limit(name)) {
      notes_.insert(
          fmt::format("the material \"{}\" was measured from {}, and is used at {:g} GHz all "
                      "the same (scene.extrapolate_materials)",
                      name, range_in_words(law->material), frequency_ghz_));
      law->material.min_ghz = 0;
      law->material.max_ghz = std::numeric_limits<double>::infinity();
    }
    return law->material;
  }

  // Returns leaves and twigs if the name stands for them.
  std::optional<Material> leaves(std::string_view name, const MaterialConfig* over) {
    const Woodland woodland = woodland_of(name, over);
    if (!is_vegetation(woodland)) return std::nullopt;
    if (over) used_.insert("material " + over->name);
    Material out{.name = spellings(over ? over->name : name)[2]};
    out.vegetation = VegetationLaw{.deciduous = woodland == "deciduous"};
    if (!over) return out;
    out.vegetation->in_leaf = over->in_leaf;
    out.vegetation->attenuation_db_m = over->attenuation_db_m;
    out.vegetation->max_attenuation_db = over->max_attenuation_db;
    out.scattering = over->scattering.value_or(0);
    out.scattering_cross_polar = over->scattering_cross_polar.value_or(0);
    return out;
  }

  // Throws if a layer has a name that nothing has, or that is no plain material.
  void check_layers_of(const MaterialConfig& wall) const {
    const auto fail = [&](const LayerConfig& layer, const std::string& what) {
      throw ConfigError(fmt::format("[[material]] '{}': its layer '{}' {}", wall.name, layer.material, what));
    };
    for (const LayerConfig& layer : wall.layers) {
      const MaterialConfig* const over = override_of(layer.material);
      if (over && !over->layers.empty()) fail(layer, "has layers itself: list those layers here");
      if (is_vegetation(woodland_of(layer.material, over))) fail(layer, "is vegetation, which is no layer of a wall");
      const std::string name = spellings(layer.material)[2];
      if (over || find_itu_law(scene_.itu_edition, name, frequency_ghz_) || find_vehicle_law(name, frequency_ghz_))
        continue;
      fail(layer, fmt::format("is not a known material{}; known: {}, {}; define others with [[material]]",
                              newer_edition(name), itu_names(scene_.itu_edition), vehicle_material_names()));
    }
  }

  // Makes a wall of its layers; that of one layer is a slab. check_layers_of() has checked their names.
  Material wall_of(const MaterialConfig& over) {
    used_.insert("material " + over.name);
    std::vector<Material> layers;
    double thickness_m = 0;
    for (const LayerConfig& layer : over.layers) {
      layers.push_back(known(layer.material).value());
      layers.back().thickness_m = layer.thickness_m;
      thickness_m += layer.thickness_m;
    }
    Material out = layers.front();
    out.name = spellings(over.name)[2];
    out.thickness_m = thickness_m;
    out.scattering = over.scattering.value_or(0);
    out.scattering_lobe = over.scattering_lobe.value_or(0);
    out.scattering_cross_polar = over.scattering_cross_polar.value_or(0);
    if (layers.size() > 1) out.layers = std::move(layers);
    return out;
  }

  // Returns what the configuration and the table know about a name.
  std::optional<Material> known(std::string_view name) {
    const MaterialConfig* over = override_of(name);
    if (over && !over->layers.empty()) return wall_of(*over);
    if (const auto vegetation = leaves(name, over)) return vegetation;
    const bool made_of = over && !over->library.empty();
    std::optional<Material> material = itu(spellings(made_of ? over->library : name)[2], over && gives_law(*over));
    if (over) {
      if (made_of && !material) throw ConfigError(not_in_library(over->library, "[[material]] '" + over->name + "'"));
      if (made_of) material->name = spellings(over->name)[2];
      if (!material) {
        if (!over->a && !over->permittivity) {
          throw ConfigError(
              fmt::format("[[material]] '{}' is not an ITU material, so it needs permittivity (or a, b, c, d), "
                          "or the library material that it is made of",
                          over->name));
        }
        material = Material{.name = spellings(over->name)[2]};
      }
      apply(*over, *material);
    }
    return material;
  }

  // Makes a material that the file defines in full. Its name is the file's; its ITU type may be overridden as well.
  Material defined(const RawMaterial& definition) {
    Material material;
    if (definition.itu_type) {
      const auto base = known(*definition.itu_type);
      if (!base) {
        throw InputError(fmt::format("{}: material '{}' has the ITU type '{}', which is not known; known: {}",
                                     definition.where, definition.name, *definition.itu_type,
                                     itu_names(scene_.itu_edition)));
      }
      material = *base;
      const MaterialConfig* over = override_of(*definition.itu_type);
      if (definition.thickness_m && !(over && over->thickness_m) && material.layers.empty())
        material.thickness_m = *definition.thickness_m;
    } else {
      material.a = *definition.permittivity;
      material.c = definition.conductivity_s_m.value_or(0);
      material.thickness_m = definition.thickness_m.value_or(material.thickness_m);
    }
    if (const MaterialConfig* over = override_of(definition.name)) apply(*over, material);
    material.name = spellings(definition.name)[2];
    return material;
  }

  const SceneConfig& scene_;
  const std::vector<MaterialConfig>& overrides_;
  double frequency_ghz_;
  std::set<std::string> used_, notes_;
};

// Returns the index of a material in a list; a new one is added.
uint32_t index_in(std::vector<Material>& materials, const Material& material) {
  const auto same = std::find(materials.begin(), materials.end(), material);
  const auto index = static_cast<uint32_t>(same - materials.begin());
  if (same == materials.end()) materials.push_back(material);
  return index;
}

}  // namespace

bool says_unused(std::string_view warning) { return warning.ends_with(unused); }

void drop_used(std::vector<std::string>& warnings, const std::vector<Scene>& models) {
  std::erase_if(warnings, [&](const std::string& warning) {
    return says_unused(warning) && std::ranges::any_of(models, [&](const Scene& model) {
             return std::ranges::find(model.report.warnings, warning) == model.report.warnings.end();
           });
  });
}

ResolvedMaterials resolve_materials(const RawScene& raw, const SceneConfig& scene,
                                    const std::vector<MaterialConfig>& overrides, double frequency_hz) {
  Resolver resolver(scene, overrides, frequency_hz);
  ResolvedMaterials out;
  std::vector<uint32_t> index_of(raw.materials.size() + 1, no_material);  // the last: meshes without a material
  for (const RawMesh& mesh : raw.meshes) {
    uint32_t& index = index_of[std::min<size_t>(mesh.material, raw.materials.size())];
    if (index == no_material) {
      const RawMaterial* definition = mesh.material == no_material ? nullptr : &raw.materials[mesh.material];
      if (!definition && scene.default_material.empty()) {
        throw InputError(
            fmt::format("{}: mesh '{}' has no material; set scene.default_material, for example to \"concrete\"",
                        mesh.where, mesh.name));
      }
      const Material material =
          resolver.resolve(definition ? definition->name : scene.default_material, definition,
                           definition ? fmt::format("{}: mesh '{}'", mesh.where, mesh.name) : "scene.default_material");
      index = index_in(out.materials, material);
    }
    out.mesh_material.push_back(index);
  }
  for (const RawVolume& volume : raw.volumes) {
    const Material material = resolver.resolve(volume.material, nullptr, "[[vegetation]]");
    if (!material.vegetation)
      throw ConfigError(
          fmt::format("[[vegetation]]: the material '{}' is not vegetation: give \"vegetation\", "
                      "\"deciduous_vegetation\", or a [[material]] with the key vegetation",
                      volume.material));
    out.volume_material.push_back(index_in(out.materials, material));
  }
  out.warnings = resolver.warnings();
  return out;
}

}  // namespace wavetracer
