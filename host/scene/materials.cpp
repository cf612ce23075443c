// SPDX-License-Identifier: Apache-2.0
// Resolves material names: alias, then configuration, then file, then the ITU table.
// Names of [[material]] must be unique; a second one of the same name is an error.
#include "scene/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scene/material_laws.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view unused = ": no mesh has this material";

std::string_view without_prefix(std::string_view text, std::string_view prefix) {
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  return text;
}

// Returns the name as written, without "mat-", and without "mat-" and "itu_".
std::array<std::string, 3> spellings(std::string_view name) {
  const std::string_view bare = without_prefix(name, "mat-");
  return {std::string(name), std::string(bare), std::string(without_prefix(bare, "itu_"))};
}

// Returns the kind of woodland of a name that needs no [[material]].
Woodland woodland_named(std::string_view name) {
  if (name == "vegetation") return "mixed";
  if (name == "deciduous_vegetation") return "deciduous";
  return "none";
}

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
      check(m);
    }
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
    if (definition && (definition->itu_type || definition->permittivity)) return defined(*definition);
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
  static void check(const MaterialConfig& m) {
    const auto fail = [&m](const char* what) { throw ConfigError(fmt::format("[[material]] '{}': {}", m.name, what)); };
    const bool law = m.a || m.b || m.c || m.d, fixed = m.permittivity || m.conductivity_s_m;
    if (law && fixed) fail("give either a, b, c, d or permittivity and conductivity_s_m, not both");
    for (const auto& value : {m.a, m.b, m.c, m.d, m.permittivity, m.conductivity_s_m}) {
      if (value && !std::isfinite(*value)) fail("its coefficients must be finite");
    }
    if ((m.permittivity && *m.permittivity < 1) || (m.a && *m.a <= 0))
      fail("permittivity must be 1 or more, a positive");
    if ((m.conductivity_s_m && *m.conductivity_s_m < 0) || (m.c && *m.c < 0)) fail("conductivity_s_m or c is negative");
    if (m.scattering_lobe && *m.scattering_lobe != std::floor(*m.scattering_lobe))
      fail("scattering_lobe must be an integer");
    if (m.thickness_m && !(*m.thickness_m > 0)) fail("thickness_m must be positive (inf: a half space)");
    const bool surface = law || fixed || m.thickness_m || m.scattering_lobe || !m.library.empty();
    if (is_vegetation(m.vegetation) && surface)
      fail(
          "vegetation is no surface, and has no permittivity, thickness, scattering_lobe or library: "
          "remove those keys");
    const bool leaves = m.attenuation_db_m || m.max_attenuation_db || !m.in_leaf;
    if (leaves && (surface || (!is_vegetation(m.vegetation) && !is_vegetation(woodland_named(spellings(m.name)[2])))))
      fail("attenuation_db_m, max_attenuation_db and in_leaf need vegetation = \"mixed\" or \"deciduous\"");
  }

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

  static bool gives_law(const MaterialConfig& m) {
    return m.a || m.b || m.c || m.d || m.permittivity || m.conductivity_s_m;
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
    Woodland woodland = over ? over->vegetation : "none";
    if (!is_vegetation(woodland) && over && (gives_law(*over) || !over->library.empty())) return std::nullopt;
    if (!is_vegetation(woodland)) woodland = woodland_named(spellings(name)[2]);
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

  // Returns what the configuration and the table know about a name.
  std::optional<Material> known(std::string_view name) {
    const MaterialConfig* over = override_of(name);
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
      if (definition.thickness_m && !(over && over->thickness_m)) material.thickness_m = *definition.thickness_m;
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
