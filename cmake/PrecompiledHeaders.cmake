# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# Parses what most files include once, where WEFT_PRECOMPILED_HEADERS is on. Files that forget an
# include are found by builds without it.
set(weft_common_headers
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers>
    <optional> <random> <span> <string> <string_view> <utility> <vector> <glm/glm.hpp>)

# Where headers are precompiled, g++ 12 does not know what lies in the standard library, and takes
# strings that are moved there for out of bounds.
function(weft_precompile_warnings target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overread
                                             -Wno-stringop-overflow)
  endif()
endfunction()

# weft_precompile(<target> [headers...]): the common ones and those, for the target alone.
function(weft_precompile target)
  if(WEFT_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${weft_common_headers} ${ARGN})
    weft_precompile_warnings(${target})
  endif()
endfunction()

# weft_precompile_once(<target> <group>): the common ones, fmt and JSON, once for all targets of a
# group, which are compiled with the same options.
function(weft_precompile_once target group)
  if(WEFT_PRECOMPILED_HEADERS)
    get_property(owner GLOBAL PROPERTY WEFT_PRECOMPILED_OWNER_${group})
    if(owner)
      target_precompile_headers(${target} REUSE_FROM ${owner})
    else()
      target_precompile_headers(${target} PRIVATE ${weft_common_headers} <fmt/format.h>
                                                  <nlohmann/json.hpp>)
      set_property(GLOBAL PROPERTY WEFT_PRECOMPILED_OWNER_${group} ${target})
    endif()
    weft_precompile_warnings(${target})
  endif()
endfunction()
