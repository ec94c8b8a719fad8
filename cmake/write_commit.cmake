# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Writes OUTPUT, the source file that states the commit of SOURCE_DIRECTORY: its hash, "-modified" appended when a file
# that is compiled differs from it, or "unknown" outside a git checkout. An unchanged file is left alone, so that nothing
# is compiled or linked again. Reading someone else's checkout as root is fine here: nothing of it is executed.
cmake_minimum_required(VERSION 3.25)

set(commit unknown)
find_program(git git)
if(git)
  set(ask ${git} -c safe.directory=* -c core.fsmonitor=false -C ${SOURCE_DIRECTORY})
  execute_process(COMMAND ${ask} rev-parse --show-prefix --verify HEAD OUTPUT_VARIABLE answer ERROR_QUIET
                  RESULT_VARIABLE failed)
  # The first line is where we stand inside the checkout: empty at its top. Elsewhere the checkout is not Lucy's.
  if(NOT failed AND answer MATCHES "^\n([0-9a-f]+)\n$")
    set(commit ${CMAKE_MATCH_1})
    execute_process(COMMAND ${ask} --no-optional-locks status --porcelain --untracked-files=no -- CMakeLists.txt cmake
                            include src OUTPUT_VARIABLE modified ERROR_QUIET)
    if(modified)
      string(APPEND commit "-modified")
    endif()
  endif()
endif()

file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "// Written by cmake/write_commit.cmake.
#include \"lucy/build_record.hpp\"

namespace lucy::detail {
const char* const commit = \"@commit@\";
}
")
