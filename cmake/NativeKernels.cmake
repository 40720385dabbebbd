# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# Compiles the kernels natively: those whose work depends on the number of lanes (PACKETS in
# kernels.def) once per instruction set and number of lanes, the others (ITEMS) once per instruction
# set. Each lives in a namespace of its own and exports one table function;
# generated/native_variants.def lists them for the choice at run time, and
# generated/native_{packets,items}.def include the kernels.
include(CheckCXXCompilerFlag)

# A build that is not made for speed compiles faster with less.
set(WEFT_NATIVE_OPTIMIZATION
    -O3
    CACHE STRING "Optimization of native kernels")

# weft_native_part(<target> <isa> <part> <work> <lanes> [compiler flags...]): one object file.
function(weft_native_part target isa part work lanes)
  set(library "weft_native_${isa}_${part}")
  string(TOLOWER "${work}" list)
  add_library(${library} OBJECT "${CMAKE_SOURCE_DIR}/host/device/native/kernels_native.cpp")
  target_include_directories(${library} PRIVATE "${CMAKE_SOURCE_DIR}/host" "${CMAKE_SOURCE_DIR}"
                             "${WEFT_GENERATED_DIR}")
  target_link_libraries(${library} PRIVATE weft_options weft_dependencies)
  target_compile_definitions(
    ${library}
    PRIVATE WEFT_LANES=${lanes} WEFT_NATIVE_WORK=${work} WEFT_NATIVE_KERNELS=native_${list}.def
            WEFT_NATIVE_NAMESPACE=${library} WEFT_NATIVE_TABLE=weft_native_table_${isa}_${part})
  target_compile_options(${library} PRIVATE ${ARGN})
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
    target_compile_options(${library} PRIVATE ${WEFT_NATIVE_OPTIMIZATION})
  endif()
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${library}>)
  set_property(GLOBAL APPEND PROPERTY WEFT_NATIVE_OBJECTS $<TARGET_OBJECTS:${library}>)
endfunction()

# weft_native_isa(<target> <isa> LANES <lanes>... FLAGS <compiler flags>...): one instruction set.
function(weft_native_isa target isa)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "LANES;FLAGS")
  weft_native_part(${target} ${isa} items ITEMS 1 ${arg_FLAGS})
  set(entries "WEFT_NATIVE_ITEMS(${isa}, weft_native_table_${isa}_items)\n")
  foreach(lanes IN LISTS arg_LANES)
    weft_native_part(${target} ${isa} ${lanes} PACKETS ${lanes} ${arg_FLAGS})
    string(APPEND entries "WEFT_NATIVE_VARIANT(${isa}, ${lanes}, weft_native_table_${isa}_items, "
           "weft_native_table_${isa}_${lanes})\n")
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY WEFT_NATIVE_VARIANTS "${entries}")
endfunction()

# weft_list_kernels(<work>): writes the file that includes the kernels of one part.
function(weft_list_kernels work)
  set(list "${CMAKE_SOURCE_DIR}/kernels/core/kernels.def")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${list}")
  file(STRINGS "${list}" entries REGEX "^WEFT_KERNEL_ENTRY\\(.*, ${work}\\)$")
  set(includes "")
  foreach(entry IN LISTS entries)
    string(REGEX REPLACE "^WEFT_KERNEL_ENTRY\\(([a-z_]+),.*" "\\1" name "${entry}")
    file(GLOB source RELATIVE "${CMAKE_SOURCE_DIR}" "${CMAKE_SOURCE_DIR}/kernels/*/${name}.cl")
    string(APPEND includes "#include \"${source}\"\n")
  endforeach()
  string(TOLOWER "${work}" part)
  file(CONFIGURE OUTPUT "${WEFT_GENERATED_DIR}/native_${part}.def" CONTENT "${includes}" @ONLY)
endfunction()

function(weft_add_native_kernels target)
  weft_list_kernels(PACKETS)
  weft_list_kernels(ITEMS)
  # Kernels share argument lists that not all of them use whole. As an option of the file it comes
  # after -Wextra, which would turn the warning on again for clang++. Calls in the last place of a
  # function stay calls: g++ 12 would jump instead, with wide arguments on a stack that is not aligned
  # for them.
  set_source_files_properties(
    "${CMAKE_SOURCE_DIR}/host/device/native/kernels_native.cpp"
    PROPERTIES COMPILE_OPTIONS
               "-Wno-psabi;-Wno-unused-parameter;-fno-optimize-sibling-calls")
  weft_native_isa(${target} base LANES 1 4 8 16)
  # Wider instruction sets only make a release build faster: a debug build needs none.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$"
     AND NOT CMAKE_BUILD_TYPE STREQUAL "Debug"
     AND NOT WEFT_SANITIZE)
    check_cxx_compiler_flag(-march=x86-64-v3 WEFT_HAVE_X86_64_V3)
    if(WEFT_HAVE_X86_64_V3)
      weft_native_isa(${target} x86_64_v3 LANES 8 FLAGS -march=x86-64-v3)
    endif()
    check_cxx_compiler_flag(-march=x86-64-v4 WEFT_HAVE_X86_64_V4)
    if(WEFT_HAVE_X86_64_V4)
      weft_native_isa(${target} x86_64_v4 LANES 16 FLAGS -march=x86-64-v4)
    endif()
  endif()
  get_property(WEFT_NATIVE_VARIANTS GLOBAL PROPERTY WEFT_NATIVE_VARIANTS)
  configure_file("${CMAKE_SOURCE_DIR}/cmake/native_variants.def.in"
                 "${WEFT_GENERATED_DIR}/native_variants.def" @ONLY)
endfunction()
