// SPDX-License-Identifier: Apache-2.0
// Puts the page together: metadata as JSON, blocks in base64, then the sources of the page in the order of their
// dependencies. Names from files appear in the JSON only, and the page shows them as text, never as markup.
#include "viewer/view.hpp"
#include <fmt/format.h>
#include <cmath>
#include <initializer_list>
#include "base/digits.hpp"
#include "radio/link_budget.hpp"
#include "results/link_table.hpp"
#include "results/saved_world.hpp"
#include "viewer/blocks.hpp"
#include "viewer/frame_blocks.hpp"
#include "viewer/grid_maps.hpp"
#include "viewer/page_files.hpp"
#include "viewer/scene_blocks.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

constexpr uint64_t least_frame_bytes = 8'000'000;  // space for frames, even if the scene fills the page
constexpr uint64_t form_bytes = 20'000;            // largest size of index.html, style.css and a warning or two

std::vector<size_t> chosen_rows(const SavedRun& run, const ViewOptions& options) {
  std::vector<size_t> rows;
  for (size_t row = 0; row < run.frame_count(); ++row)
    if (run.number(row) >= options.first_frame && run.number(row) <= options.last_frame) rows.push_back(row);
  if (rows.empty())
    throw ConfigError(fmt::format("{}: has no frame from {} to {}; its frames are {} to {}", run.file().string(),
                                  options.first_frame, options.last_frame, run.number(0),
                                  run.number(run.frame_count() - 1)));
  return rows;
}

bool finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Returns the origin of float32 coordinates on the page: the scene's origin, or the middle of the ends.
glm::dvec3 centre_of(const SavedRun& run, const Scene& scene, size_t row) {
  if (!scene.vertices.empty()) return scene.origin_m;
  const SavedFrame frame = run.frame(row);
  glm::dvec3 sum{0};
  double count = 0;
  for (const auto* ends : {&frame.transmitter_position_m, &frame.receiver_position_m})
    for (const glm::dvec3& p : *ends)
      if (finite(p)) sum += p, count += 1;
  const glm::dvec3 centre = sum / std::max(count, 1.0);
  return finite(centre) ? centre : glm::dvec3{0};
}

json end_row(const RadioEnd& end) { return {end.name, end.antenna, end.polarization.word()}; }

json transmitter_rows(const SavedRun& run) {
  json rows = json::array();
  for (const RadioEnd& end : run.transmitters()) rows.push_back(end_row(end));
  return rows;
}

// Leaves out the cells of grids, whose names the page makes itself.
json receiver_rows(const SavedRun& run, const std::vector<bool>& own) {
  json rows = json::array();
  for (size_t i = 0; i < own.size(); ++i)
    if (own[i]) rows.push_back(end_row(run.receivers()[i]));
  return rows;
}

// Returns a row per kind of path, the least special first: the code of its interaction, 0 for line of sight; the words
// for the interaction and the path; its colours; whether the run has computed it, or holds one.
json path_kind_rows(const Config& config, uint32_t interactions) {
  json rows = json::array();
  const auto add = [&](unsigned code, std::string_view interaction, const PathKind& kind, bool shown) {
    rows.push_back({{"code", code},
                    {"interaction", interaction},
                    {"word", kind.word},
                    {"dark", kind.dark},
                    {"light", kind.light},
                    {"shown", shown}});
  };
  add(0, "", path_kinds.front(), true);
  for (const InteractionKind& kind : interaction_kinds)
    add(kind.code, kind.word, kind.paths, config.trace.*kind.asked_for || (interactions & kind.code));
  return rows;
}

json missed_ranges(const Missed& missed) {
  const auto range = [](const MissedRange& of) { return json{of.estimate, of.low, of.high}; };
  return {{"paths", range(missed.paths)}, {"power_share", range(missed.power_share)}};
}

json certificate_row(const CertificateFacts& of) {
  return {{"depth", of.depth},
          {"any_depth", of.any_depth},
          {"edges", of.edges},
          {"left_out_sr", of.left_out_sr},
          {"left_out_share", of.left_out_share},
          {"left_out_power", of.left_out_power},
          {"floor_db", of.floor_db ? json(*of.floor_db) : json()},
          {"weak_share", of.weak_share}};
}

