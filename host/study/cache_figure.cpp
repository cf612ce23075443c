// SPDX-License-Identifier: Apache-2.0
// Figures of caches: a view of a study, and the claims on its rows.
// Figures of one study are made of one measurement, as thesis.cpp does.
#include "study/cache_claims.hpp"
#include "study/run.hpp"

namespace wavetracer::study {

Findings show(const Experiment& experiment, const CacheMeasurement& measured, const Request& request) {
  Findings found{.device = measured.device, .points = measured.points, .planned = measured.planned};
  if (measured.points == 0) return found;
  const CacheFigure& figure = *experiment.as<CacheFigure>();
  CacheShown shown = figure.view(measured);
  LinePlot& plot = shown.plot;
  plot.name = experiment.name;
  plot.title = experiment.title + ", " + measured.device.name;
  if (shown.table.names().empty()) shown.table = csv_of(cache_columns(), measured.rows);
  if (plot.settings.empty()) plot.settings = settings_of(measured.rows);
  found.figure = line_figure(plot, shown.table);
  const Fields fields = cache_fields(measured.rows, measured.device.name, figure.settings);
  found.words = {filled(experiment.paragraph, fields), judged(figure.claims, measured.rows, figure.range, fields),
                 shown.numbers.rows.empty() ? summary_table(measured.rows) : shown.numbers};
  found.notes = study_notes(measured, request.repeats);
  found.notes.insert(found.notes.end(), shown.notes.begin(), shown.notes.end());
  return found;
}

Findings measure(const CacheFigure& figure, const Experiment& experiment, const Request& request, const Host& host) {
  return show(experiment, measure_study(*figure.study, request, host), request);
}

}  // namespace wavetracer::study
