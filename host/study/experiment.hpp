// SPDX-License-Identifier: Apache-2.0
// The experiments of `wavetracer thesis`, as data: what is measured, shown, and claimed. run.hpp carries one out. Those
// called figure-6.N are the figures of A. Zhdanov's thesis (TU Munich, 2014).
// To add one, add a row to one of the lists below; its claims are predicates of NAME_claims.hpp and similar files.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>
#include "study/cache_study.hpp"
#include "study/cache_views.hpp"
#include "study/claim.hpp"
#include "study/coherence_frames.hpp"
#include "study/order_rows.hpp"

namespace wavetracer::study {

// Orders of rays, over the numbers of rays of ray_counts.hpp. The fields of its words are order_fields().
struct OrderFigure {
  std::vector<Series> series;  // gains are relative to the first series
  bool moves;                  // true: averages over the frames of a moving_world(); false: medians of the first frame
  Claims<OrderRow> claims;
  Range range = {};  // for claims that give no other
};

// A view of a study of caches; figures share studies. The fields are cache_fields().
struct CacheFigure {
  std::shared_ptr<const CacheStudy> study;
  CacheView view;
  Claims<CacheRow> claims = {};
  std::vector<std::string> settings = {};  // the settings for the field {saves}
  Range range = {};                        // for claims that give no other
};

// Compares the hits of one transmitter's rays in frames of a drive. Fields: {device}, {rays}, {frames}, {moved} and
// {apart} (metres of the transmitter's way, and per frame), {world} (the traffic around it), {age} (of the first frame,
// in seconds).
struct FrameFigure {
  Claims<FramePair> claims;
  uint32_t frames = 201;  // 2 s at 100 frames per second
  bool traffic = false;   // adds traffic to the built-in city, which has none otherwise
};

// Compares hits along the order of the launch, for each map of directions. Fields: {device}, {rays}, {fibonacci}: "0.98
// at lag 987", where first hits of Fibonacci rays correlate most.
struct LagFigure {};

struct Experiment {
  std::string name;       // name on the command line, and of the files
  std::string doc;        // one line for the list
  std::string title;      // title of the report and the plot
  std::string caption;    // caption of the plot
  std::string paragraph;  // the thesis' statement, its place, and how it was measured; with fields
  std::variant<OrderFigure, CacheFigure, FrameFigure, LagFigure> figure;

  // Returns null for other kinds.
  template <class Figure>
  const Figure* as() const {
    return std::get_if<Figure>(&figure);
  }
  const CacheStudy* study() const { return as<CacheFigure>() ? as<CacheFigure>()->study.get() : nullptr; }
  // It launches one number of rays, so --rays is refused.
  bool one_ray_count() const;
  // It is about frames that move, see moving_world().
  bool moves() const;
};

const std::vector<Experiment>& standing_figures();        // figures 6.1 to 6.9
const std::vector<Experiment>& traffic_figures();         // figures 6.10 to 6.13, and coherence-frames
const std::vector<Experiment>& hashing_figures();         // figures 6.14 to 6.18
const std::vector<Experiment>& further_experiments();     // beyond the thesis' figures
const std::vector<Experiment>& innerframe_experiments();  // coherence inside a frame, answered by a cache

// Returns all of them, in this order.
const std::vector<Experiment>& experiments();
// Throws ConfigError with the known names and the nearest of them.
const Experiment& find_experiment(const std::string& name);
// Returns a line for each experiment.
std::string experiment_list();

constexpr const char* built_in_city_name = "built-in city";  // used as Config::file

// Returns scene and ends of an experiment: those of the file, or of the built-in city if the name is empty. Throws
// ConfigError, also if a set gives a key that the experiment varies.
Config experiment_config(const Experiment& experiment, const std::string& file, const std::vector<std::string>& sets);

// Throws ConfigError, with the name of the experiment, if this config has nothing for it to measure.
void check_experiment(const Experiment& experiment, const Config& config);

// Returns the config of a figure of orders, with a frame before the `frames` that are averaged if the figure moves.
// Every frame launches all rays of transmitters, and no others: none is saved by reuse or a cache, none is added by
// receivers for diffraction.
Config point_config(const OrderFigure& figure, const Config& config, uint64_t frames);

}  // namespace wavetracer::study
