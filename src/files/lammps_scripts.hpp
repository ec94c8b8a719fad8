// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input scripts of a case for LAMMPS, in parts; words between two @ are filled in by lammps_case.cpp.
#pragma once

#include <string_view>

namespace lucy::files::lammps_scripts {

inline constexpr std::string_view system_part = R"lammps(
units lj
dimension 2
boundary p p p
atom_style atomic
box tilt large
@read@
)lammps";

inline constexpr std::string_view read_start_part = "read_data start.data";

// A restart file brings the box, the particles and the state of fixes; styles and coefficients are given again.
inline constexpr std::string_view read_start_or_restart_part = R"lammps(
if "${from} == 0" then "read_data start.data" else "read_restart @name@.restart.${from}"
if "${restart_steps} > 0" then "restart ${restart_steps} @name@.restart.1 @name@.restart.2")lammps";

// The table is exact at its entries and straight in r^2 between them.
inline constexpr std::string_view table_part = R"lammps(
pair_style table linear @entries@
pair_coeff 1 1 lucy.table LUCY
)lammps";

inline constexpr std::string_view exact_part = R"lammps(
# A (1 - 6 x^2 + 8 x^3 - 3 x^4), x = r/h, from two Mie forms with negative exponents, each shifted to zero at r = h.
pair_style hybrid/overlay nm/cut @range@ nm/cut @range@
pair_coeff 1 1 nm/cut 1 @twice_amplitude@ @range@ -2 -3
pair_coeff 1 1 nm/cut 2 @minus_amplitude@ @range@ -3 -4
pair_modify pair nm/cut 1 shift yes
pair_modify pair nm/cut 2 shift yes
)lammps";

inline constexpr std::string_view point_script = R"lammps(# @title@
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

inline constexpr std::string_view series_part = R"lammps(
# What is watched. T counts 2N - 2 degrees of freedom; kinetic pressures are peculiar. tilt is that of the box which the
# forces of the row have seen, of the step before: LAMMPS moves the cell after them (frames have that of their own step).
if "${from} > 0" then "shell cat @name@_series.dat >> @name@_series_before.dat"
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
variable fastest equal sqrt(2*c_largest)
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
if "${from} == 0" then "variable frames string @name@" else "variable frames string @name@_from_$(step:%.0f)"
if "${frame_steps} > 0" then &
  "dump frames all custom ${frame_steps} ${frames}.dump id x y vx vy" &
  "dump_modify frames sort id format float %.17g"
if "${frame_steps} > 0 && ${from} == 0" then "dump_modify frames time yes"
thermo_style custom step pe c_peculiar v_pxy v_pxx v_pyy xy v_fastest
thermo_modify norm no
thermo 10000
)lammps";

inline constexpr std::string_view going_on_part = R"lammps(
# Every @restart_steps@ steps (-var restart_steps 5000) the state goes to @name@.restart.1 and @name@.restart.2 in turn.
# A run that was cut off goes on from the newer of them, here the first,
#   lmp -in @name@.in -log @name@.log -var from 1
# and appends to its series, at its end. Rows after the restart file then stand there twice, and the later ones count
# (lucy lammps run takes those). Frames go to another dump, @name@_from_STEP.dump, with steps but without times: LAMMPS
# counts time from the restart file on.)lammps";

inline constexpr std::string_view joined_series_part = R"lammps(
if "${from} > 0" then &
  "shell cat @name@_series_before.dat @name@_series.dat > @name@_series_joined.dat" &
  "shell mv @name@_series_joined.dat @name@_series.dat" &
  "shell rm @name@_series_before.dat")lammps";

inline constexpr std::string_view variables_part = R"lammps(
variable step index @step@
variable steps index @steps@
variable every index @every@
variable frame_steps index @frame_steps@
variable restart_steps index @restart_steps@
variable from index 0)lammps";

inline constexpr std::string_view nve_script = R"lammps(# @title@
# Motion at constant energy, velocity Verlet:
#   lmp -in nve.in -log nve.log                   (mpirun -np 4 lmp -in nve.in -log nve.log on four cores)
# nve_series.dat: what is watched, every @every@ steps, of the instant. Any variable below can be set from the command
# line: -var steps 1000 -var frame_steps 20 (frames: nve.dump).
#@going_on@
@variables@
variable rate index 0
@system@@pair@
neighbor @skin@ bin
neigh_modify every 1 delay 0 check yes
timestep ${step}
compute peculiar all temp
fix motion all nve
@series@
run ${steps} upto
@joined_series@
write_data nve_final.data nocoeff
)lammps";

