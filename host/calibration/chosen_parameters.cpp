// SPDX-License-Identifier: Apache-2.0
// Names of materials may have dots, so only a known property ends the name.
#include "calibration/chosen_parameters.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include "base/spelling.hpp"
#include "motion/input_text.hpp"
#include "simulation/name_pattern.hpp"
#include "wavetracer/device/slab.h"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

// Returns why the property of a material cannot be fitted; empty if it can.
std::string obstacle(const device::wt_material& record, Property property, const NamedRecords& world) {
  if (std::hypot(record.permittivity[0], record.permittivity[1]) > WT_CONDUCTS)
    return "it is a good conductor, which reflects everything";
  const double value = value_of(record, property, world.frequency_hz);
  if (property == Property::permittivity) return value > 1 ? "" : "it is that of air";
  if (property == Property::thickness)
    return value > 0 && std::isfinite(value) ? "" : fmt::format("it is {:g} m in the configuration", value);
  if (property == Property::scattering && !world.scatters) return "trace.scattering is off";
  if (!(value > 0)) return "it is 0 in the configuration; give it a value to start from";
  return value < 1 || property == Property::conductivity ? "" : "it is 1 in the configuration";
}

struct Pattern {
  std::string text, owner;
  std::vector<Property> properties;
  bool all_properties = false;  // it names none
  bool of_ends() const { return is_of_end(properties.front()); }
};

// materials: their names, which may have dots.
Pattern parse_pattern(const std::string& text, const std::vector<std::string>& materials) {
  const size_t dot = text.rfind('.');
  if (dot == std::string::npos || std::ranges::find(materials, text) != materials.end())
    return {text, text, {Property::permittivity, Property::conductivity}, true};
  const std::string last = text.substr(dot + 1);
  if (const auto property = property_named(last)) return {text, text.substr(0, dot), {*property}};
  std::vector<std::string> known = property_names(false);
  const std::vector<std::string> of_ends = property_names(true);
  known.insert(known.end(), of_ends.begin(), of_ends.end());
  throw ConfigError(fmt::format(
      "--fit {}: \"{}\" is no property{}; materials have {}, transmitters have {}, and receivers have height", text,
      last, spelling_hint(last, known), fmt::join(property_names(false), ", "), fmt::join(of_ends, ", ")));
}

// Standard deviations that were given by NAME=VALUE.
class GivenErrors {
 public:
  explicit GivenErrors(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const size_t equals = text.rfind('=');
      const std::optional<double> value =
          equals == std::string::npos ? std::nullopt : finite_number(text.substr(equals + 1));
      if (!value || !(*value > 0))
        throw ConfigError(fmt::format(
            "--error {}: give NAME=VALUE, the name of a fitted parameter and its standard deviation, more than 0: m or "
            "degrees for ends, as mast.height=0.2, and for materials a share, as brick.permittivity=0.3",
            text));
      given_.push_back({text, text.substr(0, equals), *value});
    }
  }

  void set_prior(Parameter& parameter) {
    for (Given& given : given_) {
      if (!matches(given.pattern, parameter.name())) continue;
      given.used = true;
      parameter.prior = is_of_end(parameter.property) ? given.value / unit_of_theta(parameter.property) : given.value;
    }
  }

  void require_used(const std::vector<Parameter>& parameters) const {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters) names.push_back(parameter.name());
    for (const Given& given : given_)
      if (!given.used)
        throw ConfigError(fmt::format("--error {}: no parameter of this name is fitted{}; there are {}", given.text,
                                      spelling_hint(given.pattern, names), fmt::join(names, ", ")));
  }

 private:
  struct Given {
    std::string text, pattern;
    double value;
    bool used = false;
  };
  std::vector<Given> given_;
};

class Chooser {
 public:
  Chooser(const NamedRecords& world, const EndPlaces& ends, const Priors& priors, std::vector<std::string>& notes)
      : world_(world), ends_(ends), factor_(priors.factor), given_(priors.errors), notes_(notes) {
    for (size_t i = 0; i < world.names.size(); ++i)
      if (const bool used = world.records[i].permittivity[0] != 0; used && !world.names[i].empty())
        records_[world.names[i]].push_back(static_cast<uint32_t>(i));
  }

