// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lucy/files/lammps_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string_view>

#include "lucy/build_record.hpp"
#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"
#include "lucy/files/particle_file.hpp"
#include "lucy/files/series_file.hpp"

namespace lucy::files {

namespace {

namespace fs = std::filesystem;

constexpr int entries = 16000;
constexpr double innermost = 1e-6;            // particles overlap; LAMMPS stops where one pair is nearer than this
constexpr double longest_between_rows = 0.2;  // the fast part of the stress correlation dies within two time units

// Neighbour lists reach beyond the range by the skin. At rest LAMMPS itself sees when a particle has come too far;
// under shear its test counts the motion of the box's corners as well and asks for a new list in every step: there a
// list is made anew after so many steps that two particles may approach each other by the skin, at a speed of
// `fastest_approach` in units of the typical relative one, (2 kT)^(1/2), and with the flow between them.
constexpr double skin = 1.0;
constexpr double fastest_approach = 7.0;

int steps_between_lists(const LammpsCase& one) {
  double start = 0.0;
  for (const double p : one.start.momentum) start += 0.5 * p * p / static_cast<double>(one.point.particles);
  const double speed = fastest_approach * std::sqrt(2.0 * std::max(start, one.temperature)) +
                       std::abs(one.point.strain_rate) * (one.point.range + skin);
  return std::clamp(static_cast<int>(skin / (speed * one.point.step)), 1, 20);
}

/// `text` with every @name@ replaced.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('@');
    result += text.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const std::size_t end = text.find('@', begin + 1);
    result += values.at(std::string(text.substr(begin + 1, end - begin - 1)));
    text.remove_prefix(end + 1);
  }
}

std::string number(double value) { return fmt::format("{}", value); }

constexpr std::string_view system_part = R"lammps(
units lj
dimension 2
boundary p p p
atom_style atomic
box tilt large
read_data start.data
)lammps";

// The table is exact at its entries and straight in r^2 between them.
constexpr std::string_view table_part = R"lammps(
pair_style table linear @entries@
pair_coeff 1 1 lucy.table LUCY
)lammps";

constexpr std::string_view exact_part = R"lammps(
# A (1 - 6 x^2 + 8 x^3 - 3 x^4), x = r/h, from two Mie forms with negative exponents, each shifted to zero at r = h.
pair_style hybrid/overlay nm/cut @range@ nm/cut @range@
pair_coeff 1 1 nm/cut 1 @twice_amplitude@ @range@ -2 -3
pair_coeff 1 1 nm/cut 2 @minus_amplitude@ @range@ -3 -4
pair_modify pair nm/cut 1 shift yes
pair_modify pair nm/cut 2 shift yes
)lammps";

constexpr std::string_view point_script = R"lammps(# @title@
# Energy, pressure tensor and forces of start.data, @what@:
#   lmp -in @name@.in -log @name@.log
# The values go to @name@.txt (kinetic and potential part of the pressure, xx yy xy), the forces to @name@.dump.
@system@@pair@
compute peculiar all temp
compute kinetic all pressure peculiar ke
compute potential all pressure NULL virial
thermo_style custom step pe c_kinetic[1] c_kinetic[2] c_kinetic[4] c_potential[1] c_potential[2] c_potential[4]
thermo_modify norm no
dump forces all custom 1 @name@.dump id x y fx fy
dump_modify forces sort id format float %.17g
run 0
print "# potential_energy kinetic_xx kinetic_yy kinetic_xy potential_xx potential_yy potential_xy" file @name@.txt
print "$(pe:%.17g) $(c_kinetic[1]:%.17g) $(c_kinetic[2]:%.17g) $(c_kinetic[4]:%.17g) &
$(c_potential[1]:%.17g) $(c_potential[2]:%.17g) $(c_potential[4]:%.17g)" append @name@.txt
)lammps";

