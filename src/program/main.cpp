// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line.hpp"

int main(int argument_count, char** arguments) { return lucy::program::run_program(argument_count, arguments); }
