// SPDX-License-Identifier: Apache-2.0
// `wavetracer documentation` writes man pages, completions and the configuration reference, from the program's own
// tables. It is hidden: the build uses it and installs what it writes.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/command_text.hpp"
#include "app/commands.hpp"
#include "app/materials.hpp"
#include "base/file.hpp"
#include "config/reference.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::app {
namespace {

struct DocumentationOptions {
  std::string man, shell, output;
  bool reference = false, materials = false;
};

std::string page(const CLI::App& program, const DocumentationOptions& options) {
  if (options.man == "program") return program_manual(describe(program), WAVETRACER_VERSION);
  if (options.man == "config") return config::manual_page(WAVETRACER_VERSION);
  if (!options.shell.empty()) return completion(describe(program), options.shell);
  return options.materials ? materials_page() : config::markdown_reference();
}

}  // namespace

void add_documentation(CLI::App& program) {
  CLI::App* command = program.add_subcommand("documentation", "Write one page of the documentation");
  command->group("");
  const auto options = std::make_shared<DocumentationOptions>();
  CLI::Option_group* const what = command->add_option_group("page");
  what->add_option("--man", options->man, "The man page of the program or of its config files")
      ->check(CLI::IsMember({"program", "config"}));
  what->add_option("--completion", options->shell, "The completion script of a shell")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  what->add_flag("--reference", options->reference, "All keys of the configuration, as Markdown");
  what->add_flag("--materials", options->materials, "The library of radio materials, as Markdown");
  what->require_option(1);
  command->add_option("-o,--output", options->output, "File to write, instead of standard output");
  command->callback([options, &program] {
    const std::string text = page(program, *options);
    if (options->output.empty())
      std::cout << text << std::flush;
    else
      write_file(options->output, text);
  });
}

}  // namespace wavetracer::app
