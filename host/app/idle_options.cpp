// SPDX-License-Identifier: Apache-2.0
// Flags have no name of their own where they only negate (--no-ground); their names are the negated ones then.
#include "app/idle_options.hpp"
#include <fmt/format.h>
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

void refuse(const CLI::Option& option, const std::string& reason) {
  if (option.count() == 0) return;
  throw ConfigError(fmt::format("{}: {}; leave it out", option.get_name(), reason));
}

}  // namespace

void refuse_options(const CLI::App& command, std::initializer_list<const char*> names, const std::string& reason) {
  for (const char* name : names) refuse(*command.get_option(name), reason);
}

void refuse_group(const CLI::App& command, const std::string& group, const std::string& reason) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_group() == group) refuse(*option, reason);
}

}  // namespace wavetracer::app
