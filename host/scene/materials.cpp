// Resolution of material names: alias, then configuration, then file, then the ITU table.
// Assumes that [[material]] names are unique; a second one of the same name is an error.
#include "scene/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::string_view strip(std::string_view text, std::string_view prefix) {
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  return text;
}

// The name as written, without "mat-", without "mat-" and "itu_".
std::array<std::string, 3> spellings(std::string_view name) {
  const std::string_view bare = strip(name, "mat-");
  return {std::string(name), std::string(bare), std::string(strip(bare, "itu_"))};
}

std::string itu_names() {
  std::string out;
  std::string_view last;
  for (const Material& m : itu_materials()) {
    if (m.name == last) continue;
    if (!out.empty()) out += ", ";
    out += m.name;
    last = m.name;
  }
  return out;
}

class Resolver {
 public:
  Resolver(const SceneConfig& scene, const std::vector<MaterialConfig>& overrides, double frequency_hz)
      : scene_(scene), overrides_(overrides), frequency_ghz_(frequency_hz * 1e-9) {
    std::set<std::string> names;
    for (const MaterialConfig& m : overrides) {
      if (m.name.empty()) throw ConfigError("[[material]]: name is missing");
      if (!names.insert(m.name).second) {
        throw ConfigError(fmt::format("[[material]] '{}' is defined twice: keep one", m.name));
      }
      check(m);
    }
  }

  // definition: the file's own one, or null where the file only gives a name.
  Material resolve(std::string_view name, const RawMaterial* definition, const std::string& used_by) {
    for (const std::string& spelling : spellings(name)) {
      const auto alias = scene_.material_alias.find(spelling);
      if (alias == scene_.material_alias.end()) continue;
      used_.insert("alias " + spelling);
      if (const auto material = known(alias->second)) return *material;
      throw ConfigError(
          fmt::format("[scene.material_alias]: '{}' is mapped to '{}', which is not a known material; known materials: "
                      "{}; define others with [[material]]",
                      spelling, alias->second, itu_names()));
    }
    if (definition && (definition->itu_type || definition->permittivity)) return defined(*definition);
    if (const auto material = known(name)) return *material;
    throw InputError(
        fmt::format("{}: the material '{}' is not known; known ITU materials: {}. Map it in the configuration:\n"
                    "  [scene.material_alias]\n  \"{}\" = \"concrete\"\nor define it:\n"
                    "  [[material]]\n  name = \"{}\"\n  permittivity = 5.24\n  conductivity_s_m = 0.19",
                    used_by, name, itu_names(), name, name));
  }

  std::vector<std::string> unused() const {
    std::vector<std::string> out;
    for (const auto& [from, to] : scene_.material_alias) {
      if (!used_.contains("alias " + from)) {
        out.push_back(fmt::format("[scene.material_alias] '{}' = '{}': no mesh has this material", from, to));
      }
    }
    for (const MaterialConfig& m : overrides_) {
      if (!used_.contains("material " + m.name)) {
        out.push_back(fmt::format("[[material]] '{}': no mesh has this material", m.name));
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
  }

  // The configuration's fields over base. Coefficients that the user gave are not bound to the table's range.
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
    if (over.a || over.b || over.c || over.d || over.permittivity || over.conductivity_s_m) {
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

  // The table's entry of this exact name; the range that holds the frequency, else the first one.
  std::optional<Material> itu(const std::string& name) const {
    std::optional<Material> found;
    for (const Material& m : itu_materials()) {
      if (m.name != name) continue;
      if (frequency_ghz_ >= m.min_ghz && frequency_ghz_ <= m.max_ghz) return m;
      if (!found) found = m;
    }
    return found;
  }

  // What configuration and table say of a name.
  std::optional<Material> known(std::string_view name) {
    std::optional<Material> material = itu(spellings(name)[2]);
    if (const MaterialConfig* over = override_of(name)) {
      if (!material) {
        if (!over->a && !over->permittivity) {
          throw ConfigError(fmt::format(
              "[[material]] '{}' is not an ITU material, so it needs permittivity (or a, b, c, d)", over->name));
        }
        material = Material{.name = spellings(over->name)[2]};
      }
      apply(*over, *material);
    }
    return material;
  }

  // A material that the file defines in full. Its name is the file's; its ITU type may be overridden as well.
  Material defined(const RawMaterial& definition) {
    Material material;
    if (definition.itu_type) {
      const auto base = known(*definition.itu_type);
      if (!base) {
        throw InputError(fmt::format("{}: material '{}' has the ITU type '{}', which is not known; known: {}",
                                     definition.where, definition.name, *definition.itu_type, itu_names()));
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
  std::set<std::string> used_;
};

}  // namespace

const std::vector<Material>& itu_materials() {
  static const std::vector<Material> table = {
      // name, a, b, c, d, GHz from, GHz to
      {"vacuum", 1, 0, 0, 0, 0.001, 100},
      {"concrete", 5.24, 0, 0.0462, 0.7822, 1, 100},
      {"brick", 3.91, 0, 0.0238, 0.16, 1, 40},
      {"plasterboard", 2.73, 0, 0.0085, 0.9395, 1, 100},
      {"wood", 1.99, 0, 0.0047, 1.0718, 0.001, 100},
      {"glass", 6.31, 0, 0.0036, 1.3394, 0.1, 100},
      {"glass", 5.79, 0, 0.0004, 1.658, 220, 450},
      {"ceiling_board", 1.48, 0, 0.0011, 1.0750, 1, 100},
      {"chipboard", 2.58, 0, 0.0217, 0.78, 1, 100},
      {"plywood", 2.71, 0, 0.33, 0, 1, 40},
      {"marble", 7.074, 0, 0.0055, 0.9262, 1, 60},
      {"floorboard", 3.66, 0, 0.0044, 1.3515, 50, 100},
      {"metal", 1, 0, 1e7, 0, 1, 100},
      {"very_dry_ground", 3, 0, 0.00015, 2.52, 1, 10},
      {"medium_dry_ground", 15, -0.1, 0.035, 1.63, 1, 10},
      {"wet_ground", 30, -0.4, 0.15, 1.30, 1, 10},
      {"asphalt_concrete", 4.83, 0, 0.0108, 1.3969, 1, 40},
  };
  return table;
}

ResolvedMaterials resolve_materials(const RawScene& raw, const SceneConfig& scene,
                                    const std::vector<MaterialConfig>& overrides, double frequency_hz) {
  Resolver resolver(scene, overrides, frequency_hz);
  ResolvedMaterials out;
  std::vector<uint32_t> index_of(raw.materials.size() + 1, no_material);  // the last entry: meshes without a material
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
      const auto same = std::find(out.materials.begin(), out.materials.end(), material);
      index = static_cast<uint32_t>(same - out.materials.begin());
      if (same == out.materials.end()) out.materials.push_back(material);
    }
    out.mesh_material.push_back(index);
  }
  out.warnings = resolver.unused();
  return out;
}

}  // namespace wavetracer
