# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# weft_options: what every source file of the project is compiled with. Results must not depend on
# the compiler, so a product and a sum are never contracted and fast-math is never used.
add_library(weft_options INTERFACE)
target_compile_options(
  weft_options
  INTERFACE -ffp-contract=off
            -fno-math-errno
            -fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=
            -Wall
            -Wextra
            -Wconversion
            -Wno-sign-conversion
            -Wnon-virtual-dtor
            -Woverloaded-virtual)
# Files that are compiled as one would shadow each other's names.
if(NOT WEFT_QUICK_BUILD)
  target_compile_options(weft_options INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(weft_options INTERFACE -Wshadow=local)
endif()
if(WEFT_WERROR)
  target_compile_options(weft_options INTERFACE -Werror)
endif()

if(WEFT_SANITIZE)
  target_compile_options(
    weft_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                           -fno-omit-frame-pointer -g1)
  target_link_options(weft_options INTERFACE -fsanitize=address,undefined)
endif()

# weft_wrap_overflow(): for the targets of the calling folder. Damaged JPEG files make sums in
# stb_image overflow, which does no harm where it is defined.
function(weft_wrap_overflow)
  set_source_files_properties("${CMAKE_SOURCE_DIR}/host/scene/texture/stb_image_implementation.cpp"
                              PROPERTIES COMPILE_OPTIONS -fwrapv SKIP_PRECOMPILE_HEADERS ON)
endfunction()