  std::vector<Parameter> operator()(const std::vector<std::string>& patterns) {
    for (const std::string& text : patterns) {
      const Pattern pattern = parse_pattern(text, world_.names);
      if (pattern.of_ends())
        choose_ends(pattern);
      else
        choose_materials(pattern);
    }
    given_.require_used(out_);
    const auto kind = [](const Parameter& of) { return is_of_end(of.property) + 2 * moves_paths(of.property); };
    std::ranges::stable_sort(out_, {}, kind);
    return std::move(out_);
  }

 private:
  void add(Parameter made) {
    for (const Parameter& other : out_)
      if (other.name() == made.name()) return;
    given_.set_prior(made);
    out_.push_back(std::move(made));
  }

  void add_material(const std::string& name, std::vector<uint32_t> of, Property property, bool asked) {
    if (property == Property::thickness || property == Property::scattering)
      std::erase_if(of, [&](uint32_t record) { return world_.in_walls[record]; });
    const std::string why =
        of.empty() ? "it belongs to the layers of walls" : obstacle(world_.records[of.front()], property, world_);
    if (why.empty())
      add({name, property, value_of(world_.records[of.front()], property, world_.frequency_hz),
           factor_ * usual_prior(property), of});
    else if (asked)
      notes_.push_back(fmt::format("{}.{} is not fitted: {}", name, name_of(property), why));
  }

  void choose_materials(const Pattern& pattern) {
    bool any = false;
    std::vector<std::string> known;
    for (const auto& [name, of] : records_) {
      known.push_back(name);
      if (!matches(pattern.owner, name)) continue;
      any = true;
      for (const Property property : pattern.properties) add_material(name, of, property, !pattern.all_properties);
    }
    if (!any)
      throw ConfigError(fmt::format("--fit {}: no surface has the material \"{}\"{}; there are {}", pattern.text,
                                    pattern.owner, spelling_hint(pattern.owner, known), fmt::join(known, ", ")));
  }

  void choose_ends(const Pattern& pattern) {
    const Property property = pattern.properties.front();
    bool any = false;
    std::vector<std::string> known;
    const auto look_at = [&](const std::string& name, uint32_t tx) {
      known.push_back(name + "." + name_of(property));
      if (!matches(pattern.owner, name)) return;
      any = true;
      add({name, property, value_of(ends_, tx, property), factor_ * usual_prior(property), {}, tx});
    };
    for (uint32_t tx = 0; tx < ends_.transmitters.size(); ++tx) {
      if (ends_.transmitters[tx].name == all_receivers)
        throw ConfigError(fmt::format(
            "--fit {}: a transmitter is called \"{}\", which stands for all measured places: give it another name",
            pattern.text, all_receivers));
      look_at(ends_.transmitters[tx].name, tx);
    }
    if (property == Property::height) look_at(all_receivers, no_end);
    if (!any)
      throw ConfigError(fmt::format("--fit {}: no transmitter is called \"{}\"{}; there are {}", pattern.text,
                                    pattern.owner, spelling_hint(pattern.text, known), fmt::join(known, ", ")));
  }

  const NamedRecords& world_;
  const EndPlaces& ends_;
  const double factor_;
  GivenErrors given_;
  std::vector<std::string>& notes_;
  std::map<std::string, std::vector<uint32_t>> records_;
  std::vector<Parameter> out_;
};

}  // namespace

bool move_paths(const std::vector<std::string>& patterns) {
  return std::ranges::any_of(patterns, [](const std::string& text) {
    const size_t dot = text.rfind('.');
    const auto property = dot == std::string::npos ? std::nullopt : property_named(text.substr(dot + 1));
    return property && moves_paths(*property);
  });
}

std::vector<Parameter> chosen_parameters(const NamedRecords& world, const EndPlaces& ends,
                                         const std::vector<std::string>& patterns, const Priors& priors,
                                         std::vector<std::string>& notes) {
  return Chooser(world, ends, priors, notes)(patterns);
}

}  // namespace wavetracer::calibration
