// SPDX-License-Identifier: Apache-2.0
// `wavetracer merge` joins the parts of a run that several processes or machines have written.
// It needs no device and none of the run's input files.
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/named_files.hpp"
#include "app/written_files.hpp"
#include "base/digits.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/merge_folders.hpp"
#include "jobs/process_files.hpp"
#include "jobs/progress.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::vector<std::string> directories;
  std::string output;
  bool partial = false;
};

// Returns the folder of the outputs; if it is not that of the parts, it must not have shards of another run.
fs::path target_of(const MergeOptions& options) {
  if (options.output.empty()) {
    if (options.directories.size() > 1)
      throw ConfigError("merge: there are several folders of parts, so name a folder for the results with -o");
    return fs::absolute(options.directories.front()).lexically_normal();
  }
  const fs::path target = fs::absolute(options.output).lexically_normal();
  const bool source = std::any_of(options.directories.begin(), options.directories.end(), [&](const auto& directory) {
    std::error_code none;
    return fs::equivalent(directory, target, none);
  });
  if (!source && !manifests_in(target / "shards").empty())
    throw ConfigError(
        fmt::format("merge: {} holds parts itself; name it among the folders, or choose another one", target.string()));
  return target;
}

std::string missing_words(const FoundParts& found) {
  std::string out;
  for (size_t i = 0; i < found.missing.size() && i < 10; ++i) out += (i ? ", " : "") + unit_words(found.missing[i]);
  if (found.missing_count > 10) out += fmt::format(" and {} more", found.missing_count - 10);
  return out;
}

// Reserves the folders against other writers. Parts may lie in folders where this process cannot write.
std::vector<std::unique_ptr<FolderHold>> hold_all(const std::vector<std::string>& directories, const fs::path& target) {
  const ProcessInfo process = this_process("", 0);
  std::vector<std::unique_ptr<FolderHold>> held;
  held.push_back(std::make_unique<FolderHold>(target, process));
  for (const std::string& directory : directories) {
    const fs::path shards = fs::path(directory) / "shards";
    if (access(shards.c_str(), W_OK) != 0)
      check_not_in_use(shards);
    else if (!fs::exists(process_file(shards, process)))
      held.push_back(std::make_unique<FolderHold>(directory, process));
  }
  return held;
}

// The folder for the results may be made, and is perhaps one of these.
void check_folders(const std::vector<std::string>& directories) {
  std::error_code none;
  for (const std::string& directory : directories)
    if (!fs::exists(directory, none))
      throw InputError(
          fmt::format("{}: there is no such folder; name one that `wavetracer run --shard` has written to", directory));
}

void merge(const MergeOptions& options, Invocation& invocation) {
  check_folders(options.directories);
  Progress progress;
  const fs::path target = target_of(options);
  check_output_folder(target);
  check_output_names(target);
  const std::vector<std::unique_ptr<FolderHold>> held = hold_all(options.directories, target);
  const FoundParts found = find_parts({options.directories.begin(), options.directories.end()});
  for (const std::string& damaged : found.damaged) progress.line("damaged: " + damaged);
  if (found.missing_count > 0) {
    progress.line("missing: " + missing_words(found));
    invocation.code = ExitCode::partial;
    if (!options.partial) {
      progress.line("nothing was written; compute the missing parts, or use --partial to write the parts that exist");
      return;
    }
  }
  const auto files = merge_found(found, target, invocation.command_line);
  const Totals totals = totals_of(found.shards);
  std::cout << fmt::format("merged     {} parts: {} frames, {} links, {} paths\n", found.shards.size(),
                           grouped(totals.frames), grouped(totals.links), grouped(totals.counts.paths));
  std::cout << written_line(files) << std::flush;
}

}  // namespace

void add_merge(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand("merge", "Join the parts of a run that several processes have written");
  const auto options = std::make_shared<MergeOptions>();
  command->add_option("DIR", options->directories, "Folders of parts, as run --shard or an interrupted run leaves them")
      ->required();
  command->add_option("-o,--output", options->output,
                      "Folder for the results; with one DIR, the default is that folder");
  command->add_flag("--partial", options->partial, "Join the parts that exist, even if others are missing");
  command->footer(
      "Exit code 5: parts are missing. All DIR must belong to one run, with the same configuration, input files, "
      "--frames, --repeat, version and kind of device.");
  command->callback([options, &invocation] { merge(*options, invocation); });
}

}  // namespace wavetracer::app
