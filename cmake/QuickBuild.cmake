# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# What makes a build from nothing quick, where WEFT_QUICK_BUILD is on: headers that most files
# include are parsed once, and several files of a target are compiled as one (a unity build). Other
# builds find files that forget an include, and compile less after a change.
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
  if(WEFT_QUICK_BUILD)
    target_precompile_headers(${target} PRIVATE ${weft_common_headers} ${ARGN})
    weft_precompile_warnings(${target})
  endif()
endfunction()

# weft_precompile_once(<target> <group>): the common ones, fmt and JSON, once for all targets of a
# group, which are compiled with the same options.
function(weft_precompile_once target group)
  if(WEFT_QUICK_BUILD)
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

# weft_compile_together(<target> <count>): up to so many files at a time. Their unnamed namespaces
# become one, in which a name stands for one thing. A file that makes functions of kernels its own
# (NATIVE_KERNELS) leaves macros behind, and is compiled alone.
function(weft_compile_together target count)
  if(NOT WEFT_QUICK_BUILD)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(source "${source}" ABSOLUTE)
    if(source MATCHES "\\.cpp$" AND EXISTS "${source}")
      file(STRINGS "${source}" kernels REGEX "^#define NATIVE_KERNELS " LIMIT_COUNT 1)
      if(kernels)
        set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${count})
endfunction()