constexpr std::string_view series_part = R"lammps(
# What is watched. T counts 2N - 2 degrees of freedom; kinetic pressures are peculiar.
compute kinetic all pressure peculiar ke
compute potential all pressure NULL virial
variable own atom 0.5*((vx-v_rate*y)^2+vy^2)
compute largest all reduce max v_own
variable n equal count(all)
variable time equal step*dt
variable phi equal c_thermo_pe/v_n
variable kt equal c_peculiar
variable xyk equal c_kinetic[4]
variable xyp equal c_potential[4]
variable xxk equal c_kinetic[1]
variable xxp equal c_potential[1]
variable yyk equal c_kinetic[2]
variable yyp equal c_potential[2]
variable share equal c_largest/(c_peculiar*(v_n-1))
variable pxy equal v_xyk+v_xyp
variable pxx equal v_xxk+v_xxp
variable pyy equal v_yyk+v_yyp
variable energy equal c_thermo_pe+c_peculiar*(v_n-1)
variable heat equal @heat@
variable tilt equal xy
fix series all ave/time ${every} 1 ${every} v_time v_phi v_kt v_xyk v_xyp v_xxk v_xxp v_yyk v_yyp v_share v_pxy v_pxx &
  v_pyy v_energy v_heat v_tilt file @name@_series.dat format " %.15g" title1 "# @title@" &
  title2 "# step time @columns@ pxy pxx pyy energy heat tilt"
if "${frame_steps} > 0" then &
  "dump frames all custom ${frame_steps} @name@.dump id x y vx vy" &
  "dump_modify frames sort id time yes format float %.17g"
thermo_style custom step pe c_peculiar v_pxy v_pxx v_pyy xy
thermo_modify norm no
thermo 10000
)lammps";

constexpr std::string_view nve_script = R"lammps(# @title@
# Motion at constant energy, velocity Verlet:
#   lmp -in nve.in -log nve.log                   (mpirun -np 4 lmp -in nve.in -log nve.log on four cores)
# nve_series.dat: what is watched, every @every@ steps, of the instant. Any variable below can be set from the command
# line: -var steps 1000 -var frame_steps 20 (frames: nve.dump).

variable step index @step@
variable steps index @steps@
variable every index @every@
variable frame_steps index 0
variable rate index 0
@system@@pair@
neighbor @skin@ bin
neigh_modify every 1 delay 0 check yes
timestep ${step}
compute peculiar all temp
fix motion all nve
@series@
run ${steps}
write_data nve_final.data nocoeff
)lammps";

constexpr std::string_view sheared_script = R"lammps(# @title@
# Steady shear at constant temperature:
#   lmp -in sheared.in -log sheared.log           (mpirun -np 4 lmp -in sheared.in -log sheared.log on four cores)
# sheared_series.dat: what is watched, every @every@ steps, of the instant; heat is what the thermostat has removed, to
# be compared with the work, minus the integral of rate*pxy*area. Any variable below can be set from the command line:
# -var steps 1000 -var frame_steps 20 (frames: sheared.dump, laboratory velocities) -var rebuild 1 (neighbour lists in
# every step, for a state with particles much faster than thermal ones).
#
# What is not used here, and why (LAMMPS of 29 Sep 2021):
#   fix nvt/sllod      counts the shear twice: it removes twice the work as heat
#   tchain 3           (the default) lets the temperature settle away from its target once heat flows: tchain 1
#   box flips          (fix deform's own, -var flip yes) kick particles that have left the box since they were last
#                      wrapped; the heat of that grows as the rate cubed. Here the cell is turned back between runs,
#                      after `run 0` has wrapped every particle with its velocity (start and stop are for
#                      fix deform, which knows no rate in a run of no length, and would leave velocities alone).

variable step index @step@
variable steps index @steps@
variable every index @every@
variable frame_steps index 0
variable rate index @rate@
variable temperature index @temperature@
variable rebuild index @rebuild@
variable flip index no
@system@@pair@
change_box all triclinic
neighbor @skin@ bin
neigh_modify every ${rebuild} delay 0 check no
timestep ${step}

# Laboratory velocities: peculiar ones and the flow.
velocity all ramp vx 0 $(v_rate*ly:%.17g) y $(ylo:%.17g) $(yhi:%.17g) sum yes units box
compute peculiar all temp/deform
fix thermostat all nvt temp ${temperature} ${temperature} @relaxation@ tchain 1
fix_modify thermostat temp peculiar
@series@
fix shear all deform 1 xy erate ${rate} remap v flip ${flip}
if "${flip} == yes" then "run ${steps}" "jump SELF end"

