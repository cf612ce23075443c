// SPDX-License-Identifier: Apache-2.0
// Processes that share a folder. One of them prepares it, all take units, one of them leads and merges: each role is a
// claim (jobs/claims.hpp). DIR/shards/job.json says which job the folder was prepared for, and whether it is merged.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/pending_file.hpp"
#include "jobs/claims.hpp"
#include "jobs/compute_unit.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/interrupt.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto poll_interval = 100ms;
const char* const leading = "lead";  // the claim of the process that prepares the merge

class Team {
 public:
  Team(const DriveTask& task, const Ranks& ranks, const ProcessInfo& me, Progress& progress)
      : task_(task),
        ranks_(ranks),
        progress_(progress),
        shards_(shards_of(task)),
        claims_(shards_.folder(), me),
        units_(units_of(task)),
        writer_(task.run, shards_, progress),
        name_(me.name) {}

  Shared run() {
    if (prepared() && merged()) return {};
    if (!wait_until_prepared()) return {{}, units_.count()};
    claims_.look();  // before the manifests: a process that is dead by now has written its last line
    shards_.share(name_, true);
    if (merged()) return {};  // asked after the shards were read, as they are removed once it is true
    say_if_idle();
    lead();
    first_pass();
    Shared shared{{}, last_passes()};
    if (!take_merge(shared.missing == 0)) {
      shared.unmerged = interrupted() && !merged();
      return shared;
    }
    if (shared.missing > 0) return say_missing(shared);
    shared.results.totals = shards_.totals();
    progress_.line("writing to " + task_.run.config.output.directory);
    const std::unique_ptr<MergeAhead> ahead = writer_.take_ahead();
    shared.results.files = shards_.merge(task_.run, {}, ahead.get(), &shared.results.links);
    mark(true);
    shards_.remove_merged();
    remove_claims(shards_.folder());
    remove_dead_temporaries(shards_.folder());
    remove_dead_processes(shards_.folder());
    return shared;
  }

 private:
  const DriveTask& task_;
  const Ranks& ranks_;
  Progress& progress_;
  Shards shards_;
  Claims claims_;
  Units units_;
  UnitWriter writer_;
  std::string name_;
  bool leads_ = false;  // this process prepares the merge

  fs::path job_file() const { return shards_.folder() / "job.json"; }

  nlohmann::json job() const {
    const std::optional<std::string> text = read_text_if_there(job_file(), 1 << 16, "remove it and run again");
    nlohmann::json json = nlohmann::json::parse(text.value_or("{}"), nullptr, false);
    return json.is_object() ? json : nlohmann::json::object();
  }
  bool prepared() const { return job().value("job", nlohmann::json()) == ranks_.job; }
  bool merged() const { return prepared() && job().value("merged", nlohmann::json()) == true; }

  void mark(bool merged) const {
    const std::string text = nlohmann::json{{"job", ranks_.job}, {"merged", merged}}.dump() + "\n";
    PendingFile(job_file(), std::as_bytes(std::span(text))).commit();
  }

  // One process prepares the folder; returns false if an interrupt came first.
  bool wait_until_prepared() {
    const std::string claim = "prepare_" + fnv1a_128(ranks_.job);
    for (; !interrupted(); std::this_thread::sleep_for(poll_interval)) {
      if (prepared()) return true;
      claims_.look();
      if (claims_.state(claim) == ClaimState::failed)
        throw RuntimeError("the processes that prepared " + shards_.folder().string() + " were killed; run again");
      if (!claims_.take(claim)) continue;
      prepare();
      mark(shards_.complete());
      if (shards_.complete()) remove_claims(shards_.folder());  // later processes see the mark
      return true;
    }
    return false;
  }

  void prepare() {
    remove_dead_processes(shards_.folder());
    remove_claims(shards_.folder(), "prepare_");
    remove_dead_temporaries(shards_.folder());
    if (task_.resume) {
      shards_.resume();
      say_damaged(shards_, progress_);
      progress_.line(
          shards_.complete()
              ? "--resume: the run is complete, all parts are in the outputs; nothing is left to do"
              : fmt::format("--resume: {} of {} parts are computed already", shards_.count(), units_.count()));
      if (shards_.complete()) return;
    } else {
      shards_.clear();
    }
    shards_.write_record(task_.run);
  }

