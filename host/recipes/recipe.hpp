// The recipes: experiments that have a name, as data. host/recipes/run.hpp carries one out.
// Each belongs to a figure of A. Zhdanov's thesis (TU Munich, 2014), whose number is its name, or to a measure of it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "recipes/measure.hpp"
#include "recipes/series.hpp"

namespace wavetracer::recipes {

struct Request;   // run.hpp
struct Host;
struct Findings;

// Either series, timed and compared, or an experiment of its own with a fixed number of rays.
struct Recipe {
  std::string name;            // on the command line, and of the files
  std::string doc;             // one line for the list
  std::string title;           // of the plot
  std::vector<Series> series;  // the first is what gains are against
  uint32_t frames = 1;         // places along the way of a moving transmitter; 1: the transmitters of the config
  // Claim beside measurement.
  std::string (*paragraph)(const std::vector<Row>& rows, const std::string& device) = nullptr;
  Findings (*experiment)(const Recipe& recipe, const Request& request, const Host& host) = nullptr;
  bool drive = false;  // the transmitter of the built-in city is a car in its street, not a mast
};

Recipe figure_6_1();
Recipe figure_6_18();
Recipe coherence_frames();
Recipe coherence_rays();

const std::vector<Recipe>& recipes();
// Throws ConfigError with the known names and the nearest of them.
const Recipe& find_recipe(const std::string& name);
// One line a recipe.
std::string recipe_list();

// Scene and ends of a recipe: those of the file, or of the built-in city where the name is empty. Throws ConfigError,
// also where a set gives a key that the recipe varies.
Config recipe_config(const Recipe& recipe, const std::string& file, const std::vector<std::string>& sets);

// The config of one ray count. Frames of a moving transmitter are transmitters side by side, half a metre apart along
// x, each traced in batches of its own: no ray shares a launch or a sort with one of another frame.
Config point_config(const Recipe& recipe, const Config& config, uint64_t rays, bool gpu);

}  // namespace wavetracer::recipes