inline constexpr std::string_view sheared_script = R"lammps(# @title@
# Steady shear at constant temperature:
#   lmp -in sheared.in -log sheared.log           (mpirun -np 4 lmp -in sheared.in -log sheared.log on four cores)
# sheared_series.dat: what is watched, every @every@ steps, of the instant; heat is what the thermostat has removed, to
# be compared with the work, minus the integral of rate*pxy*area. Any variable below can be set from the command line:
# -var steps 1000 -var frame_steps 20 (frames: sheared.dump, laboratory velocities) -var rebuild 1 (neighbour lists at
# most so many steps apart; they are made as often as the fastest particle needs it).
#@going_on@
#
# What is not used here, and why (LAMMPS of 29 Sep 2021):
#   fix nvt/sllod      counts the shear twice: it removes twice the work as heat
#   tchain 3           (the default) lets the temperature settle away from its target once heat flows: tchain 1
#   box flips          (fix deform's own, -var flip yes) kick particles that have left the box since they were last
#                      wrapped; the heat of that grows as the rate cubed. Here the cell is turned back between runs,
#                      after `run 0` has wrapped every particle with its velocity (start and stop are for
#                      fix deform, which knows no rate in a run of no length, and would leave velocities alone).
#   check yes          of neigh_modify counts the motion of the box's corners: a new list in every step
@variables@
variable rate index @rate@
# kT: @temperature_from@.
variable temperature index @temperature@
variable rebuild index @most_steps@
variable flip index no
@system@@pair@
change_box all triclinic
timestep ${step}

# Laboratory velocities: peculiar ones and the flow.
if "${from} == 0" then &
  "velocity all ramp vx 0 $(v_rate*ly:%.17g) y $(ylo:%.17g) $(yhi:%.17g) sum yes units box"
compute peculiar all temp/deform
fix thermostat all nvt temp ${temperature} ${temperature} @relaxation@ tchain 1
fix_modify thermostat temp peculiar
@series@
fix shear all deform 1 xy erate ${rate} remap v flip ${flip}

# Neighbour lists reach beyond the range by `skin` and are used for `age` steps more: two particles of the speed `limit`,
# headed for each other, come nearer by less in that time, the flow between them included. The fastest particle is looked
# at every @every@ steps: beyond the limit, the run is cut short and goes on with other lists. Where two such particles
# come nearer by @longest_approach@ or more in one step, lists are made in every step.
variable limit equal @speed_margin@*v_fastest
variable closing equal (2*v_limit+abs(v_rate)*(@range@+@largest_skin@))*dt
variable wanted equal (v_closing<@longest_approach@)*ceil(@wanted_skin@/v_closing)
variable age equal (v_wanted<v_rebuild)*v_wanted+(v_wanted>=v_rebuild)*(v_rebuild-1)

variable sign equal 2*(v_rate>0)-1
variable left equal ${steps}-step
if "${flip} == no" then "variable widest equal 0.5" else "variable widest equal 1e9"
variable to_turn equal ceil((v_widest*lx-v_sign*xy)/(v_sign*v_rate*ly*dt)-1e-9)
neigh_modify every 1 delay 0 check no
run 0 start $(step) stop $(step+1) post no
label segment
neighbor $(v_age*v_closing+0.01:%.17g) bin
neigh_modify every $(v_age+1:%.0f) delay 0 check no
fix watch all halt @every@ v_fastest > $((v_age>0)*v_limit+(v_age==0)*1e300:%.17g) error continue message no
variable these equal $((v_to_turn<v_left)*v_to_turn+(v_to_turn>=v_left)*v_left:%.0f)
run ${these} post no
run 0 start $(step) stop $(step+1) post no
if "$(v_sign*xy/lx) > $(v_widest-1e-6)" then "change_box all xy final $(xy-v_sign*lx:%.17g) units box"
if "$(v_left) > 0" then "jump SELF segment"
@joined_series@
write_data sheared_final.data nocoeff
)lammps";

}  // namespace lucy::files::lammps_scripts
