# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# weft_precompile(<target> [headers...]): parses what most files include once for the target where
# WEFT_PRECOMPILED_HEADERS is on. Files that forget an include are found by builds without it.
function(weft_precompile target)
  if(WEFT_PRECOMPILED_HEADERS)
    target_precompile_headers(
      ${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits>
      <map> <memory> <numbers> <optional> <random> <span> <string> <string_view> <utility> <vector>
      <glm/glm.hpp> ${ARGN})
    # Where headers are precompiled, g++ 12 does not know what lies in the standard library, and takes
    # strings that are moved there for out of bounds.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overread
                                               -Wno-stringop-overflow)
    endif()
  endif()
endfunction()
