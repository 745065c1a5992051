# SPDX-License-Identifier: Apache-2.0
# How our own code is compiled: strict warnings as errors, the same arithmetic everywhere.

# One input gives one output: no fused multiply-add behind our back, wherever common is compiled.
add_compile_options(-ffp-contract=off)

add_library(penduline_warnings INTERFACE)
set(warnings
  -Wall -Wextra -Wpedantic -Werror -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wformat=2 -Wsuggest-override
  -Wzero-as-null-pointer-constant -Wredundant-decls)
target_compile_options(penduline_warnings INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:${warnings}>")

if(PENDULINE_TIDY)
  find_program(CLANG_TIDY NAMES clang-tidy-14 clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${CLANG_TIDY} --quiet)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # The sloppiness lets it keep what was compiled with a precompiled header.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()