json box(const PageBounds& of, const glm::dvec3& centre_m) {
  const glm::dvec3 lower = of.lower - centre_m, upper = of.upper - centre_m;
  return {{lower.x, lower.y, lower.z}, {upper.x, upper.y, upper.z}};
}

json instance_rows(const SavedRun& run, const SavedWorld& world) {
  json rows = json::array();
  for (size_t i = 0; i < run.instances().size(); ++i) {
    const uint32_t model = world.instance_model[i];
    rows.push_back({run.instances()[i].id, run.instances()[i].type, model == no_instance ? -1 : int64_t{model}});
  }
  return rows;
}

// Returns the values that the page needs for received powers; null if the configuration does not give them.
json link_budget_row(const RadioConfig& radio) {
  const double noise = noise_dbm(radio);
  return {{"transmit_power_dbm", radio.transmit_power_dbm ? json(*radio.transmit_power_dbm) : json()},
          {"noise_dbm", std::isfinite(noise) ? json(noise) : json()}};
}

json run_facts(const SavedRun& run, const SavedWorld& world, const ViewOptions& options) {
  const std::string folder = std::filesystem::absolute(run.file()).parent_path().filename().string();
  return {{"title", options.title.empty() ? folder : options.title},
          {"reload_s", options.reload_s},
          {"version", run.version()},
          {"device", run.device()},
          {"frequency_hz", run.frequency_hz()},
          {"rx_ports", run.rx_ports()},
          {"tx_ports", run.tx_ports()},
          {"link_budget", link_budget_row(world.config.radio)},
          {"transmitters", transmitter_rows(run)},
          {"missed", run.missed() ? missed_ranges(*run.missed()) : json()},
          {"missed_unknown", run.missed_unknown()},
          {"certificate", run.certificate() ? certificate_row(*run.certificate()) : json()},
          {"instances", instance_rows(run, world)}};
}

void warn_of_losses(const FrameBlocks& blocks, ViewPage& page) {
  if (blocks.shown_paths < blocks.paths)
    page.warnings.push_back(
        fmt::format("the page holds the {} strongest of {} paths; fewer frames (--frames) "
                    "or another limit (--max-paths) show the others",
                    grouped(blocks.shown_paths), grouped(blocks.paths)));
  if (blocks.shown_links < blocks.links)
    page.warnings.push_back(fmt::format("gains over time are there for the {} strongest of {} links of all frames",
                                        grouped(blocks.shown_links), grouped(blocks.links)));
  if (!blocks.area_warning.empty()) page.warnings.push_back(blocks.area_warning);
}

// Adds to the metadata what the blocks of frames have.
void add_frame_facts(const FrameBlocks& blocks, const SavedWorld& world, const glm::dvec3& centre, json& meta,
                     ViewPage& page) {
  page.paths = blocks.shown_paths;
  warn_of_losses(blocks, page);
  meta["frames"] = blocks.frames;
  meta["gain_range_db"] = {blocks.lowest_db, blocks.highest_db};
  meta["highest_order"] = blocks.highest_order;
  meta["path_kinds"] = path_kind_rows(world.config, blocks.interactions);
  if (blocks.ends_m) meta["ends_m"] = box(*blocks.ends_m, centre);
  meta["links"] = blocks.shown_links;
  meta["link_columns"] = {{"areas", blocks.areas}, {"beams", blocks.beams}};
  meta["paths"] = {blocks.shown_paths, blocks.paths};
  meta["warnings"] = page.warnings;
}

// Writes sampled rays, which may take a quarter of the page; null if the run holds none.
json ray_rows(const SavedRun& run, const std::vector<size_t>& rows, const ViewOptions& options,
              const glm::dvec3& centre_m, std::string& elements, ViewPage& page) {
  const std::optional<SavedWaypoints> waypoints = saved_waypoints(run);
  if (!waypoints) return {};
  std::vector<uint32_t> numbers;
  for (const size_t row : rows) numbers.push_back(run.number(row));
  const RayBlocks blocks = add_ray_blocks(*waypoints, numbers, centre_m, options.max_bytes / 4, elements);
  if (!blocks.warning.empty()) page.warnings.push_back(blocks.warning);
  return {{"points", blocks.frames}, {"highest_depth", blocks.highest_depth}, {"sources", blocks.sources}};
}

// Bytes of names that are not UTF-8 become the replacement character.
std::string meta_text(const json& meta) {
  return script_text(meta.dump(-1, ' ', true, json::error_handler_t::replace));
}