variable sign equal 2*(v_rate>0)-1
variable left equal ${steps}-step
variable to_turn equal ceil((0.5*lx-v_sign*xy)/(v_sign*v_rate*ly*dt)-1e-9)
label segment
variable these equal $((v_to_turn<v_left)*v_to_turn+(v_to_turn>=v_left)*v_left:%.0f)
run ${these} post no
run 0 start $(step) stop $(step+1) post no
if "$(v_sign*xy/lx) > 0.499999" then "change_box all xy final $(xy-v_sign*lx:%.17g) units box"
if "$(v_left) > 0" then "jump SELF segment"
label end
write_data sheared_final.data nocoeff
)lammps";

std::string table_text(const kernel::Lucy<2>& kernel, const std::string& title) {
  const double first = innermost * innermost;
  const double between = (kernel.range() * kernel.range() - first) / (entries - 1);
  std::string text = fmt::format(
      "# {}: Lucy's function of range {}\n# number, r, phi, -dphi/dr\n\nLUCY\n"
      "N {} RSQ {} {}\n\n",
      title, kernel.range(), entries, innermost, kernel.range());
  for (int i = 0; i < entries; ++i) {
    const double r = i + 1 < entries ? std::sqrt(first + i * between) : kernel.range();
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", i + 1, r, kernel.weight(r), r * kernel.slope(r));
  }
  return text;
}

}  // namespace

int series_steps(const cases::CouettePoint& point) {
  return std::max(1, static_cast<int>(longest_between_rows / point.step * (1.0 + 1e-9)));
}

std::int64_t lammps_steps(const cases::CouettePoint& point) {
  return std::llround((point.equilibration + point.duration) / point.step);
}

void write_lammps_case(const fs::path& folder, const LammpsCase& one) {
  const cases::CouettePoint& point = one.point;
  const kernel::Lucy<2> kernel(point.range);
  const std::string title =
      fmt::format("Lucy fluid, N = {}, E/N = {}, rate {}, seed {}; written by lucy {}", point.particles,
                  point.energy_per_particle, point.strain_rate, point.seed, build_record().version);
  const double amplitude = kernel.weight_at_zero();
  std::string columns;
  for (const auto name : cases::observables) columns += (columns.empty() ? "" : " ") + std::string(name);

  std::map<std::string, std::string, std::less<>> values = {{"title", title},
                                                            {"columns", columns},
                                                            {"entries", fmt::format("{}", entries)},
                                                            {"range", number(point.range)},
                                                            {"twice_amplitude", number(2.0 * amplitude)},
                                                            {"minus_amplitude", number(-amplitude)},
                                                            {"step", number(point.step)},
                                                            {"steps", fmt::format("{}", lammps_steps(point))},
                                                            {"every", fmt::format("{}", series_steps(point))},
                                                            {"rate", number(point.strain_rate)},
                                                            {"temperature", number(one.temperature)},
                                                            {"relaxation", number(point.relaxation_time)},
                                                            {"skin", number(skin)},
                                                            {"rebuild", fmt::format("{}", steps_between_lists(one))},
                                                            {"system", std::string(system_part)}};
  const auto write = [&](const std::string& name, const std::string& heat, std::string_view pair,
                         std::string_view script) {
    values["name"] = name;
    values["heat"] = heat;
    values["pair"] = filled(pair, values);
    values["series"] = filled(series_part, values);
    write_file_atomically(folder / (name + ".in"), filled(script, values));
  };
  write_file_atomically(folder / "lucy.table", table_text(kernel, title));
  write_file_atomically(folder / "start.data",
                        particle_text(ParticleFormat::lammps_data, one.start, 0.0, title + "; peculiar velocities"));
  values["what"] = "by the table";
  write("single_point", "0", table_part, point_script);
  values["what"] = "exact to rounding";
  write("exact_point", "0", exact_part, point_script);
  write("nve", "0", table_part, nve_script);
  if (point.strain_rate != 0.0) write("sheared", "f_thermostat", table_part, sheared_script);
}

