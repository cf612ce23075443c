// The recipes: experiments that have a name, as data. host/recipes/run.hpp carries one out.
// Each belongs to a figure of A. Zhdanov's thesis (TU Munich, 2014), whose number is its name, or to a measure of it.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>
#include "study/cache_study.hpp"
#include "study/findings.hpp"
#include "study/measure.hpp"
#include "study/series.hpp"

namespace wavetracer::study {

struct Request;  // run.hpp
struct Host;
struct Findings;

// Series, timed and compared; or an experiment of its own with a fixed number of rays; or a view of a study of caching.
struct Recipe {
  std::string name;            // on the command line, and of the files
  std::string doc;             // one line for the list
  std::string title;           // of the plot
  std::vector<Series> series;  // the first is what gains are against
  uint32_t frames = 1;         // places along the way of a moving transmitter; 1: the transmitters of the config
  // Claim beside measurement.
  Words (*words)(const std::vector<Row>& rows, const std::string& device) = nullptr;
  Findings (*experiment)(const Recipe& recipe, const Request& request, const Host& host) = nullptr;
  bool drive = false;  // the transmitter of the built-in city is a car in its street, not a mast
  std::shared_ptr<const CacheStudy> study = nullptr;
  // What this figure shows of the study: its table, plot and words.
  Findings (*view)(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) = nullptr;
};

constexpr const char* built_in_city_name = "built-in city";  // as its Config::file

Recipe figure_6_1();
Recipe figure_6_13();
Recipe figure_6_18();
Recipe coherence_frames();
Recipe coherence_rays();
std::vector<Recipe> chained_figures();  // 6.2 to 6.5
std::vector<Recipe> open_figures();     // 6.6 to 6.9
std::vector<Recipe> purging_figures();  // 6.10 to 6.12
std::vector<Recipe> hashing_figures();  // 6.14 to 6.17
std::vector<Recipe> cache_steps();      // cache-division, cache-step

const std::vector<Recipe>& recipes();
// Throws ConfigError with the known names and the nearest of them.
const Recipe& find_recipe(const std::string& name);
// One line a recipe.
std::string recipe_list();

// Scene and ends of a recipe: those of the file, or of the built-in city where the name is empty. Throws ConfigError,
// also where a set gives a key that the recipe varies.
Config recipe_config(const Recipe& recipe, const std::string& file, const std::vector<std::string>& sets);

// Throws ConfigError, with the name of the recipe, where this config has nothing for it to measure.
void check_recipe(const Recipe& recipe, const Config& config);

// The config of one ray count of a series. Every frame launches all rays of transmitters, and no others: none is saved
// by reuse or a cache, none added by receivers for diffraction. Frames of a moving transmitter are transmitters side by
// side, half a metre apart along x, each traced in batches of its own: no ray shares a launch or a sort with one of
// another frame. Nothing else sends then.
Config point_config(const Recipe& recipe, const Config& config, uint64_t rays, bool gpu);

}  // namespace wavetracer::study
