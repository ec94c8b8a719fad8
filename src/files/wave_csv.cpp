// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/wave_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>

#include "choice_names.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/csv.hpp"
#include "lucy/files/wave_input.hpp"
#include "row_cells.hpp"

namespace lucy::files {

namespace {

using cases::WavePoint;
using cases::WaveQuantity;
using cases::WaveResult;
using cases::WaveRow;
using statistics::Estimate;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view no_choice = "none";
constexpr std::array<std::pair<std::string_view, bool>, 2> judges = {{{"likelihood", true}, {"residuals", false}}};

std::array<std::pair<std::string_view, statistics::DecayForm>, statistics::decay_forms.size()> form_names() {
  std::array<std::pair<std::string_view, statistics::DecayForm>, statistics::decay_forms.size()> names;
  for (std::size_t f = 0; f < names.size(); ++f)
    names[f] = {statistics::name(statistics::decay_forms[f]), statistics::decay_forms[f]};
  return names;
}

/// Real numbers that follow from the settings or stand beside the quantities, and where each lies.
constexpr std::array<std::pair<std::string_view, double WaveRow::*>, 5> numbers = {{
    {"wave_vector", &WaveRow::wave_vector},
    {"sample_interval", &WaveRow::sample_interval},
    {"prescribed", &WaveRow::prescribed},
    {"imposed_amplitude", &WaveRow::imposed_amplitude},
    {"parts_until", &WaveRow::parts_until},
}};

/// The keys whose values stand in a row.
std::vector<BoundKey<WavePoint>> settings_keys(WaveQuantity quantity) {
  auto keys = wave_point_keys(quantity);
  std::erase_if(keys, [](const BoundKey<WavePoint>& bound) {
    const std::string path = bound.key.path();
    return bound.key.section == "output" || path == "system.dimension" || path == "run.seed" ||
           path == "run.energy_tolerance";
  });
  return keys;
}

std::string column_of(const Key& key) { return key.path() == "kernel.name" ? "kernel" : key.name; }

bool has_meaning(const Key& key, const WavePoint& point) {
  return point.reading == motion::Reading::spam || (key.section != "fluid" && key.section != "start");
}

/// Whether the cell holds no value: nan of a number, none of a choice.
std::string nothing(const Key& key) { return std::string(key.type == Type::choice ? no_choice : "nan"); }

std::string cell_text(const BoundKey<WavePoint>& bound, const WavePoint& point) {
  const auto value = bound.binding.get(point);
  if (!value || !has_meaning(bound.key, point)) return nothing(bound.key);
  if (const auto* text = std::get_if<std::string>(&*value)) return *text;
  if (const auto* number = std::get_if<double>(&*value)) return shortest_text(*number);
  return fmt::format("{}", std::get<std::int64_t>(*value));
}

WavePoint read_settings(WaveQuantity quantity, const RowCells& cells) {
  WavePoint point;
  point.quantity = quantity;
  for (const auto& bound : settings_keys(quantity)) {
    const std::string column = column_of(bound.key);
    const std::string& cell = cells.text(column);
    if (cell == nothing(bound.key)) continue;
    switch (bound.key.type) {
      case Type::choice:
        if (std::ranges::find(bound.key.choices, cell) == bound.key.choices.end())
          cells.refuse_choice(column, cell, fmt::format("{}", fmt::join(bound.key.choices, ", ")));
        bound.binding.set(point, cell);
        break;
      case Type::integer:
        bound.binding.set(point, cells.integer(column));
        break;
      default:
        bound.binding.set(point, cells.number(column));
    }
  }
  return point;
}

/// The names of the quantities as they stand in the file.
std::vector<std::string> quantity_names(WaveQuantity quantity) {
  std::vector<std::string> names;
  for (const auto name : cases::wave_quantities) names.emplace_back(name == "rest" ? cases::rest_name(quantity) : name);
  return names;
}

}  // namespace

std::string wave_file_name(WaveQuantity quantity) {
  return quantity == WaveQuantity::shear ? "shear_wave.csv" : "temperature_wave.csv";
}

std::vector<std::string> wave_columns(WaveQuantity quantity) {
  std::vector<std::string> columns;
  for (const auto& bound : settings_keys(quantity)) columns.push_back(column_of(bound.key));
  for (const auto& [name, member] : numbers) columns.emplace_back(name);
  for (const auto& name : quantity_names(quantity)) add_with_error(columns, name);
  for (const auto* name : {"preferred_form", "preferred_by", "worst_energy_error", "subdivided_steps", "status"})
    columns.emplace_back(name);
  return columns;
}

void write_wave_csv(const std::filesystem::path& path, WaveQuantity quantity, std::span<const WaveRow> rows) {
  const auto keys = settings_keys(quantity);
  write_rows(path, wave_columns(quantity), rows, [&](CsvLine& line, const WaveRow& row) {
    for (const auto& bound : keys) line.add(std::string_view(cell_text(bound, row.settings)));
    for (const auto& [name, member] : numbers) line.add(row.*member);
    for (const Estimate& estimate : row.estimates) add(line, estimate);
    line.add(statistics::name(row.preferred));
    line.add(name_of(judges, row.by_likelihood));
    line.add(row.worst_energy_error);
    line.add(row.subdivided_steps);
    line.add(cases::status_name(row.status));
  });
}

std::vector<WaveRow> read_wave_csv(const std::filesystem::path& path, WaveQuantity quantity) {
  const auto names = quantity_names(quantity);
  return read_rows<WaveRow>(path, wave_columns(quantity), wave_file_name(quantity),
                            [&](const RowCells& cells, WaveRow& row) {
                              row.settings = read_settings(quantity, cells);
                              for (const auto& [name, member] : numbers) row.*member = cells.number(name);
                              for (std::size_t i = 0; i < names.size(); ++i)
                                row.estimates[i] = cells.estimate(names[i]);
                              row.preferred = cells.choice("preferred_form", form_names());
                              row.by_likelihood = cells.choice("preferred_by", judges);
                              row.worst_energy_error = cells.number("worst_energy_error");
                              row.subdivided_steps = cells.integer("subdivided_steps");
                              row.status = cells.status();
                            });
}

bool same_settings(const WavePoint& one, const WavePoint& other) {
  return one.quantity == other.quantity &&
         std::ranges::all_of(settings_keys(one.quantity), [&](const BoundKey<WavePoint>& bound) {
           return cell_text(bound, one) == cell_text(bound, other);
         });
}

void write_local_csv(const std::filesystem::path& path, std::span<const WaveResult> results) {
  std::vector<std::string> columns = {"point", "begin", "end"};
  for (const auto* name : {"amplitude", "gradient", "diffusivity", "particle_noise"}) add_with_error(columns, name);
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  CsvLine line;
  for (std::size_t point = 0; point < results.size(); ++point) {
    for (const cases::LocalDiffusivity& local : results[point].local) {
      line.add(static_cast<std::int64_t>(point + 1));
      line.add(local.begin);
      line.add(local.end);
      for (const Estimate& estimate : {local.amplitude, local.gradient, local.value, local.particle_noise})
        add(line, estimate);
      text += line.end();
    }
  }
  write_file_atomically(path, text);
}

void write_forms_csv(const std::filesystem::path& path, std::span<const WaveResult> results) {
  std::vector<std::string> columns = {"point", "form", "preferred"};
  for (const auto* name :
       {"amplitude", "diffusivity", "yield_stress", "yield_amplitude", "relaxation_time", "modulus", "behind"})
    add_with_error(columns, name);
  for (const auto* name : {"relative_residual", "residual_over_error"}) columns.emplace_back(name);
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  CsvLine line;
  for (std::size_t point = 0; point < results.size(); ++point) {
    for (const cases::WaveForm& form : results[point].forms) {
      line.add(static_cast<std::int64_t>(point + 1));
      line.add(statistics::name(form.form));
      line.add(std::string_view(form.preferred ? "yes" : "no"));
      for (const Estimate& estimate : {form.amplitude, form.diffusivity, form.yield_stress, form.yield_amplitude,
                                       form.relaxation_time, form.modulus, form.behind})
        add(line, estimate);
      line.add(form.relative_residual);
      line.add(form.residual_over_error);
      text += line.end();
    }
  }
  write_file_atomically(path, text);
}

void write_amplitude_csv(const std::filesystem::path& path, WaveQuantity quantity,
                         std::span<const WaveResult> results) {
  std::string text = fmt::format("point,time,amplitude,amplitude_error,fit,particle_noise,operator,{},carried\n",
                                 cases::rest_name(quantity));
  CsvLine line;
  for (std::size_t point = 0; point < results.size(); ++point) {
    const cases::WaveCurve& curve = results[point].curve;
    for (std::size_t i = 0; i < curve.time.size(); ++i) {
      line.add(static_cast<std::int64_t>(point + 1));
      for (const auto* values : {&curve.time, &curve.mean, &curve.error, &curve.fit, &curve.particle_noise})
        line.add(i < values->size() ? (*values)[i] : not_a_number);
      for (const auto& part : curve.parts) line.add(part[i]);
      text += line.end();
    }
  }
  write_file_atomically(path, text);
}

}  // namespace lucy::files