  void say_if_idle() {
    if (ranks_.rank != 0 || units_.count() >= ranks_.size) return;
    progress_.line(fmt::format("this run has {} {} for {} processes, so some are idle{}", units_.count(),
                               units_.count() == 1 ? "part" : "parts", ranks_.size,
                               task_.blocks > 1 ? "" : "; a lower output.shard_frames makes more"));
  }

  // One process prepares the merge while all compute, and merges in the end if it lives.
  void lead() {
    if (task_.blocks > 1 || !claims_.take(leading)) return;
    leads_ = true;
    writer_.follow(std::make_unique<MergeAhead>(task_.run.config, units_, task_.run.config.output.directory));
  }

  bool compute(const Unit& unit) { return compute_unit(task_, unit, Interrupted::drop, writer_, progress_); }

  // Each process takes the first unit that is left, so that the finished units have few gaps and can be merged ahead.
  void first_pass() {
    for_each_unit(units_, {.first = ranks_.rank, .count = units_.count()},
                  {.finished = [this](const Unit& unit) { return shards_.finished(unit); },
                   .choose =
                       [this](const Unit& unit) {
                         if (interrupted()) return UnitChoice::stop;
                         if (!claims_.take(unit_name(unit))) return UnitChoice::elsewhere;
                         // If all is merged, the claims of the others are gone.
                         return merged() ? UnitChoice::stop : UnitChoice::compute;
                       },
                   .compute = [this](const Unit& unit) { return compute(unit); }});
    writer_.finish();
  }

  // Takes over a unit that no living process computes.
  UnitChoice take_over(const Unit& unit) {
    if (interrupted()) return UnitChoice::leave;
    if (claims_.take(unit_name(unit))) {
      progress_.line(unit_words(unit) + ": taken over from a process that ended too early");
      return UnitChoice::compute;
    }
    return claims_.state(unit_name(unit)) == ClaimState::taken ? UnitChoice::elsewhere : UnitChoice::leave;
  }

  // Computes what dead processes left, until no process computes any more. Returns the number of missing units.
  uint64_t last_passes() {
    for (;; std::this_thread::sleep_for(poll_interval)) {
      claims_.look();  // before the manifests, as in run()
      shards_.look();
      if (merged()) return 0;  // asked after the manifests were read, as in run()
      writer_.look_ahead();
      const UnitCounts counts = for_each_unit(units_, {.count = units_.count()},
                                              {.finished = [this](const Unit& unit) { return shards_.finished(unit); },
                                               .choose = [this](const Unit& unit) { return take_over(unit); },
                                               .compute =
                                                   [this](const Unit& unit) {
                                                     const bool whole = compute(unit);
                                                     writer_.finish();
                                                     return whole;
                                                   }});
      if (counts.elsewhere == 0 || interrupted()) return counts.missing();
    }
  }

  // Tells whether this process must merge. A process that need not merge waits until another one has merged, since that
  // one may die while merging.
  bool take_merge(bool whole) {
    for (; !interrupted() && !merged(); std::this_thread::sleep_for(poll_interval)) {
      claims_.look();
      if (!leads_ && claims_.state(leading) == ClaimState::taken) continue;  // that process is about to merge
      const bool taken = claims_.take("merge");
      if (taken && merged()) remove_claims(shards_.folder());  // this process came after the others had gone
      if (taken || !whole) return taken && !merged();
      if (claims_.state("merge") == ClaimState::failed && !merged())
        throw RuntimeError("the processes that merged " + shards_.folder().string() +
                           " were killed; run again with --resume");
    }
    return false;
  }

  Shared say_missing(const Shared& shared) {
    constexpr size_t most_named = 5;
    std::vector<std::string> named;
    for_each_unit(units_, {.count = units_.count()},
                  {.finished = [this](const Unit& unit) { return shards_.finished(unit); },
                   .choose =
                       [&](const Unit& unit) {
                         if (named.size() == most_named) return UnitChoice::stop;
                         named.push_back(unit_words(unit));
                         return UnitChoice::leave;
                       },
                   .compute = {}});
    const std::string more =
        shared.missing > most_named ? fmt::format(" and {} more parts", shared.missing - most_named) : "";
    progress_.line(
        fmt::format("missing: {}{}; the processes that computed them ended too early. Continue with --resume, "
                    "or write what is computed with `wavetracer merge --partial {}`",
                    fmt::join(named, ", "), more, task_.run.config.output.directory));
    return shared;
  }
};

}  // namespace

Shared drive_together(const DriveTask& task, const Ranks& ranks, const ProcessInfo& me, Progress& progress) {
  return Team(task, ranks, me, progress).run();
}

}  // namespace wavetracer
