# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# Compiles the kernels natively, once per instruction set and number of lanes. Each variant lives
# in a namespace of its own and exports one table function; generated/native_variants.def lists
# them for the choice at run time, generated/native_kernels.def includes the kernels.
include(CheckCXXCompilerFlag)

# A build that is not made for speed compiles faster with less.
set(WEFT_NATIVE_OPTIMIZATION
    -O3
    CACHE STRING "Optimization of native kernels")

# weft_native_variant(<target> <isa> <lanes> [compiler flags...])
function(weft_native_variant target isa lanes)
  set(variant "weft_native_${isa}_${lanes}")
  add_library(${variant} OBJECT "${CMAKE_SOURCE_DIR}/host/device/native/kernels_native.cpp")
  target_include_directories(${variant} PRIVATE "${CMAKE_SOURCE_DIR}/host" "${CMAKE_SOURCE_DIR}"
                             "${WEFT_GENERATED_DIR}")
  target_link_libraries(${variant} PRIVATE weft_options weft_dependencies)
  target_compile_definitions(
    ${variant} PRIVATE WEFT_LANES=${lanes} WEFT_NATIVE_NAMESPACE=${variant}
                       WEFT_NATIVE_TABLE=weft_native_table_${isa}_${lanes})
  target_compile_options(${variant} PRIVATE ${ARGN})
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
    target_compile_options(${variant} PRIVATE ${WEFT_NATIVE_OPTIMIZATION})
  endif()
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${variant}>)
  set_property(GLOBAL APPEND PROPERTY WEFT_NATIVE_OBJECTS $<TARGET_OBJECTS:${variant}>)
  set_property(
    GLOBAL APPEND_STRING
    PROPERTY WEFT_NATIVE_VARIANTS
             "WEFT_NATIVE_VARIANT(${isa}, ${lanes}, weft_native_table_${isa}_${lanes})\n")
endfunction()

function(weft_add_native_kernels target)
  file(GLOB kernels RELATIVE "${CMAKE_SOURCE_DIR}" CONFIGURE_DEPENDS
       "${CMAKE_SOURCE_DIR}/kernels/*/*.cl")
  list(TRANSFORM kernels REPLACE "(.+)" "#include \"\\1\"\n")
  string(JOIN "" includes ${kernels})
  file(CONFIGURE OUTPUT "${WEFT_GENERATED_DIR}/native_kernels.def" CONTENT "${includes}" @ONLY)
  # Kernels share argument lists that not all of them use whole. As an option of the file it comes
  # after -Wextra, which would turn the warning on again for clang++. Calls in the last place of a
  # function stay calls: g++ 12 would jump instead, with wide arguments on a stack that is not aligned
  # for them.
  set_source_files_properties(
    "${CMAKE_SOURCE_DIR}/host/device/native/kernels_native.cpp"
    PROPERTIES COMPILE_OPTIONS
               "-Wno-psabi;-Wno-unused-parameter;-fno-optimize-sibling-calls")
  foreach(lanes IN ITEMS 1 4 8 16)
    weft_native_variant(${target} base ${lanes})
  endforeach()
  # Wider instruction sets only make a release build faster: a debug build needs none.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$"
     AND NOT CMAKE_BUILD_TYPE STREQUAL "Debug"
     AND NOT WEFT_SANITIZE)
    check_cxx_compiler_flag(-march=x86-64-v3 WEFT_HAVE_X86_64_V3)
    if(WEFT_HAVE_X86_64_V3)
      weft_native_variant(${target} x86_64_v3 8 -march=x86-64-v3)
    endif()
    check_cxx_compiler_flag(-march=x86-64-v4 WEFT_HAVE_X86_64_V4)
    if(WEFT_HAVE_X86_64_V4)
      weft_native_variant(${target} x86_64_v4 16 -march=x86-64-v4)
    endif()
  endif()
  get_property(WEFT_NATIVE_VARIANTS GLOBAL PROPERTY WEFT_NATIVE_VARIANTS)
  configure_file("${CMAKE_SOURCE_DIR}/cmake/native_variants.def.in"
                 "${WEFT_GENERATED_DIR}/native_variants.def" @ONLY)
endfunction()