TableError table_error(const kernel::Lucy<2>& kernel, double density) {
  constexpr int parts = 16;  // of each interval, where the straight line is compared
  const double first = innermost * innermost;
  const double between = (kernel.range() * kernel.range() - first) / (entries - 1);
  const auto entry = [&](int i) { return std::min(std::sqrt(first + i * between), kernel.range()); };
  TableError error;
  double energy = 0.0;    // integral of |error of phi| 2 pi r dr
  double square = 0.0;    // of (error of the force)^2
  double pressure = 0.0;  // of r |error of the force|
  for (int i = 0; i + 1 < entries; ++i) {
    const double low = entry(i);
    const double high = entry(i + 1);
    for (int part = 0; part < parts; ++part) {
      const double along = (part + 0.5) / parts;
      const double r = std::sqrt(first + (i + along) * between);
      const double of_energy =
          kernel.weight(low) + along * (kernel.weight(high) - kernel.weight(low)) - kernel.weight(r);
      const double of_force =
          r * (kernel.slope(low) + along * (kernel.slope(high) - kernel.slope(low)) - kernel.slope(r));
      error.pair_energy = std::max(error.pair_energy, std::abs(of_energy));
      error.pair_force = std::max(error.pair_force, std::abs(of_force));
      const double area = std::numbers::pi * between / parts;  // 2 pi r dr = pi d(r^2)
      energy += std::abs(of_energy) * area;
      square += of_force * of_force * area;
      pressure += r * std::abs(of_force) * area;
    }
  }
  error.energy = 0.5 * density * energy;
  error.force = std::sqrt(0.5 * density * square);
  error.pressure = 0.25 * density * density * pressure;
  return error;
}

cases::EngineSeries read_lammps_series(const fs::path& path) {
  const ColumnFile file = read_columns(path);
  const auto column = [&](std::string_view name) -> const std::vector<double>& {
    return file.columns[find_column(file, name, path)];
  };
  cases::EngineSeries series;
  series.time = column("time");
  series.energy = column("energy");
  series.heat = column("heat");
  series.instants.resize(series.time.size());
  for (std::size_t q = 0; q < cases::observables.size(); ++q) {
    const auto& values = column(cases::observables[q]);
    for (std::size_t row = 0; row < values.size(); ++row) series.instants[row][q] = values[row];
  }
  return series;
}

cases::CouetteRecord record_of(const cases::EngineSeries& series, const cases::CouettePoint& point) {
  const int between = series_steps(point);
  const int rows = std::max(1, cases::sample_steps(point) / between);
  cases::CouetteRecord record;
  record.sample_interval = rows * between * point.step;
  record.worst_energy_error = std::numeric_limits<double>::quiet_NaN();
  record.steps = lammps_steps(point);
  const double from = point.equilibration + 0.5 * point.step;
  std::size_t row = 0;
  while (row < series.time.size() && series.time[row] < from) ++row;
  for (; row + static_cast<std::size_t>(rows) <= series.time.size(); row += static_cast<std::size_t>(rows)) {
    cases::Sample sum{};
    for (int i = 0; i < rows; ++i)
      for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += series.instants[row + static_cast<std::size_t>(i)][q];
    for (double& value : sum) value /= rows;
    record.samples.push_back(sum);
  }
  return record;
}

cases::PointSums read_lammps_point(const fs::path& folder, const std::string& name) {
  const fs::path values = folder / (name + ".txt");
  const ColumnFile printed = read_columns(values);
  const auto value = [&](const char* column) { return printed.columns[find_column(printed, column, values)].back(); };
  cases::PointSums point;
  point.potential_energy = value("potential_energy");
  point.kinetic = {value("kinetic_xx"), value("kinetic_yy"), value("kinetic_xy")};
  point.potential = {value("potential_xx"), value("potential_yy"), value("potential_xy")};

  // The rows of the dump begin behind the names of its columns.
  const fs::path dump = folder / (name + ".dump");
  const std::string text = read_text_file(dump);
  const std::size_t header = text.find("ITEM: ATOMS");
  const std::size_t first = header == std::string::npos ? header : text.find('\n', header);
  if (first == std::string::npos) throw BadInput(fmt::format("{} has no ITEM: ATOMS", dump.string()));
  const ColumnFile rows = parse_columns(std::string_view(text).substr(first), dump);
  if (rows.columns.size() != 5) throw BadInput(fmt::format("{} has not the columns id x y fx fy", dump.string()));
  for (std::size_t i = 0; i < rows.columns[0].size(); ++i)
    for (const std::size_t column : {3, 4}) point.forces.push_back(rows.columns[column][i]);
  return point;
}

}  // namespace lucy::files