struct Mark {
  std::string_view mark, text;
};

// Returns the template with its marks, in their order, replaced by their texts.
std::string filled(std::string_view form, std::initializer_list<Mark> marks) {
  size_t size = form.size();
  for (const Mark& mark : marks) size += mark.text.size();
  std::string out;
  out.reserve(size);
  for (const auto& [mark, text] : marks) {
    const size_t at = form.find(mark);
    if (at == std::string_view::npos) throw RuntimeError("index.html has no " + std::string(mark));
    out.append(form.substr(0, at)).append(text);
    form.remove_prefix(at + mark.size());
  }
  return out.append(form);
}

std::string script(const char* name) { return fmt::format("<script>\n{}</script>\n", page_file(name)); }

}  // namespace

ViewPage make_view(const SavedRun& run, const ViewOptions& options) {
  chosen_rows(run, options);  // throws before the world is loaded
  return make_view(run, load_saved_world(run, true), options);
}

ViewPage make_view(const SavedRun& run, const SavedWorld& world, const ViewOptions& options) {
  const std::vector<size_t> rows = chosen_rows(run, options);
  ViewPage page;
  page.warnings = world.warnings;
  page.frames = rows.size();
  const glm::dvec3 centre = centre_of(run, world.scene, rows.front());

  std::string scripts = "<script>/*\n" + std::string(page_file("three_license.txt")) + "*/\n" +
                        std::string(page_file("three.min.js")) + "\n</script>\n";
  for (const char* name :
       {"data.js",   "palette.js",    "camera.js",   "roofs.js",   "world.js",   "lines.js", "rays.js",
        "pick.js",   "quantities.js", "coverage.js", "overlay.js", "filters.js", "find.js",  "details.js",
        "charts.js", "chosen.js",     "player.js",   "reload.js",  "share.js",   "main.js"})
    scripts += script(name);

  std::string elements;
  const json scene =
      add_scene_blocks(world.scene, "scene", world.scene.origin_m - centre, world.config.trace.free_edges, elements);
  if (const std::string warning = add_street_blocks(world.streets, world.scene, centre, elements); !warning.empty())
    page.warnings.push_back(warning);
  json models = json::array();
  for (size_t i = 0; i < world.models.size(); ++i)
    models.push_back(add_scene_blocks(world.models[i], fmt::format("model_{}", i), world.models[i].origin_m,
                                      world.config.trace.free_edges, elements));
  const std::vector<GridMap> grids = find_grids(run.receivers());
  const std::vector<bool> own = outside_of_grids(grids, run.receivers().size());
  const json grid_rows =
      add_grid_blocks(grids, run.receivers(), run.frame(rows.front()).receiver_position_m, centre, elements);
  const json rays = ray_rows(run, rows, options, centre, elements, page);
  LinkTable links = link_table(run);
  if (!links.warning.empty()) page.warnings.push_back(links.warning);
  json meta = run_facts(run, world, options);
  meta.update({{"centre_m", {centre.x, centre.y, centre.z}},
               {"receivers", receiver_rows(run, own)},
               {"grids", grid_rows},
               {"scene", scene},
               {"models", models},
               {"vegetation", add_vegetation_block(world.scene, world.scene.origin_m - centre, elements)},
               {"rays", rays},
               {"warnings", page.warnings}});
  const uint64_t taken = form_bytes + scripts.size() + elements.size() + meta_text(meta).size();
  const uint64_t room = taken + least_frame_bytes < options.max_bytes ? options.max_bytes - taken : least_frame_bytes;
  const FrameBlocks blocks = add_frame_blocks(run,
                                              {.rows = rows,
                                               .max_paths = options.max_paths,
                                               .bytes = room,
                                               .own_receivers = own,
                                               .links = std::move(links),
                                               .grids = grids,
                                               .area_paths = options.reload_s == 0 ? options.area_paths : 0},
                                              centre, elements);
  add_frame_facts(blocks, world, centre, meta, page);
  page.html = filled(page_file("index.html"), {{"/*STYLE*/", page_file("style.css")},
                                               {"<!--META-->", meta_text(meta)},
                                               {"<!--BLOCKS-->", elements},
                                               {"<!--SCRIPTS-->", scripts}});
  return page;
}

}  // namespace wavetracer
