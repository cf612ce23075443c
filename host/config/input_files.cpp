// SPDX-License-Identifier: Apache-2.0
// It uses the field table, so a new key with a file is included automatically.
#include "config/input_files.hpp"
#include <algorithm>
#include "config/field_table.hpp"

namespace wavetracer::config {

std::vector<NamedFile> input_files(Config& config) {
  std::vector<NamedFile> out;
  for (const Table& table : tables()) {
    const size_t count = table.count ? table.count(config) : 1;
    for (const Field& field : table.fields) {
      if (field.form != Form::input_file && field.form != Form::choice_or_file) continue;
      for (size_t i = 0; i < count; ++i) {
        std::string* const value = std::get<std::string*>(field.slot(config, i));
        const bool named = std::find(field.choices.begin(), field.choices.end(), *value) != field.choices.end();
        if (!value->empty() && !named) out.push_back({table.name + "." + field.name, value});
      }
    }
  }
  return out;
}

}  // namespace wavetracer::config
